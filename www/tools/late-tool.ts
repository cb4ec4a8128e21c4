import { byId } from "../controls/dom.ts";
import type { Spot } from "./find.ts";
import type { Tool } from "./tool.ts";

/** A tool whose code is downloaded when it is first opened. Until then, its card says so. */
export class LateTool<Late extends Tool> implements Tool {
  readonly name: Tool["name"];
  readonly uses: Tool["uses"];
  readonly #load: (card: HTMLElement) => Promise<Late>;
  #tool: Late | null = null;
  #coming: Promise<Late | null> | null = null;

  constructor(name: Tool["name"], uses: Tool["uses"], load: (card: HTMLElement) => Promise<Late>) {
    this.name = name;
    this.uses = uses;
    this.#load = load;
  }

  open(): void {
    if (this.#tool) this.#tool.open?.();
    else void this.ready();
  }

  /** The tool, if it has been downloaded. */
  get here(): Late | null {
    return this.#tool;
  }

  /** Downloads the tool. `null`: it could not be downloaded. */
  ready(): Promise<Late | null> {
    this.#coming ??= this.#download().finally(() => {
      this.#coming = null;
    });
    return this.#coming;
  }

  async #download(): Promise<Late | null> {
    if (this.#tool) return this.#tool;
    const card = byId(`${this.name}-card`);
    card.textContent = "Loading …";
    try {
      this.#tool = await this.#load(card);
      this.#tool.open?.();
    } catch {
      card.textContent = "This tool could not be loaded. Open it again to try once more.";
    }
    return this.#tool;
  }

  click(spot: Spot): void {
    this.#tool?.click?.(spot);
  }

  cancel(): boolean {
    return this.#tool?.cancel?.() ?? false;
  }

  leave(): void {
    this.#tool?.leave?.();
  }

  begin(): void {
    this.#tool?.begin?.();
  }

  clear(): void {
    this.#tool?.clear?.();
  }
}
