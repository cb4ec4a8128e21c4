import { byId } from "../controls/dom.ts";
import type { Spot } from "./find.ts";
import type { Tool } from "./tool.ts";

/** A tool whose code is downloaded when it is first opened. Until then, its card says so. */
export class LateTool implements Tool {
  readonly name: Tool["name"];
  readonly uses: Tool["uses"];
  readonly #load: (card: HTMLElement) => Promise<Tool>;
  #tool: Tool | null = null;
  #coming = false;

  constructor(name: Tool["name"], uses: Tool["uses"], load: (card: HTMLElement) => Promise<Tool>) {
    this.name = name;
    this.uses = uses;
    this.#load = load;
  }

  open(): void {
    if (this.#tool) this.#tool.open?.();
    else void this.ready();
  }

  /** The tool itself. `null`: it could not be downloaded, or is being downloaded already. */
  async ready(): Promise<Tool | null> {
    if (this.#tool || this.#coming) return this.#tool;
    this.#coming = true;
    const card = byId(`${this.name}-card`);
    card.textContent = "Loading …";
    try {
      this.#tool = await this.#load(card);
      this.#tool.open?.();
    } catch {
      card.textContent = "This tool could not be loaded. Open it again to try once more.";
    }
    this.#coming = false;
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
