import type { Store } from "../../settings/store.ts";
import type { ExportActions } from "../export.ts";
import type { Select } from "../select.ts";
import type { Bench } from "../tool.ts";
import type { Edits } from "./edits.ts";

/** The changes of selected points. Their code is downloaded when the tool for selecting is first opened. */
export class LateEdits {
  readonly #load: () => Promise<Edits>;
  #edits: Edits | null = null;
  #coming = false;

  constructor(bench: () => Bench, store: Store, select: Select, actions: ExportActions, card: HTMLElement) {
    this.#load = async () => {
      const { Edits } = await import("./edits.ts");
      return new Edits(bench(), store, select, actions, card);
    };
  }

  /** Whether another cloud is being shown because of a change here. */
  get isOwn(): boolean {
    return this.#edits?.isOwn ?? false;
  }

  open(): void {
    if (this.#edits) this.#edits.follow();
    if (this.#edits || this.#coming) return;
    this.#coming = true;
    this.#load()
      .then((edits) => {
        this.#edits = edits;
      })
      // The next opening tries again. Selecting works without them.
      .catch(() => undefined)
      .finally(() => {
        this.#coming = false;
      });
  }

  follow(): void {
    this.#edits?.follow();
  }

  clear(): void {
    this.#edits?.clear();
  }
}
