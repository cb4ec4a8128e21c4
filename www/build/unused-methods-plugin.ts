import { type ESTree, parseSync, type Plugin } from "vite";

/** A library whose classes have many methods that the page never calls. */
const LIBRARY = /\/node_modules\/three\//;

type Node = ESTree.Node;

/** Method names of the library, and the names that each of them uses. */
type Methods = Map<string, Set<string>>;

/**
 * Leaves out the methods of three.js that nothing can call. A bundler keeps all methods of a class, because it cannot know
 * the class of an object. This plugin goes by names: a method stays if code that can run reads a property with its name, or
 * has the name as a text. Methods that only each other call are left out, too.
 */
export function noUnusedMethods(): Plugin {
  return {
    name: "no-unused-methods",
    apply: "build",
    renderChunk(code, { moduleIds }, _, { chunks }) {
      if (!moduleIds.some((id) => LIBRARY.test(id))) return null;
      const methods: Methods = new Map();
      const used = new Set<string>();
      for (const { modules } of Object.values(chunks))
        for (const [id, module] of Object.entries(modules))
          if (module.code) note(parse(module.code), used, LIBRARY.test(id) ? methods : null);
      // A set goes through the names that are added on the way.
      for (const name of used) for (const further of methods.get(name) ?? []) used.add(further);
      return { code: without(code, (name) => methods.has(name) && !used.has(name)), map: null };
    },
  };
}

/** Notes the names that a piece of code uses. Names that only a method of the library uses are noted with the method. */
function note(tree: Node, used: Set<string>, methods: Methods | null): void {
  walk(tree, (node) => {
    const name = methods && nameOfMethod(node);
    if (name) {
      const within = methods.get(name) ?? new Set();
      methods.set(name, within);
      note((node as ESTree.MethodDefinition).value, within, null);
      return false;
    }
    if (node.type === "MemberExpression" && node.property.type === "Identifier") used.add(node.property.name);
    // Of a pattern such as { x } = point, and of an object.
    if (node.type === "Property" && node.key.type === "Identifier") used.add(node.key.name);
    if (node.type === "Literal" && typeof node.value === "string") used.add(node.value);
    return true;
  });
}

function without(code: string, isUnused: (name: string) => boolean): string {
  let kept = "";
  let from = 0;
  walk(parse(code), (node) => {
    const name = nameOfMethod(node);
    if (!name || !isUnused(name)) return true;
    kept += code.slice(from, node.start);
    from = node.end;
    return false;
  });
  return kept + code.slice(from);
}

function nameOfMethod(node: Node): string | null {
  const isNamed = node.type === "MethodDefinition" && node.kind !== "constructor" && node.key.type === "Identifier";
  return isNamed && !node.computed ? (node.key as ESTree.IdentifierName).name : null;
}

/** Visits nodes in the order of the text. `visit` returns whether to go into the node. */
function walk(node: Node, visit: (node: Node) => boolean): void {
  if (!visit(node)) return;
  for (const part of Object.values(node).flat() as unknown[])
    if (typeof part === "object" && part !== null && "type" in part) walk(part as Node, visit);
}

function parse(code: string): Node {
  return parseSync("chunk.js", code).program;
}
