import type { Round } from "./follower.js";
import type { Gaze, Turn } from "./gaze.js";

/** The round that asks the question that is due, and tells the gaze if it is refused. */
export function turnRound<Options, Answer>(
  gaze: Gaze<Options>,
  ask: (turn: Turn<Options>) => Answer | Promise<Answer>,
  use: (answer: Answer, turn: Turn<Options>) => (() => void) | undefined,
): Round<Answer> {
  const turn = gaze.take();
  return {
    ask: () => {
      try {
        return ask(turn);
      } catch (error) {
        gaze.refused(turn);
        throw error;
      }
    },
    use: (answer) => use(answer, turn),
    isGivenUp: (error) => {
      if (isAbort(error) || (turn.kind === "draft" && isRefusal(error))) {
        // If a draft is refused, the exact question says why, or is answered.
        return true;
      }
      gaze.refused(turn);
      return false;
    },
  };
}

function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

/** Whether an error is about the question, and not about the loss of the cloud. */
function isRefusal(error: unknown): boolean {
  // The page has this file beside the package's own class, so this does not use the class.
  const { name, code } = error as { name?: unknown; code?: unknown };
  return name === "HprError" && code !== "internal" && code !== "disposed";
}
