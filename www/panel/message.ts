import { byId, isCalm } from "../controls/controls.ts";
import { isKeyOf } from "../controls/keys.ts";

export interface MessageAction {
  label: string;
  run: () => void;
}

/** A sentence over the cloud, with buttons for possible actions. Screen readers hear the same sentence from #status. */
export class Message {
  readonly #box = byId("message");
  readonly #text = this.#box.querySelector("p")!;
  readonly #actions = this.#box.querySelector<HTMLElement>(".actions")!;

  constructor() {
    document.addEventListener("keydown", (event) => {
      // In a dialog, the key closes the dialog alone.
      if (isKeyOf("cancel", event) && !this.#box.hidden && !document.querySelector("dialog[open]")) this.#dismiss();
    });
  }

  show(sentence: string, actions: MessageAction[] = []): void {
    this.#text.textContent = sentence;
    const dismiss = { label: "Dismiss", run: () => undefined };
    this.#actions.replaceChildren(...[...actions, dismiss].map((action) => this.#button(action)));
    this.#box.hidden = false;
  }

  hide(): void {
    this.#box.hidden = true;
  }

  /** Hides the message. The focus must not vanish with the button. */
  #dismiss(): void {
    if (this.#box.contains(document.activeElement)) byId("view").focus();
    this.hide();
  }

  #button({ label, run }: MessageAction): HTMLButtonElement {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = label;
    button.addEventListener("click", () => {
      this.#dismiss();
      run();
    });
    return button;
  }
}

/** The bar along the top of the picture while a cloud is being loaded, and the button that stops the loading. */
export class Progress {
  readonly #bar = byId("progress", HTMLProgressElement);
  readonly #cancel = byId("cancel", HTMLButtonElement);

  constructor(onCancel: () => void) {
    this.#cancel.addEventListener("click", onCancel);
  }

  /** Shows the progress. `null`: a cloud is being loaded, but the progress is not known. */
  show(fraction: number | null): void {
    this.#bar.hidden = this.#cancel.hidden = false;
    // Without its end, the bar moves.
    if (fraction === null && !isCalm()) this.#bar.removeAttribute("value");
    else this.#bar.value = fraction ?? 0;
  }

  hide(): void {
    // The focus must not vanish with the button.
    if (document.activeElement === this.#cancel) byId("view").focus();
    this.#bar.hidden = this.#cancel.hidden = true;
  }
}
