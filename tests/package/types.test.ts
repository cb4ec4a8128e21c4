// The published types, as the compilers of users read them.
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { describe, expect, it } from "vitest";

const root = join(import.meta.dirname, "../..");
const TSC = join(root, "node_modules/typescript-native/bin/tsc");
const USUAL = ["--noEmit", "--ignoreConfig", "--strict", "--target", "es2022", "--types"];

/** The compiler's messages about a consumer, and about the declarations that it reads. */
function complaints(consumer: string, types: string, ...options: string[]): string {
  const file = join(import.meta.dirname, "consumer", consumer);
  return spawnSync(process.execPath, [TSC, ...USUAL, types, ...options, file], { encoding: "utf8" }).stdout;
}

const BROWSER = ["--lib", "es2022,dom"];
const EXACT = ["--exactOptionalPropertyTypes", "--noUncheckedIndexedAccess"];

describe("the published types compile, all declarations checked,", () => {
  it.each<[name: string, types: string, ...options: string[]]>([
    ["as node16 resolves them", "", "--module", "node16", ...BROWSER],
    ["as bundlers resolve them", "", "--module", "esnext", "--moduleResolution", "bundler", ...BROWSER],
    ["in a web worker", "", "--module", "esnext", "--moduleResolution", "bundler", "--lib", "es2022,webworker"],
    ["under Node, without the browser's types", "node", "--module", "nodenext", "--lib", "es2022"],
    ["where optional properties are exact", "", "--module", "nodenext", ...BROWSER, ...EXACT],
  ])("%s", (_, types, ...options) => {
    expect(complaints("consumer.ts", types, ...options)).toBe("");
  });
});

// skipLibCheck: the libraries that the adapters serve check their own declarations. Whether bundlers find the same
// declarations is checked by `npm test -- packaging`.
it("the adapters' types compile", () => {
  expect(complaints("adapters.ts", "", "--module", "nodenext", "--skipLibCheck", "--lib", "es2023,dom")).toBe("");
});

it("the types refuse what throws, and have the scores that are asked for", () => {
  expect(complaints("refused.ts", "", "--module", "nodenext", "--skipLibCheck", "--lib", "es2023,dom", ...EXACT)).toBe(
    "",
  );
});

it("a wrong type is found", () => {
  expect(complaints("consumer.ts", "", "--module", "nodenext", "--lib", "es5")).toContain("error TS");
});
