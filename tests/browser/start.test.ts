import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createServer } from "vite";
import { expect, test } from "vitest";

test("the server of npm start has the samples the first time it runs", async () => {
  const publicDir = mkdtempSync(join(tmpdir(), "hpr-public-"));
  const root = join(import.meta.dirname, "../../www");
  // All samples but one were made by the build. To make them takes long.
  cpSync(join(root, "public"), publicDir, { recursive: true, filter: (name) => !name.endsWith("bunny.bin") });
  const server = await createServer({
    root,
    publicDir,
    configLoader: "runner",
    logLevel: "error",
    server: { host: "127.0.0.1", port: 0 },
  });
  try {
    await server.listen();
    const bunny = await fetch(new URL("samples/bunny.bin", server.resolvedUrls!.local[0]));
    expect((await bunny.arrayBuffer()).byteLength).toBe(12 * 1839);
  } finally {
    await server.close();
    rmSync(publicDir, { recursive: true });
  }
});
