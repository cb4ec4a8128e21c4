import { fileURLToPath } from "node:url";
import ts from "typescript";
import { expect, it } from "vitest";

const consumer = fileURLToPath(new URL("./consumer/adapters.ts", import.meta.url));

// skipLibCheck: the libraries that the adapters serve check their own declarations. Whether bundlers find the same
// declarations is checked by `npm test -- packaging`.
it("the adapters' types compile", () => {
  const program = ts.createProgram([consumer], {
    target: ts.ScriptTarget.ES2022,
    lib: ["lib.es2023.d.ts", "lib.dom.d.ts"],
    strict: true,
    noEmit: true,
    skipLibCheck: true,
    types: [],
    module: ts.ModuleKind.NodeNext,
  });
  const complaints = ts
    .getPreEmitDiagnostics(program)
    .map(({ file, messageText }) => `${file?.fileName ?? ""}: ${ts.flattenDiagnosticMessageText(messageText, " ")}`);
  expect(complaints).toEqual([]);
});
