import { byId } from "../controls/dom.ts";
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
