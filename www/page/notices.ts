import { HprError } from "hidden-point-removal";
import { LoadProblem } from "../loaders/index.ts";
import type { Message, MessageAction } from "../panel/message.ts";
import type { Status } from "./status.ts";

/** Says what goes wrong: an error in the status and the message, a note about an answer in the message alone. */
export class Notices {
  readonly #status: Status;
  readonly #message: Message;
  /** The note that is shown. It goes with the first answer that has none. */
  #note: string | null = null;

  constructor(status: Status, message: Message) {
    this.#status = status;
    this.#message = message;
  }

  /** An error; until the user dismisses it or opens another cloud. */
  error(sentence: string, actions: MessageAction[] = []): void {
    this.#status.error(sentence);
    this.#message.show(sentence, actions);
  }

  /** A view was refused. The next answer takes the sentence away. */
  refuseView(error: unknown): void {
    const sentence = sentenceOf(error, "The visible points could not be found");
    this.error(sentence);
    this.#note = sentence;
  }

  /** The note of an answer; `null` if it has none. */
  tell(note: string | null): void {
    if (note !== null && note !== this.#note) this.#message.show(note);
    if (note === null && this.#note !== null) this.#message.hide();
    this.#note = note;
  }
}

/** `what`: says what could not be done, if the error itself does not say it. */
export function sentenceOf(error: unknown, what: string): string {
  return error instanceof LoadProblem ? error.message : `${what}: ${plain(error)}.`;
}

function plain(error: unknown): string {
  if (error instanceof HprError && error.code === "load")
    return "a part of this page (its WebAssembly file or worker) could not be loaded; reload the page to try again";
  if (error instanceof HprError && error.code === "too-large")
    return "it needs more memory than the browser gives to a page";
  return error instanceof Error ? error.message.replace(/\.$/, "") : String(error);
}
