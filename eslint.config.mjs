import { defineConfig, globalIgnores } from "eslint/config";
import tseslint from "typescript-eslint";

export default defineConfig(
  // `src/ts/wasm` and `src/ts/lite` are what wasm-bindgen generates.
  globalIgnores(["dist", "www/dist", "www/public", "target", "src/ts/wasm", "src/ts/lite"]),
  {
    files: ["**/*.ts"],
    extends: [tseslint.configs.strictTypeChecked],
    languageOptions: {
      parserOptions: {
        // The service worker has other globals.
        project: ["tsconfig.json", "www/offline/tsconfig.json"],
        tsconfigRootDir: import.meta.dirname,
      },
    },
    linterOptions: { reportUnusedDisableDirectives: "error" },
    rules: {
      // Loops over flat arrays know that the index is in range; the compiler cannot.
      "@typescript-eslint/no-non-null-assertion": "off",
      // Private members are written with `#`, which also holds when the program runs.
      "no-restricted-syntax": [
        "error",
        {
          selector: ":matches(PropertyDefinition, MethodDefinition[kind!='constructor'])[accessibility='private']",
          message: "Write #name.",
        },
      ],
      // A body of more than one line has braces, and so have all branches of its `if`.
      curly: ["error", "multi-line", "consistent"],
      // Numbers read well in messages without `String(…)` around them.
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
    },
  },
  {
    files: ["**/*.mjs"],
    extends: [tseslint.configs.strict],
  },
);
