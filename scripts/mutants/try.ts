import type { Result } from "./results.js";
import type { Choice, Test } from "./tests.js";
import { runTests } from "./tests.js";

/**
 * Tests run in groups, the quickest first, so that most mutants fail at once. Each number limits the time of a group,
 * as a share of the time of all tests. The last group has all tests that are left. It is not run in a quick trial.
 */
const GROUPS = [0.005, 0.04, Infinity];

/** Tests that failed often run first, alone. */
const FIRST = 4;

/** The tests of the programs with all mutants. They remember by file which tests failed. */
export class Trial {
  readonly #tests: Test[];
  readonly #whole: number;
  readonly #failures = new Map<string, Map<Test, number>>();

  constructor(tests: Test[]) {
    this.#tests = tests;
    this.#whole = tests.reduce((sum, { seconds }) => sum + seconds, 0);
  }

  /** Runs the tests that reach a mutant of a file, until one fails. */
  async run(number: number, file: string, { quick, names }: Choice): Promise<Result> {
    const isSome = quick || names.length > 0;
    const reaching = this.#tests.filter(({ reached }) => reached.has(number)).sort((a, b) => a.seconds - b.seconds);
    if (reaching.length === 0) return isSome ? "open" : "unreached";
    for (const group of this.#groups(reaching, file, quick && names.length === 0)) {
      const result = await this.#runGroup(number, file, group);
      if (result !== undefined) return result;
    }
    return isSome ? "open" : "missed";
  }

  #groups(reaching: Test[], file: string, quick: boolean): Test[][] {
    const failures = this.#failures.get(file) ?? new Map<Test, number>();
    const often = reaching
      .filter((test) => failures.has(test) && test.seconds < GROUPS[1]! * this.#whole)
      .sort((a, b) => failures.get(b)! - failures.get(a)!)
      .slice(0, FIRST);
    const rest = reaching.filter((test) => !often.includes(test));
    const groups = often.map((test) => [test]);
    let next = 0;
    for (const limit of quick ? GROUPS.slice(0, -1) : GROUPS) {
      const group: Test[] = [];
      for (let sum = 0; next < rest.length; next++) {
        sum += rest[next]!.seconds;
        if (sum > limit * this.#whole) break;
        group.push(rest[next]!);
      }
      groups.push(group);
    }
    return groups;
  }

  async #runGroup(number: number, file: string, group: Test[]): Promise<Result | undefined> {
    for (const program of new Set(group.map((test) => test.program))) {
      const own = group.filter((test) => test.program === program);
      const seconds = 3 + 5 * own.reduce((sum, test) => sum + test.seconds, 0);
      const names = own.map(({ name }) => name);
      const { end, failed } = await runTests(program, names, seconds, { MUTANT: String(number) });
      if (end === "passed") continue;
      const test = own.find(({ name }) => name === failed);
      if (test !== undefined) this.#note(file, test);
      return end === "failed" ? "caught" : "timeout";
    }
    return undefined;
  }

  #note(file: string, test: Test): void {
    const failures = this.#failures.get(file) ?? new Map<Test, number>();
    this.#failures.set(file, failures.set(test, (failures.get(test) ?? 0) + 1));
  }
}
