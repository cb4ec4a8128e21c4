import type { TimedView } from "../ask/inquiry.ts";
import { byId } from "../controls/dom.ts";
import { coordinatesAt, indexInFile } from "./figures.ts";
import { BATCH, contentOf, copy, save, stemOf } from "./files.ts";
import { pictureWithMarks } from "./picture.ts";
import type { Bench, Tool } from "./tool.ts";

export interface ExportActions {
  /** The name of the cloud. */
  name: () => string;
  /** An address that opens the page in its present state. `null` if no address can do that. */
  link: () => string | null;
  /** Must be called when something of the tools has changed that is part of the address. */
  changed: () => void;
}

/** Saves the selected points, the visible ones where none are selected, or the picture; copies a link to the page. */
export class Export implements Tool {
  readonly name = "export";
  readonly uses = "nothing";
  readonly #bench: Bench;
  readonly #selected: () => Uint32Array;
  readonly #actions: ExportActions;
  readonly #left: () => string[];
  readonly #output = byId("export-result");

  /** `left`: the things that are too long for the link. */
  constructor(bench: Bench, selected: () => Uint32Array, actions: ExportActions, left: () => string[]) {
    this.#bench = bench;
    this.#selected = selected;
    this.#left = left;
    this.#actions = actions;
    this.#bind("export-ply", "ply", () => this.#ply());
    this.#bind("export-las", "las", () => this.#las());
    this.#bind("export-csv", "csv", () => this.#csv());
    this.#bind("export-png", "png", async () => [await pictureWithMarks(bench.viewer.stage, bench.marks.svg)]);
    byId("copy-link").addEventListener("click", () => void this.#copyLink());
  }

  open(): void {
    this.#output.textContent = "";
  }

  clear(): void {
    this.open();
  }

  get #what(): "visible" | "selected" {
    return this.#selected().length > 0 ? "selected" : "visible";
  }

  get #indices(): Uint32Array {
    return this.#what === "selected" ? this.#selected() : this.#bench.viewer.scene.visible;
  }

  #bind(id: string, ending: string, parts: () => Iterable<BlobPart> | Promise<Iterable<BlobPart>>): void {
    const button = byId(id, HTMLButtonElement);
    button.addEventListener("click", () => {
      if (!this.#bench.viewer.cloud) return;
      const file = `${stemOf(this.#actions.name())}-${ending === "png" ? "picture" : this.#what}.${ending}`;
      button.disabled = true;
      const run = async () => {
        try {
          await save(file, await parts());
          this.#output.textContent = `Saved as ${file}.`;
        } catch (error) {
          this.#output.textContent = `Could not be saved: ${error instanceof Error ? error.message : String(error)}.`;
        }
        button.disabled = false;
      };
      this.#bench.whenFinal(() => void run(), false);
    });
  }

  async #ply(): Promise<Iterable<BlobPart>> {
    const { plyParts } = await import("../../src/ts/formats/write/ply.js");
    const { cloud, positions, answer } = this.#bench.viewer.scene;
    const indices = this.#indices;
    const what = this.#what === "visible" ? "Visible" : "Selected";
    const comments = [`${what} points: ${indices.length} of ${cloud.count}`, ...seenFrom(answer)];
    return plyParts({ ...contentOf(cloud), positions, indices }, comments);
  }

  async #las(): Promise<Iterable<BlobPart>> {
    const { lasParts } = await import("../../src/ts/formats/write/las.js");
    const { cloud, positions } = this.#bench.viewer.scene;
    const { colors, fields, facts } = cloud;
    return lasParts({ positions, colors, fields, indices: this.#indices }, facts.las);
  }

  *#csv(): Iterable<BlobPart> {
    const { scene } = this.#bench.viewer;
    yield "index,x,y,z\n";
    yield* joined(
      this.#indices,
      "\n",
      (index) => `${indexInFile(scene.cloud, index)},${coordinatesAt(scene, index).join()}`,
    );
    yield "\n";
  }

  async #copyLink(): Promise<void> {
    const link = this.#actions.link();
    if (link === null) {
      this.#output.textContent = "No link can open this cloud: it is a file on your device, or still being loaded.";
      return;
    }
    const copied = await copy(link);
    const said = copied
      ? "The link is copied."
      : "The browser does not let this page copy; the link is the page’s address.";
    const left = this.#left();
    this.#output.textContent =
      left.length === 0 ? said : `${said} Not in it, because an address would be too long: ${left.join(", ")}.`;
  }
}

/** Yields a list as text, in pieces. */
function* joined(indices: Uint32Array, separator: string, text: (index: number) => string): Generator<string> {
  for (let from = 0; from < indices.length; from += BATCH) {
    yield (from > 0 ? separator : "") + Array.from(indices.subarray(from, from + BATCH), text).join(separator);
  }
}

function seenFrom({ question, visibility }: TimedView): string[] {
  const { looks } = question.method;
  return [`Seen from ${question.viewpoint.join(" ")}`, looks > 0 ? `${looks} looks` : `Radius ${visibility.radius}`];
}
