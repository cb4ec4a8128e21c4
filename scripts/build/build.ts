import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { gzipSync } from "node:zlib";

import { type BuildOptions, build as bundleWith, transform } from "esbuild";
import { rolldown } from "rolldown";

import { TSC, inRoot, mustRun, say } from "../lib/run.js";
import { makeOptions } from "./options.js";
import { WASM_FILES, buildWasm } from "./wasm.js";
import { unlessUnchanged } from "../lib/stamp.js";
import { setUpForBuild } from "../setup/rust.js";

/** Modules that hold the wasm and the worker's script as text, for the entry `inline`. */
const EMBEDDED = ["embedded.js", "embedded.d.ts", "embedded-worker.js", "embedded-worker.d.ts"];

/** Writes these files beside the wasm. */
function embedWasm(): void {
  const gzipped = gzipSync(readFileSync(inRoot("src/ts/wasm/hpr_bg.wasm")), { level: 9 });
  write(EMBEDDED.slice(0, 2), [
    `export const gzippedWasm =\n  "${gzipped.toString("base64")}";\n`,
    "/** hpr_bg.wasm, gzipped, in base64. */\nexport const gzippedWasm: string;\n",
  ]);
}

/** White space stays: without it, esbuild would drop the notes for bundlers on what has no effect and what not to follow. */
const SHORT = { minifySyntax: true, minifyIdentifiers: true };

/** Bundles the worker's script, and writes the modules of `inline` that hold it. Returns the script. */
async function embedWorker(): Promise<Uint8Array> {
  // One script is a module, a classic script, and text that Node runs. Bundlers read it, too.
  const script = await bundle("worker/worker-thread.ts", SHORT);
  write(EMBEDDED.slice(2), [
    `export const workerText =\n  ${JSON.stringify(Buffer.from(script).toString())};\n`,
    "/** worker-thread.js in one file. */\nexport const workerText: string;\n",
  ]);
  return script;
}

/** The script for pages without a bundler: the wasm and the worker's script are in it, and nothing is fetched. */
function bundleGlobal(): Promise<Uint8Array> {
  return bundle("global.ts", {
    minify: true,
    globalName: "HiddenPointRemoval",
    // The addresses of files beside the modules, which it does not use.
    define: { "import.meta.url": "document.baseURI" },
  });
}

/** A file of src/ts and all that it imports, as one script that works at any address. */
async function bundle(entry: string, options: BuildOptions): Promise<Uint8Array> {
  const entryPoints = [inRoot("src/ts", entry)];
  const usual = { bundle: true, format: "iife", target: "es2022" } as const;
  const { outputFiles } = await bundleWith({ entryPoints, ...usual, ...options, write: false });
  return outputFiles[0]!.contents;
}

/** The entries of the package that share what they need: their classes are the same, and they start one wasm. */
const ENTRIES = [
  ...["index", "inline", "worker", "files", "stream", "deck", "potree"],
  ...["three", "three-webgpu", "react-three-fiber", "nodes"],
];

/**
 * What several entries share, in files whose names say it. They are as few as they can be if a user's bundler shall leave
 * out of each entry what this does not need: it cannot leave a class out of a file that is needed for another one.
 */
