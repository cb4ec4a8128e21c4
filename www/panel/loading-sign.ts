import { byId } from "../controls/dom.ts";

/** The progress in words over the canvas, with the name of the file. #status says the same to screen readers. */
export class LoadingSign {
  readonly #element = byId("loading-sign");

  say(sentence: string): void {
    this.#element.hidden = false;
    this.#element.textContent = sentence;
  }

  hide(): void {
    this.#element.hidden = true;
  }
}
