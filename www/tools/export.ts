import { BATCH, type Content } from "../../src/ts/formats/write/content.js";
import type { Cloud } from "../cloud/cloud.ts";
import type { Stage } from "../view/stage.ts";
import type { TimedView } from "../view/inquiry.ts";
import { byId } from "../controls/controls.ts";
import { coordinatesAt, indexInFile } from "./make.ts";
import type { Bench, Tool } from "./tool.ts";

/** Joins pieces into a file that the browser saves. Between the pieces, the page continues to draw. */
export async function save(name: string, parts: Iterable<BlobPart>): Promise<void> {
  const done: Blob[] = [];
  for (const part of parts) {
    // Each piece is its own Blob: text is encoded here, and encoding megabytes at once would stop the page.
    done.push(new Blob([part]));
    await new Promise((resolve) => setTimeout(resolve));
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob(done));
  link.download = name;
  link.click();
  // By then the browser has begun to read it.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** The numbers of a cloud for a file. Its colors are in bytes, as most programs expect them. */
export function contentOf({ colors, fields }: Cloud): Pick<Content, "colors" | "fields"> {
  return { colors, fields: fields.filter(({ name }) => !colors || !/^(red|green|blue)$/.test(name)) };
}

/** The beginning of the name of a file that is saved: the name of the cloud, without its ending and without signs. */
export function stemOf(name: string): string {
  const stem = name
    .toLowerCase()
    .replace(/\.\w{1,4}$/, "")
    .replace(/[^\p{L}\p{N}]+/gu, "-")
    .replace(/^-+|-+$/g, "");
  return stem || "cloud";
}

/** Copies a text. Returns `false` if the browser refuses: the connection is not secure, or the user forbids it. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/** The picture and the marks over it, as a PNG file. */
export async function pictureWithMarks(stage: Stage, marks: SVGSVGElement): Promise<Blob> {
  const picture = await createImageBitmap(await stage.snapshot());
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const context = canvas.getContext("2d")!;
  context.drawImage(picture, 0, 0);
  context.drawImage(await imageOf(marks, stage.size), 0, 0, picture.width, picture.height);
  return canvas.convertToBlob({ type: "image/png" });
}

/** Makes an image of the SVG. It contains its own style. It needs only its size to stand alone. */
async function imageOf(
  svg: SVGSVGElement,
  { width, height }: { width: number; height: number },
): Promise<HTMLImageElement> {
  const alone = svg.cloneNode(true) as SVGSVGElement;
  alone.setAttribute("width", String(width));
  alone.setAttribute("height", String(height));
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(alone))}`;
  await image.decode();
  return image;
}

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
