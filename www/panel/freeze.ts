import { byId } from "./dom.ts";

/** The button that keeps the viewpoint where it is while the camera moves on. */
export class FreezeButton {
  private readonly button: HTMLButtonElement;
  private readonly onChange: (frozen: boolean) => void;

  constructor(onChange: (frozen: boolean) => void) {
    this.button = byId("freeze", HTMLButtonElement);
    this.onChange = onChange;
    this.button.addEventListener("click", () => {
      this.toggle();
    });
  }

  get frozen(): boolean {
    return this.button.getAttribute("aria-pressed") === "true";
  }

  toggle(): void {
    this.set(!this.frozen);
  }

  set(frozen: boolean): void {
    this.button.setAttribute("aria-pressed", String(frozen));
    this.button.textContent = frozen ? "Unfreeze viewpoint" : "Freeze viewpoint";
    this.onChange(frozen);
  }
}
