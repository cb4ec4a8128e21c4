import { createHash } from "node:crypto";
import { readFileSync, readdirSync, statSync } from "node:fs";
import { join } from "node:path";

/** The sha256 of every file in a folder, by its path there. */
export function digestsIn(folder: string): Map<string, string> {
  const files = readdirSync(folder, { recursive: true, encoding: "utf8" }).sort();
  return new Map(
    files
      .filter((file) => statSync(join(folder, file)).isFile())
      .map((file) => [file, sha256(readFileSync(join(folder, file)))]),
  );
}

/** One digest of all these digests. */
export function digestOfAll(digests: ReadonlyMap<string, string>): string {
  return sha256([...digests].map(([file, digest]) => `${digest}  ${file}\n`).join(""));
}

function sha256(content: string | Buffer): string {
  return createHash("sha256").update(content).digest("hex");
}
