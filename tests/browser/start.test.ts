import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createServer } from "vite";
import { expect, test } from "vitest";

test("the server of npm start has the samples the first time it runs, the examples and the documents", async () => {
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

    // The gallery of examples, each with its source and its picture, what they read, and the documents.
    const text = async (path: string) => {
      const response = await fetch(new URL(path, server.resolvedUrls!.local[0]));
      expect(response.status, path).toBe(200);
      return response.text();
    };
    const gallery = await text("examples/index.html");
    const linked = (pattern: RegExp) => [...gallery.matchAll(pattern)].map(([, path]) => path!);
    const pages = new Set(linked(/href="(\w+\.html)"/g));
    expect(pages.size).toBeGreaterThanOrEqual(14);
    expect(linked(/src="\.\/(pictures\/\w+\.webp)"/g)).toHaveLength(pages.size);
    for (const path of [...pages, ...linked(/href="(source\/\w+\.txt)"/g)]) {
      expect(await text(`examples/${path}`), path).toContain("<title>");
    }
    for (const path of linked(/src="\.\/(pictures\/\w+\.webp)"/g)) {
      expect(await text(`examples/${path}`)).toMatch(/^RIFF/);
    }
    expect(await text("examples/room.ply")).toMatch(/^ply\n/);
    for (const name of ["index", "API", "PAGE"]) expect(await text(`docs/${name}.html`)).toContain("<h1");
  } finally {
    await server.close();
    rmSync(publicDir, { recursive: true });
  }
});
