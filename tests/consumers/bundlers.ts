import { execFileSync } from "node:child_process";
import { copyFileSync, cpSync, mkdtempSync, readdirSync, realpathSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, parse } from "node:path";
import { pathToFileURL } from "node:url";
import * as esbuild from "esbuild";
import * as vite from "vite";
import webpack from "webpack";

import type { Answered, Consumer, Visit } from "./consumer";
import { installed, project } from "./install";
import { html, serve, STRICT } from "./serve";

/** The configuration files of this repository are ignored. */
const BARE: vite.InlineConfig = { configFile: false, logLevel: "warn" };
const CORS = { "access-control-allow-origin": "*" };

export const bundlers = (visit: Visit): Consumer[] => [
  {
    name: "Vite, development server",
    further: true,
    version: vite.version,
    run: async () => {
      const server = await vite.createServer({
        ...BARE,
        root: project("vite"),
        server: { host: "127.0.0.1", port: 0, ws: false },
      });
      try {
        await server.listen();
        return await visit(server.resolvedUrls!.local[0]!);
      } finally {
        await server.close();
      }
    },
  },
  {
    name: "Vite, built",
    version: vite.version,
    run: async () => {
      await buildWithVite("built", "./");
      await using site = await serve(project("vite", "built"));
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "Vite, built, under a strict security policy",
    version: vite.version,
    run: async () => {
      await buildWithVite("strict", "./");
      await using site = await serve(project("vite", "strict"), { headers: STRICT });
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "Vite, built, scripts on another origin",
    further: true,
    version: vite.version,
    run: async () => {
      await using cdn = await serve(project("vite", "cdn"), { headers: CORS });
      await buildWithVite("cdn", cdn.address);
      await using site = await serve(project("vite", "cdn"), { refused: /assets/ });
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "Vite, ./inline, built",
    version: vite.version,
    run: async () => {
      await buildWithVite("built", "./", "vite-inline");
      const files = readdirSync(project("vite-inline", "built"), { recursive: true, encoding: "utf8" });
      if (files.some((file) => file.endsWith(".wasm"))) throw new Error("a .wasm file was emitted");
      await using site = await serve(project("vite-inline", "built"));
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "Vite, ./lite, built",
    version: vite.version,
    run: async () => {
      await buildWithVite("built", "./", "lite");
      const files = readdirSync(project("lite", "built"), { recursive: true, encoding: "utf8" });
      if (files.filter((file) => file.endsWith(".wasm")).length !== 1) throw new Error(`emitted: ${files.join(", ")}`);
      await using site = await serve(project("lite", "built"));
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "Vite, a server that is one bundle",
    version: vite.version,
    run: async () => {
      const folder = await buildServerWithVite("esm");
      // The working directory says nothing about where the package is.
      return answerOf(join(folder, "esm.js"), parse(folder).root);
    },
  },
  {
    name: "Vite, ./inline, a server that is one bundle, without node_modules",
    version: vite.version,
    run: async () => {
      const folder = realpathSync(mkdtempSync(join(tmpdir(), "hpr-server-")));
      try {
        cpSync(await buildServerWithVite("inline"), folder, { recursive: true });
        writeFileSync(join(folder, "package.json"), JSON.stringify({ type: "module" }));
        return answerOf(join(folder, "inline.js"), folder);
      } finally {
        rmSync(folder, { recursive: true });
      }
    },
  },
  {
    name: "webpack, built",
    version: webpack.version,
    run: async () => {
      await buildWithWebpack("built", "auto");
      const pages = { "index.html": html('<script src="main.js"></script>') };
      await using site = await serve(project("webpack", "built"), { pages });
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "webpack, built, scripts on another origin",
    further: true,
    version: webpack.version,
    run: async () => {
      await using cdn = await serve(project("webpack", "cdn"), { headers: CORS });
      await buildWithWebpack("cdn", cdn.address);
      const pages = { "index.html": html(`<script src="${cdn.address}main.js"></script>`) };
      await using site = await serve(project("webpack", "nothing"), { pages });
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "esbuild, wasm address given",
    version: esbuild.version,
    glue: [
      'import wasm from "hidden-point-removal/hpr.wasm";',
      "init(new URL(wasm, import.meta.url))",
      "--loader:.wasm=file worker-thread=node_modules/hidden-point-removal/dist/worker-thread.js",
    ],
    run: async () => {
      await buildWithEsbuild({
        entryPoints: { main: "explicit.js", "worker-thread": WORKER },
        format: "esm",
        outdir: "built",
      });
      const pages = { "index.html": html('<script type="module" src="main.js"></script>') };
      await using site = await serve(project("esbuild", "built"), { pages });
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "esbuild, exported files, configure",
    version: esbuild.version,
    glue: [
      'hpr.configure({ wasm: "hpr.wasm", worker: "worker-thread.js" });',
      "cp node_modules/hidden-point-removal/dist/wasm/hpr_bg.wasm built/hpr.wasm",
      "cp node_modules/hidden-point-removal/dist/worker-thread.js built/",
    ],
    run: async () => {
      await buildWithEsbuild({ entryPoints: ["configured.js"], format: "esm", outdir: "configured" });
      copyExported(project("esbuild", "configured"));
      const pages = { "index.html": html('<script type="module" src="configured.js"></script>') };
      await using site = await serve(project("esbuild", "configured"), { pages });
      return await visit(`${site.address}index.html`);
    },
  },
  {
    name: "esbuild, ./inline, one classic script in a file",
    version: esbuild.version,
    run: async () => {
      // The main entry's own address has no meaning in a classic script, and is not used.
      const logOverride = { "empty-import-meta": "silent" } as const;
      await buildWithEsbuild({ entryPoints: ["classic.js"], format: "iife", outdir: "built", logOverride });
      writeFileSync(project("esbuild", "built", "classic.html"), html('<script src="classic.js"></script>'));
      return await visit(pathToFileURL(project("esbuild", "built", "classic.html")).href);
    },
  },
  {
    name: "esbuild, a bundle for Node",
    version: esbuild.version,
    run: async () => {
      await buildWithEsbuild({ entryPoints: ["../node/esm.mjs"], format: "esm", platform: "node", outdir: "server" });
      return answerOf("server/esm.js", project("esbuild"));
    },
  },
];

/** esbuild does not follow `new URL("…", import.meta.url)`, so the worker's script is an entry of its own. */
const WORKER = join(installed, "dist/worker-thread.js");

/** Copies the files that a page needs, by the names that the package exports. */
function copyExported(folder: string): void {
  const { resolve } = createRequire(project("app", "main.js"));
  for (const name of ["hpr.wasm", "worker-thread.js"]) {
    copyFileSync(resolve(`hidden-point-removal/${name}`), join(folder, name));
  }
}

async function buildWithVite(outDir: string, base: string, root = "vite"): Promise<void> {
  await vite.build({ ...BARE, root: project(root), base, build: { outDir, target: "es2022" } });
}

/** Bundles a script of the folder `node` with all packages in it. Returns the folder of the bundle. */
async function buildServerWithVite(name: string): Promise<string> {
  const [root, outDir] = [project("node"), `server-${name}`];
  await vite.build({
    ...BARE,
    root,
    ssr: { noExternal: true },
    build: {
      ssr: `${name}.mjs`,
      outDir,
      target: "es2022",
      rolldownOptions: { output: { entryFileNames: "[name].js" } },
    },
  });
  return join(root, outDir);
}

function answerOf(script: string, cwd: string): Answered {
  return JSON.parse(execFileSync(process.execPath, [script], { cwd, encoding: "utf8" })) as Answered;
}

async function buildWithWebpack(directory: string, publicPath: string): Promise<void> {
  const compiler = webpack({
    mode: "production",
    context: project("app"),
    entry: "./main.js",
    output: { path: project("webpack", directory), publicPath },
    performance: false,
  });
  const stats = await new Promise<webpack.Stats>((resolve, reject) => {
    compiler.run((error, result) => {
      compiler.close(() => undefined);
      if (result === undefined) reject(error!);
      else resolve(result);
    });
  });
  const complaints = stats.toString({ all: false, errors: true, warnings: true });
  if (complaints !== "") throw new Error(complaints);
}

async function buildWithEsbuild(options: esbuild.BuildOptions): Promise<void> {
  await esbuild.build({
    bundle: true,
    loader: { ".wasm": "file" },
    logLevel: "warning",
    absWorkingDir: project("esbuild"),
    ...options,
  });
}
