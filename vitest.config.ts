import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    // Machines differ in speed: these limits only end what hangs.
    testTimeout: 360_000,
    hookTimeout: 300_000,
    expect: { poll: { timeout: 60_000 } },
    projects: [
      { extends: true, test: { name: "node", include: ["tests/{package,consumers,scripts}/**/*.test.ts"] } },
      {
        extends: true,
        test: {
          name: "browser",
          include: ["tests/browser/**/*.test.ts"],
          setupFiles: "tests/browser/setup.ts",
          isolate: false,
        },
      },
    ],
  },
});
