import { HprError } from "hidden-point-removal";
import { LoadProblem } from "../loaders/index.ts";
import type { Message, MessageAction } from "../panel/message.ts";
import type { Status } from "./status.ts";
import { make, numberField, openDialog } from "../tools/make.ts";

/** Shows problems. An error is shown in the status and the message. A note about an answer is in the message alone. */
export class Notices {
  readonly #status: Status;
  readonly #message: Message;
  /** The note that is shown. It is taken away by the first answer without a note. */
  #note: string | null = null;

  constructor(status: Status, message: Message) {
    this.#status = status;
    this.#message = message;
  }

  /** Shows an error until the user dismisses it or opens another cloud. */
  error(sentence: string, actions: MessageAction[] = []): void {
    this.#status.error(sentence);
    this.#message.show(sentence, actions);
  }

  /** Says that a view was refused. The next answer takes the sentence away. */
  refuseView(error: unknown): void {
    const sentence = sentenceOf(error, "The visible points could not be found");
    this.error(sentence);
    this.#note = sentence;
  }

  /** Shows the note of an answer. `null`: the answer has no note. */
  tell(note: string | null): void {
    if (note !== null && note !== this.#note) this.#message.show(note);
    if (note === null && this.#note !== null) this.#message.hide();
    this.#note = note;
  }
}

/** Whether an error means that a worker is lost with its cloud. */
export function isLoss(error: unknown): boolean {
  return error instanceof HprError && error.code === "internal";
}

/** The error as a sentence. `what`: the thing that could not be done, if the error itself does not say it. */
export function sentenceOf(error: unknown, what: string): string {
  return error instanceof LoadProblem ? error.message : `${what}: ${plain(error)}.`;
}

function plain(error: unknown): string {
  if (error instanceof HprError && error.code === "load") {
    return "a part of this page (its WebAssembly file or worker) could not be loaded; reload the page to try again";
  }
  if (error instanceof HprError && error.code === "too-large") {
    return "it needs more memory than the browser gives to a page";
  }
  // Each browser has its own words for it.
  if (error instanceof TypeError && /module/i.test(error.message)) {
    return "a part of this page could not be downloaded; reload the page to try again";
  }
  // The library says then how a program goes on.
  if (isLoss(error)) return (error as HprError).message.split(";")[0]!;
  return error instanceof Error ? error.message.replace(/\.$/, "") : String(error);
}

/** Asks which columns of a table are x, y and z, and calls `choose` with them. `at`: the columns that were taken. */
export function chooseColumns(at: readonly number[], choose: (columns: [string, string, string]) => void): void {
  const fields = ["x", "y", "z"].map((axis, i) => {
    const { row, input } = numberField(`column-${axis}`, `Column of ${axis}`);
    Object.assign(input, { min: "1", step: "1", required: true, value: String(at[i]) });
    return { row, input };
  });
  const form = make(
    "form",
    { method: "dialog" },
    ...fields.map(({ row }) => row),
    make("button", {}, "Open with these"),
  );
  form.addEventListener("submit", () => choose(fields.map(({ input }) => input.value) as [string, string, string]));
  openDialog("columns", "Which columns are x, y and z?", form);
}
