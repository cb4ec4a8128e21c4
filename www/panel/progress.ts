import { byId } from "../controls/dom.ts";

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
    if (fraction === null) this.#bar.removeAttribute("value");
    else this.#bar.value = fraction;
  }

  hide(): void {
    // The focus must not vanish with the button.
    if (document.activeElement === this.#cancel) byId("view").focus();
    this.#bar.hidden = this.#cancel.hidden = true;
  }
}