const SHARED = [
  { name: "viewers", test: /src\/ts\/(three|nodes)\// },
  { name: "client", test: /src\/ts\/(follow|worker)\/(?!abort)/ },
  { name: "readers", test: /src\/ts\/(formats|files)\// },
  { name: "cloud", test: /src\/ts\/(cloud\/(?!methods|visib)|wasm\/|instance\/(own|init-sync))/ },
  { name: "questions", test: /src\/ts\/cloud\// },
  // `inline` must not name the file of the wasm: bundlers would copy it.
  { name: "own-wasm", test: /src\/ts\/own-wasm/ },
  { name: "base", test: /src\/ts\/|rolldown/ },
  // What files.js shares with the readers that it loads when they are needed: it must not export it.
  { name: "formats", test: /src\/ts\/(formats|files)\/(?!e57|.*gltf|las\/(check|details|laz|read))/, minShareCount: 1 },
].map((group) => ({ minShareCount: 2, ...group }));

/**
 * Bundles modules of src/ts into dist, each with a map to its sources: one file for each entry, and those that the entries
 * share. Addresses in them begin in dist.
 */
async function bundleModules(input: Record<string, string>, chunkFileNames: string, groups = SHARED): Promise<void> {
  const bundle = await rolldown({
    input,
    cwd: inRoot("src/ts"),
    platform: "neutral",
    preserveEntrySignatures: "allow-extension",
    // Whatever is not a file of this package is the user's own.
    external: (name) => !/^[./]/.test(name),
    plugins: [
      {
        name: "minify",
        // Rolldown itself would write addresses as templates, which not every bundler finds.
        renderChunk: (code) => transform(code, { ...SHORT, format: "esm", target: "es2022", sourcemap: true }),
      },
    ],
  });
  const codeSplitting = groups.length === 0 || { groups, includeDependenciesRecursively: false };
  await bundle.write({ dir: inRoot("dist"), chunkFileNames, sourcemap: true, minify: false, codeSplitting });
  await bundle.close();
}

function write(names: string[], texts: string[]): void {
  names.forEach((name, i) => {
    writeFileSync(inRoot("src/ts/wasm", name), texts[i]!);
  });
}

/** What neither compiler makes. */
const COPIED = WASM_FILES.filter((file) => !file.endsWith(".js"));

/** The script for pages without a bundler. */
const GLOBAL = "dist/hidden-point-removal.global.js";

/** Installs what is missing and builds the npm package: the wasm, the modules and their types, in dist. */
export async function buildPackage(): Promise<void> {
  makeOptions();
  await setUpForBuild();
  await buildWasm();
  const work = {
    name: "package",
    inputs: ["src/ts", "tsconfig.base.json", "tsconfig.build.json", "package-lock.json", "scripts/build/build.ts"],
    ignore: EMBEDDED.map((file) => `src/ts/wasm/${file}`),
    outputs: ["dist/index.js", "dist/worker-thread.js", GLOBAL, ...COPIED.map((file) => `dist/${file}`)],
  };
  const result = await unlessUnchanged(work, async () => {
    say("Compiling the npm package…");
    // The folder is emptied first: a module whose source is gone must not stay.
    rmSync(inRoot("dist"), { recursive: true, force: true });
    embedWasm();
    const worker = await embedWorker();
    await mustRun(process.execPath, [TSC, "-p", "tsconfig.build.json"], "The npm package does not compile");
    await bundleModules(Object.fromEntries(ENTRIES.map((name) => [name, `./${name}.ts`])), "[name].js");
    // Nobody uses these two together with another entry. So each is whole.
    await bundleModules({ lite: "./lite.ts" }, "lite-[name].js", []);
    await bundleModules({ cli: "./cli/main.ts", command: "./cli/command.ts" }, "command-[name].js", []);
    for (const file of COPIED) {
      mkdirSync(inRoot("dist", dirname(file)), { recursive: true });
      copyFileSync(inRoot("src/ts", file), inRoot("dist", file));
    }
    writeFileSync(inRoot("dist/worker-thread.js"), worker);
    writeFileSync(inRoot(GLOBAL), await bundleGlobal());
  });
  say(`npm package: ${result}`);
}

/** Builds the demo page, and the element for other pages. Both lie in www/dist and can be hosted under any path. */
async function buildDemo(): Promise<void> {
  const work = {
    name: "demo",
    inputs: ["www", "examples", "dist", "package.json", "package-lock.json", "THIRD_PARTY.md", "README.md", "docs"],
    ignore: ["www/dist", "www/public/samples"],
    outputs: ["www/dist/index.html", "www/dist/hidden-point-cloud.js", "www/dist/hidden-point-cloud.d.ts"],
  };
  const result = await unlessUnchanged(work, async () => {
    // The page is built first, because its build empties the folder.
    for (const [what, folder, config] of [
      ["demo page", "www", "www/vite.config.ts"],
      ["element", "www", "www/element/vite.config.ts"],
      ["examples", "examples", "www/examples.vite.config.ts"],
    ] as const) {
      say(`Building the ${what}…`);
      const options = ["--config", config, "--configLoader", "runner", "--logLevel", "warn"];
      await mustRun("vite", ["build", folder, ...options], `The ${what} could not be built`);
    }
    // The licenses of the bundled code require it.
    copyFileSync(inRoot("THIRD_PARTY.md"), inRoot("www/dist/THIRD_PARTY.md"));
    // The picture that other sites show beside a link to the page.
    copyFileSync(inRoot("docs/page.webp"), inRoot("www/dist/preview.webp"));
  });
  say(`Demo page and element: ${result}`);
}

/** Builds the npm package and the demo page. Steps whose inputs did not change are skipped. */
export async function build(): Promise<void> {
  await buildPackage();
  await buildDemo();
}
