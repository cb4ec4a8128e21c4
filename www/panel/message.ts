import { byId } from "./dom.ts";

export interface MessageAction {
  label: string;
  run: () => void;
}

/** A sentence over the cloud, with what can be done about it. Screen readers hear the same sentence from #status. */
export class Message {
  private readonly box = byId("message");
  private readonly text = this.box.querySelector("p")!;
  private readonly actions = this.box.querySelector<HTMLElement>(".actions")!;

  show(sentence: string, actions: MessageAction[] = []): void {
    this.text.textContent = sentence;
    const dismiss = { label: "Dismiss", run: () => undefined };
    this.actions.replaceChildren(...[...actions, dismiss].map((action) => this.button(action)));
    this.box.hidden = false;
  }

  hide(): void {
    this.box.hidden = true;
  }

  private button({ label, run }: MessageAction): HTMLButtonElement {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = label;
    button.addEventListener("click", () => {
      this.hide();
      run();
    });
    return button;
  }
}
