import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["tests/{package,browser,consumers,scripts}/**/*.test.ts"],
    // Machines differ in speed: these limits only end what hangs.
    testTimeout: 180_000,
    hookTimeout: 300_000,
    expect: { poll: { timeout: 60_000 } },
  },
});
