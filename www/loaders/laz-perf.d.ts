/** The package's own types need those of Emscripten. */
declare module "laz-perf/lib/worker/laz-perf.js" {
  const createLazPerf: (options: {
    locateFile: () => string;
    print: () => void;
    printErr: () => void;
  }) => Promise<unknown>;
  export default createLazPerf;
}

declare module "*.wasm?url" {
  const url: string;
  export default url;
}
