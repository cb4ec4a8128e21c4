import { Problem } from "./run.js";

/** Runs a command's main function; a `Problem` is shown as a plain sentence. */
export async function command(main: () => Promise<void>): Promise<void> {
  try {
    await main();
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    console.error(`\n${error.message}`);
    process.exitCode = 1;
  }
}
