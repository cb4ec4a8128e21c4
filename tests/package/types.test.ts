import { fileURLToPath } from "node:url";
import ts from "typescript";
import { describe, expect, it } from "vitest";

const consumer = fileURLToPath(new URL("./consumer/consumer.ts", import.meta.url));

/** The compiler's messages about the consumer and about the package's declarations. */
function complaints(options: ts.CompilerOptions): string[] {
  const program = ts.createProgram([consumer], {
    target: ts.ScriptTarget.ES2022,
    strict: true,
    noEmit: true,
    skipLibCheck: false,
    types: [],
    ...options,
  });
  return ts
    .getPreEmitDiagnostics(program)
    .map(({ file, messageText }) => `${file?.fileName ?? ""}: ${ts.flattenDiagnosticMessageText(messageText, " ")}`);
}

const { ModuleKind, ModuleResolutionKind } = ts;
const browser = ["lib.es2022.d.ts", "lib.dom.d.ts"];

describe("the published types compile, all declarations checked,", () => {
  it.each<[name: string, options: ts.CompilerOptions]>([
    [
      "as node16 resolves them",
      { module: ModuleKind.Node16, moduleResolution: ModuleResolutionKind.Node16, lib: browser },
    ],
    ["as nodenext resolves them", { module: ModuleKind.NodeNext, lib: browser }],
    [
      "as bundlers resolve them",
      { module: ModuleKind.ESNext, moduleResolution: ModuleResolutionKind.Bundler, lib: browser },
    ],
    [
      "in a web worker",
      {
        module: ModuleKind.ESNext,
        moduleResolution: ModuleResolutionKind.Bundler,
        lib: ["lib.es2022.d.ts", "lib.webworker.d.ts"],
      },
    ],
    [
      "under Node, without the browser's types",
      { module: ModuleKind.NodeNext, lib: ["lib.es2022.d.ts"], types: ["node"] },
    ],
    [
      "where optional properties are exact",
      { module: ModuleKind.NodeNext, lib: browser, exactOptionalPropertyTypes: true, noUncheckedIndexedAccess: true },
    ],
  ])("%s", (_, options) => {
    expect(complaints(options)).toEqual([]);
  });
});
