import { expect, test } from "vitest";
import { noUnusedMethods } from "../../www/build/unused-methods-plugin.js";

type Chunk = { moduleIds: string[]; modules: Record<string, { code: string }> };
type Render = (code: string, chunk: Chunk, options: object, meta: object) => { code: string } | null;
const render = noUnusedMethods().renderChunk as unknown as Render;

/** The code of the library's chunk. `own`: the page's code, in a chunk of its own. */
function rendered(library: string, own: string): string {
  const chunkOf = (id: string, code: string): Chunk => ({ moduleIds: [id], modules: { [id]: { code } } });
  const chunk = chunkOf("/some/node_modules/three/src/Vector.js", library);
  return render(library, chunk, {}, { chunks: { a: chunk, b: chunkOf("/some/www/own.ts", own) } })!.code;
}

test("methods of the library that no code names are left out, with those that only they use", () => {
  const library =
    "class Vector { add() { return 1; } static twice() { return this.half(); } half() { return 2; } get size() { return 3; } }";
  expect(rendered(library, "vector.add();")).toBe("class Vector { add() { return 1; }    }");
  expect(rendered(library, "Vector.twice();").match(/\w+\(\) {/g)).toEqual(["twice() {", "half() {"]);
});

test("methods that only call each other or themselves are left out", () => {
  const library =
    "class Tree { write() { this.child.write(); this.each(); } each() { this.write(); } constructor() {} }";
  expect(rendered(library, "new Tree();").replace(/ +/g, " ")).toBe("class Tree { constructor() {} }");
});

test.for([
  "const { add } = vector;",
  'vector["add"]();',
  "const names = ['add'];",
  "const own = { add: 1 };",
  "vector?.add;",
])("a method stays if other code says %s", (own) => {
  const library = "class Vector { add() { return 1; } [Symbol.iterator]() {} '#'() {} }";
  expect(rendered(library, own)).toBe(library);
});

test("code of a chunk without the library stays as it is", () => {
  const chunk = { moduleIds: ["/some/www/own.ts"], modules: {} };
  expect(render("class Own { never() {} }", chunk, {}, { chunks: { chunk } })).toBe(null);
});
