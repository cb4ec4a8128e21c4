import { byId } from "../controls/dom.ts";

/** The progress in words, in the middle of the empty canvas. #status says the same to screen readers. */
export class FirstLoad {
  readonly #element = byId("first-load");
  #done = false;

  say(sentence: string): void {
    this.#element.hidden = this.#done;
    this.#element.textContent = sentence;
  }

  hide(): void {
    this.#done = true;
    this.#element.hidden = true;
  }
}
