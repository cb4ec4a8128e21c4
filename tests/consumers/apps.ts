// Apps that a user would write with docs/BUNDLERS.md alone. npm installs the tools of each, so only
// `npm run consumers` runs them.
import { execFileSync, spawn } from "node:child_process";
import { once } from "node:events";
import { readdirSync, readFileSync } from "node:fs";
import { createServer, type AddressInfo } from "node:net";
import { join } from "node:path";

import type { Answered, Consumer, Visit } from "./consumer";
import { apps, installApp, npm } from "./install";
import { serve } from "./serve";

interface Manifest {
  dependencies?: Record<string, string>;
  devDependencies?: Record<string, string>;
  /** The lines that docs/BUNDLERS.md asks for. Each stands in a file of the app. */
  glue: string[];
}

export const realApps = (visit: Visit): Consumer[] => {
  /** A page that `npm run build` writes to `built`. */
  const page = (name: string, folder: string, tool: string) =>
    app(name, folder, tool, async (home) => {
      npm(home, "run", "build");
      await using site = await serve(join(home, "built"));
      return await visit(`${site.address}index.html`);
    });
  return [
    app("Next, Turbopack: server and client components", "next", "next", (home) => next(home, "turbopack", visit)),
    app("Next, webpack: server and client components", "next", "next", (home) => next(home, "webpack", visit)),
    page("Rollup, exported files, configure", "rollup", "rollup"),
    page("Parcel", "parcel", "parcel"),
    page("Rspack", "rspack", "@rspack/core"),
    page("Vue with Vite: clouds in reactive state", "vue", "vue"),
    page("React Three Fiber with Vite", "react", "@react-three/fiber"),
    app("Jest with jsdom", "jest", "jest", tested),
    app("Vitest with jsdom", "vitest-jsdom", "vitest", tested),
    app("Deno", "deno", "deno", (home) =>
      printed(home, "deno", "run", "--allow-all", "--node-modules-dir=manual", "main.js"),
    ),
    app("Bun", "bun", "bun", (home) => printed(home, "bun", "main.js")),
  ];
};

function app(name: string, folder: string, tool: string, run: Consumer["run"]): Consumer {
  const { dependencies, devDependencies, glue } = manifest(folder);
  const version = { ...dependencies, ...devDependencies }[tool];
  if (version === undefined) throw new Error(`${folder} has no ${tool}`);
  return { name, version, glue, further: true, prepare: () => installApp(folder), run };
}

function manifest(folder: string): Manifest {
  return JSON.parse(readFileSync(join(apps, folder, "package.json"), "utf8")) as Manifest;
}

/** Lines of glue that no file of their app contains. */
export function missingGlue(): string[] {
  return readdirSync(apps).flatMap((folder) => {
    const { glue, ...rest } = manifest(folder);
    const names = readdirSync(join(apps, folder), { recursive: true, withFileTypes: true });
    const files = names.filter((entry) => entry.isFile() && entry.name !== "package.json");
    const texts = files.map((entry) => readFileSync(join(entry.parentPath, entry.name), "utf8"));
    const all = [...texts, JSON.stringify(rest)].join("\n");
    return glue.filter((line) => !all.includes(line)).map((line) => `${folder}: ${line}`);
  });
}

/** The test of an app writes its answer to a file. */
function tested(home: string): Promise<Answered> {
  npm(home, "test");
  return Promise.resolve(JSON.parse(readFileSync(join(home, "answer.json"), "utf8")) as Answered);
}

function printed(home: string, program: string, ...args: string[]): Promise<Answered> {
  const output = execFileSync(binary(home, program), args, { cwd: home, encoding: "utf8", stdio: "pipe" });
  return Promise.resolve(JSON.parse(output) as Answered);
}

const binary = (home: string, program: string) => join(home, "node_modules", ".bin", program);

/**
 * Builds the site, starts its server and visits two pages: one that is rendered for every request and one that was
 * rendered by the build. Each page compares the server's answers with its own.
 */
async function next(home: string, builder: string, visit: Visit): Promise<Answered> {
  npm(home, "run", builder);
  const port = await freePort();
  const server = spawn(binary(home, "next"), ["start", "--port", String(port)], { cwd: home, stdio: "ignore" });
  const ended = once(server, "exit");
  try {
    const address = `http://127.0.0.1:${port}/`;
    await answering(address);
    const rendered = await visit(`${address}static`);
    return rendered.error === undefined ? await visit(address) : rendered;
  } finally {
    server.kill();
    await ended;
  }
}

/** Waits until a server answers, whatever it answers: a broken page is the visit's to report. */
async function answering(address: string): Promise<void> {
  for (let tries = 0; tries < 300; tries++) {
    const answered = await fetch(address).then(
      () => true,
      () => false,
    );
    if (answered) return;
    await new Promise((later) => setTimeout(later, 100));
  }
  throw new Error(`no server at ${address}`);
}

async function freePort(): Promise<number> {
  const server = createServer().listen(0, "127.0.0.1");
  await once(server, "listening");
  const { port } = server.address() as AddressInfo;
  server.close();
  await once(server, "close");
  return port;
}
