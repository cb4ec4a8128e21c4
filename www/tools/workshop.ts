import { nextFrame } from "../controls/controls.ts";
import type { MarkParameter } from "../settings/address.ts";
import type { Store } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import type { ExportActions } from "./export.ts";
import type { Tools } from "./tools.ts";

/** The tools over the cloud. They are loaded after the first cloud, so that it does not wait for them. */
export class Workshop {
  readonly #load: () => Promise<Tools>;
  readonly #viewer: Viewer;
  #tools: Tools | null = null;
  #coming: Promise<void> | null = null;
  /** An address whose marks wait for the tools. */
  #search: string | null = null;
  readonly #changed: () => void;

  constructor(viewer: Viewer, store: Store, actions: ExportActions) {
    this.#viewer = viewer;
    this.#changed = actions.changed;
    this.#load = async () => new (await import("./tools.ts")).Tools(viewer, store, actions);
  }

  /** `null`: they are not there yet. */
  get tools(): Tools | null {
    return this.#tools;
  }

  /** Marks and stations for the address. `null`: the tools are not there yet. */
  get marks(): Record<MarkParameter, string[]> | null {
    return this.#tools && this.#search === null ? this.#tools.marks : null;
  }

  /** Called when another cloud is about to be shown. */
  clear(): void {
    this.#search = null;
    this.#tools?.clear();
  }

  /**
   * Called when a cloud is shown. Rejects if the tools cannot be loaded. `search`: an address that may have marks.
   * Resolves with a sentence if they do not suit the cloud.
   */
  async begin(search: string | null): Promise<string | null> {
    this.#search = search;
    await this.#open();
    const tools = this.#tools;
    if (!tools || search === null || this.#search !== search || !this.#viewer.cloud) return null;
    this.#search = null;
    const said = tools.restore(search);
    this.#changed();
    return said;
  }

  async #open(): Promise<void> {
    if (this.#tools) {
      this.#tools.begin();
      return;
    }
    this.#coming ??= this.#make().finally(() => (this.#coming = null));
    await this.#coming;
  }

  async #make(): Promise<void> {
    await nextFrame();
    this.#tools = await this.#load();
    this.#tools.follow();
  }
}
