import { existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";

const TYPES: Record<string, string> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".wasm": "application/wasm",
};

/** Headers of a page that may run only its own files, and WebAssembly. */
export const STRICT = {
  "content-security-policy":
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; object-src 'none'; base-uri 'none'",
};

/** A page with a place for the answer. */
export const html = (script: string): string => `<!doctype html><title>Consumer</title><output></output>${script}`;

interface ServeOptions {
  headers?: Record<string, string>;
  /** Addresses that are answered with 404, even if the file exists. */
  refused?: RegExp;
  /** Pages that are not files, by name. */
  pages?: Record<string, string>;
}

/** Serves a directory on a port of its own, so it has an origin of its own. */
export async function serve(
  directory: string,
  { headers = {}, refused, pages = {} }: ServeOptions = {},
): Promise<{ address: string; [Symbol.asyncDispose](): Promise<void> }> {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url!, "http://localhost").pathname)).slice(1);
    const file = join(directory, path);
    const isFile = refused?.test(path) !== true && existsSync(file) && statSync(file).isFile();
    const body = pages[path] ?? (isFile ? readFileSync(file) : undefined);
    const type = TYPES[extname(path)] ?? "application/octet-stream";
    response.writeHead(body === undefined ? 404 : 200, { "content-type": type, ...headers }).end(body);
  });
  await new Promise<void>((listening) => server.listen(0, "127.0.0.1", listening));
  return {
    address: `http://127.0.0.1:${(server.address() as AddressInfo).port}/`,
    [Symbol.asyncDispose]: async () => {
      server.closeAllConnections();
      await new Promise((closed) => server.close(closed));
    },
  };
}
