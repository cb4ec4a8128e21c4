import { readFileSync } from "node:fs";
import ts from "typescript";
import type { Plugin } from "vite";

/** Writes the types of a source file beside the built files. */
export function declarations(source: string, fileName: string): Plugin {
  return {
    name: "declarations",
    generateBundle() {
      const { outputText, diagnostics = [] } = ts.transpileDeclaration(readFileSync(source, "utf8"), {
        fileName: source,
      });
      if (diagnostics.length > 0) this.error(ts.flattenDiagnosticMessageText(diagnostics[0]!.messageText, "\n"));
      this.emitFile({ type: "asset", fileName, source: outputText });
    },
  };
}
