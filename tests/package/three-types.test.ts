import { fileURLToPath } from "node:url";
import ts from "typescript";
import { expect, it } from "vitest";

const consumer = fileURLToPath(new URL("./consumer/adapters.ts", import.meta.url));
const { ModuleKind, ModuleResolutionKind } = ts;

// skipLibCheck: the libraries that the adapters serve check their own declarations.
it.each<[name: string, options: ts.CompilerOptions]>([
  ["as nodenext resolves them", { module: ModuleKind.NodeNext }],
  ["as bundlers resolve them", { module: ModuleKind.ESNext, moduleResolution: ModuleResolutionKind.Bundler }],
])("the adapters' types compile %s", (_, options) => {
  const program = ts.createProgram([consumer], {
    target: ts.ScriptTarget.ES2022,
    lib: ["lib.es2023.d.ts", "lib.dom.d.ts"],
    strict: true,
    noEmit: true,
    skipLibCheck: true,
    types: [],
    ...options,
  });
  const complaints = ts
    .getPreEmitDiagnostics(program)
    .map(({ file, messageText }) => `${file?.fileName ?? ""}: ${ts.flattenDiagnosticMessageText(messageText, " ")}`);
  expect(complaints).toEqual([]);
});
