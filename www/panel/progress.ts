import { byId } from "./dom.ts";

/** The bar along the top of the cloud while one is loading. */
export class Progress {
  private readonly bar = byId("progress", HTMLProgressElement);

  /** `null`: under way, but nobody knows how far. */
  show(fraction: number | null): void {
    this.bar.hidden = false;
    if (fraction === null) this.bar.removeAttribute("value");
    else this.bar.value = fraction;
  }

  hide(): void {
    this.bar.hidden = true;
  }
}
