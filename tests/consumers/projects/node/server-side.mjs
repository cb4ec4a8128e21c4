// A server that renders pages imports the package, too. The import alone may not touch any global.
const touched = [];
const own = [
  "window",
  "document",
  "self",
  "location",
  "Worker",
  "navigator",
  "fetch",
  "WebAssembly",
  "atob",
  "DecompressionStream",
];
const originals = own.map((name) => [name, Object.getOwnPropertyDescriptor(globalThis, name)]);
for (const name of own) {
  Object.defineProperty(globalThis, name, {
    configurable: true,
    get: () => {
      touched.push(name);
      return undefined;
    },
  });
}
const hpr = await import("hidden-point-removal");
await import("hidden-point-removal/inline");
const worker = await import("hidden-point-removal/worker");
for (const [name, original] of originals) {
  if (original !== undefined) Object.defineProperty(globalThis, name, original);
  else Reflect.deleteProperty(globalThis, name);
}
if (touched.length > 0) throw new Error(`touched at import: ${touched.join(", ")}`);

const { answer } = await import("../app/answer.js");
console.log(JSON.stringify(await answer(hpr, worker)));
