// Who may import whom. `npm test` checks it: "TypeScript: imports go downward".

/**
 * The rooms of the package, from the bottom up. A room imports only itself and rooms before it in
 * this list, so that each can be read, and tested, without the rooms after it.
 */
const PACKAGE = [
  ["base", "base/"],
  ["wasm", "(wasm|lite)/"],
  ["instance", "instance/"],
  ["formats", "formats/"],
  ["query", "query/"],
  // Beside the folder `wasm`, whose address it holds.
  ["loader", "(loader|own-wasm)\\.ts$"],
  ["inline", "inline/"],
  ["cloud", "cloud/"],
  ["follow", "follow/"],
  ["worker", "worker/"],
  ["files", "files/"],
  ["three", "three/"],
  ["nodes", "nodes/"],
  ["potree", "potree/"],
  ["deck", "deck/"],
  ["stream", "stream/"],
  ["api", "api\\.ts$"],
  ["entries", "(index|inline|lite|worker|files|three|three-webgpu|nodes|potree|react-three-fiber|deck|stream)\\.ts$"],
  // The script without a bundler.
  ["global", "global\\.ts$"],
  // The command uses the entries, as any user does.
  ["cli", "cli/"],
];

/** The rooms of the demo page; see www/README.md. */
const PAGE = [
  ["cloud", "cloud/"],
  ["controls", "controls/"],
  ["settings", "settings/"],
  ["samples", "samples/"],
  ["loaders", "loaders/"],
  ["view", "view/"],
  ["open", "open/"],
  ["compare", "compare/"],
  ["panel", "panel/"],
  ["tools", "tools/"],
  ["how", "how/"],
  ["right", "right/"],
  ["stories", "stories/"],
  ["page", "page/"],
];

/** One rule for each room: not the rooms after it. */
function downward(root, rooms) {
  return rooms.slice(0, -1).map(([name, path], i) => ({
    name: `${root}: ${name} imports only rooms below`,
    severity: "error",
    from: { path: `^${root}/${path}` },
    to: { path: rooms.slice(i + 1).map(([, above]) => `^${root}/${above}`) },
  }));
}

const forbidden = [
  {
    name: "no circles",
    comment: "Files in a circle can only be understood together. Types count as well.",
    severity: "error",
    from: {},
    to: { circular: true },
  },
  {
    name: "every import leads somewhere",
    comment: "An import that is not found is checked by no rule.",
    severity: "error",
    from: { path: "^(src/ts|www|scripts)/" },
    to: { couldNotResolve: true },
  },
  ...downward("src/ts", PACKAGE),
  ...downward("www", PAGE),
  {
    name: "every file of the package is in a room",
    comment: "A file beside the rooms would be bound by no order.",
    severity: "error",
    from: { path: "^src/ts/", pathNot: PACKAGE.map(([, path]) => `^src/ts/${path}`) },
    to: {},
  },
  {
    name: "the package stands alone",
    comment: "Users install the package without the page, the tests and the scripts.",
    severity: "error",
    from: { path: "^src/ts/" },
    to: { path: "^(www|tests|scripts)/" },
  },
  {
    name: "peers only in their adapters",
    comment:
      "three, React and deck.gl are optional: whoever imports another entry need not have them. The reader of glTF is " +
      "loaded when such a file is read.",
    severity: "error",
    from: {
      path: "^src/ts/",
      pathNot: "^src/ts/((three|nodes|potree|deck)/|(three-webgpu|react-three-fiber)\\.ts$|formats/gltf-data\\.ts$)",
    },
    to: { path: "node_modules/(three|@types/three|react|@types/react|@react-three|@deck\\.gl)/" },
  },
  {
    name: "the reader of COPC only in the stream",
    comment: "The package copc is optional, too.",
    severity: "error",
    from: { path: "^src/ts/", pathNot: "^src/ts/stream/" },
    to: { path: "node_modules/(copc|laz-perf)/" },
  },
  {
    name: "one adapter's peers",
    comment: "The layer for deck.gl needs no three.js, and the filters need no deck.gl.",
    severity: "error",
    from: { path: "^src/ts/((three|nodes|potree)/|react-three-fiber)" },
    to: { path: "(node_modules/@deck\\.gl/|^src/ts/deck/)" },
  },
  {
    name: "deck.gl without three.js",
    comment: "As above, the other way.",
    severity: "error",
    from: { path: "^src/ts/deck/" },
    to: { path: "(node_modules/(three|react|@react-three)/|^src/ts/((three|nodes)/|react-three-fiber))" },
  },
  {
    name: "Node's modules only in the command",
    comment: "The package runs in browsers. Where it can use Node, it asks while it runs (base/node.ts).",
    severity: "error",
    from: { path: "^src/ts/", pathNot: "^src/ts/cli/" },
    to: { dependencyTypes: ["core"], dependencyTypesNot: ["type-import"] },
  },
  {
    name: "the page uses the package",
    comment:
      "The page imports the package as its users do. Only rooms that no entry offers are taken from the source; " +
      "they hold no state and no class that the package has, too.",
    severity: "error",
    from: { path: "^www/" },
    to: { path: "^src/ts/", pathNot: "^src/ts/formats/" },
  },
  {
    name: "the page stands without tests and scripts",
    comment: "What the page is built from lies in www and in the package.",
    severity: "error",
    from: { path: "^www/" },
    to: { path: "^(tests|scripts)/" },
  },
  {
    name: "scripts stand without the product",
    comment: "Scripts build and check the package and the page, before either can be imported.",
    severity: "error",
    from: { path: "^scripts/" },
    to: { path: "^(src/ts|www)/" },
  },
  {
    name: "the page's element has neither panel nor address",
    comment: "<hidden-point-cloud> is a part of other pages, which have their own controls and address.",
    severity: "error",
    from: { path: "^www/element/" },
    to: { path: "^www/(panel|page)/" },
  },
];

export default {
  forbidden,
  options: {
    // Imports of types alone are imports.
    tsPreCompilationDeps: true,
    tsConfig: { fileName: "tsconfig.json" },
    doNotFollow: { path: "node_modules" },
    exclude: { path: "^(dist|target|www/dist|tests/consumers/projects)/" },
    enhancedResolveOptions: {
      exportsFields: ["exports"],
      conditionNames: ["import", "require", "node", "default", "types"],
    },
  },
};
