import { Problem } from "./run.js";

/** Runs the main function of a command. Shows a `Problem` as a plain sentence. */
export async function command(main: () => Promise<void>): Promise<void> {
  try {
    await main();
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    console.error(`\n${error.message}`);
    process.exitCode = 1;
  }
}
