import { availableParallelism } from "node:os";
import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["tests/{package,browser,consumers}/**/*.test.ts"],
    // By itself it leaves one core idle, which is half of a small machine.
    maxWorkers: Math.min(availableParallelism(), 4),
    // Machines differ in speed: these limits only end what hangs.
    testTimeout: 180_000,
    hookTimeout: 300_000,
    expect: { poll: { timeout: 60_000 } },
  },
});
