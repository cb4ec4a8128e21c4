import type { TimedView } from "../ask/inquiry.ts";
import { nextFrame } from "../controls/dom.ts";
import type { MarkParameter } from "../settings/address.ts";
import type { Store } from "../settings/store.ts";
import type { Viewer } from "../view/viewer.ts";
import type { ExportActions } from "./export.ts";
import type { Plot } from "./plot.ts";
import type { Tools } from "./tools.ts";

/** The tools over the cloud, and the plot. They are loaded after the first cloud, so that it does not wait for them. */
export class Workshop {
  readonly #load: () => Promise<{ tools: Tools; plot: Plot }>;
  readonly #viewer: Viewer;
  #here: { tools: Tools; plot: Plot } | null = null;
  #coming: Promise<void> | null = null;
  /** An address whose marks wait for the tools. */
  #search: string | null = null;
  readonly #changed: () => void;
  /** The last known exponent of the automatic radius. */
  #automatic: number | null = null;

  constructor(viewer: Viewer, store: Store, actions: ExportActions) {
    this.#viewer = viewer;
    this.#changed = actions.changed;
    this.#load = async () => {
      const [{ Tools }, { Plot }] = await Promise.all([import("./tools.ts"), import("./plot.ts")]);
      return { tools: new Tools(viewer, store, actions), plot: new Plot(viewer, store) };
    };
  }

  /** Marks, the selection and stations for the address. `null`: the tools are not there yet. */
  get marks(): Record<MarkParameter, string[]> | null {
    return this.#here && this.#search === null ? this.#here.tools.marks : null;
  }

  /** Called when another cloud is about to be shown. */
  clear(): void {
    this.#search = null;
    this.#here?.tools.clear();
  }

  /** Called when other points of the same cloud are shown. Places and selections belong to the points before. */
  exchange(): void {
    this.clear();
    this.#here?.plot.clear();
    this.#here?.tools.begin();
  }

  /**
   * Called when a cloud is shown. Rejects if the tools cannot be loaded. `search`: an address that may have marks.
   * Resolves with a sentence if they do not suit the cloud.
   */
  async begin(search: string | null): Promise<string | null> {
    this.#search = search;
    await this.#open();
    const here = this.#here;
    if (!here || search === null || this.#search !== search || !this.#viewer.cloud) return null;
    const said = await here.tools.restore(search);
    // Another cloud may have come.
    if (this.#search !== search) return null;
    this.#search = null;
    this.#changed();
    return said;
  }

  async #open(): Promise<void> {
    if (this.#here) {
      this.#here.plot.clear();
      this.#here.tools.begin();
      return;
    }
    this.#coming ??= this.#make().finally(() => {
      this.#coming = null;
    });
    await this.#coming;
  }

  async #make(): Promise<void> {
    await nextFrame();
    const { tools, plot } = (this.#here = await this.#load());
    plot.clear();
    tools.follow();
    plot.answer(this.#viewer.scene.answer);
    if (this.#automatic !== null) plot.markAutomatic(this.#automatic);
  }

  /** A number that the tools have found. `null`: none. */
  figure(name: "distance" | "unseen"): number | null {
    return this.#here?.tools.figure(name) ?? null;
  }

  /** Called every frame. */
  place(): void {
    this.#here?.tools.place();
    this.#here?.plot.follow();
  }

  answer(answer: TimedView): void {
    this.#here?.tools.follow();
    this.#here?.plot.answer(answer);
  }

  markAutomatic(exponent: number): void {
    this.#automatic = exponent;
    this.#here?.plot.markAutomatic(exponent);
  }
}
