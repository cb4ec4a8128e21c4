import { byId } from "../controls/controls.ts";
import { ENDINGS } from "../../src/ts/formats/cloud-file.js";
import { FORMATS, listed } from "../settings/limits.ts";
import type { CloudRequest } from "../open/open-cloud.ts";
import { type FileOptions, requestForAddress, requestForSample } from "../open/requests.ts";
import { type Sample, sampleNamed } from "../samples/samples.ts";
import type { CloudName, AddressParameters } from "../settings/address.ts";
import type { AskedView } from "../view/framing.ts";

type Limits = Omit<FileOptions, "skipNonFinite">;

/** A cloud that the page opens. */
export interface Source extends CloudRequest {
  /** Its name in the address; `null` for a file from this device. */
  name: CloudName | null;
  /** Sentences that the user has to read about it. */
  notes: string[];
  /** The address, if it may have marks of this cloud. */
  marks?: string;
  /** The reason why the cloud that was asked for could not be opened, if this cloud replaces it. */
  insteadOf?: string;
  /** Whether a story asks for it. */
  isTold?: true;
}

export function fromSample(sample: Sample, view: AskedView | null = null): Source {
  return {
    request: requestForSample(sample, document.baseURI),
    sample,
    name: ["sample", sample.name],
    view,
    settings: {},
    notes: [],
  };
}

export function fromAddress(text: string, view: AskedView | null, limits: Limits): Source {
  const request = requestForAddress(text, { skipNonFinite: false, ...limits });
  return { request, sample: null, name: ["src", text], view, settings: {}, notes: [] };
}

/** One file, or several that are shown as one cloud. */
export function fromFiles(files: File[], notes: string[], limits: Limits): Source {
  const [file, ...others] = files as [File, ...File[]];
  const { limit } = limits;
  const request: Source["request"] =
    others.length === 0
      ? { kind: "file", name: file.name, file, skipNonFinite: false, ...limits }
      : { kind: "files", name: nameOf(files.map(({ name }) => name)), files, ...(limit !== undefined && { limit }) };
  return { request, sample: null, name: null, view: null, settings: {}, notes };
}

/** A name for one or more files, for use in a sentence. */
export function nameOf([first, ...others]: readonly string[]): string {
  if (others.length === 0) return first!;
  return `${first} and ${others.length === 1 ? others[0]! : `${others.length} more files`}`;
}

/** The cloud that an address asks for. */
export function sourceOf(asked: AddressParameters, search: string): Source {
  const { sample, src, settings, notes } = asked;
  const view = asked.view && { at: asked.view, target: asked.target };
  const source = src === null ? fromSample(sampleNamed(sample), view) : fromAddress(src, view, limitsOf(asked));
  return { ...source, settings, notes, marks: search };
}

/** The largest number of points of a file, as the address asks for it. */
export function limitsOf({ points }: AddressParameters): Limits {
  return points === null ? {} : { limit: points };
}

export interface FileActions {
  /** `notes`: sentences that the user has to read about the files. */
  open: (files: File[], notes: string[]) => void;
  /** Something was dropped that cannot be opened. */
  refuse: (sentence: string) => void;
}

/** Calls `open` for files that are chosen by the button or dropped anywhere on the page. */
export function onFile({ open, refuse }: FileActions): void {
  const input = byId("file", HTMLInputElement);
  input.accept = [...Object.keys(ENDINGS), "gz"].map((ending) => `.${ending}`).join();
  byId("open").addEventListener("click", () => input.click());
  input.addEventListener("change", () => {
    const files = [...(input.files ?? [])];
    // The input is emptied, so that choosing the same file again is a change.
    input.value = "";
    if (files.length > 0) open(files, []);
  });

  const hint = byId("drop");
  hint.firstElementChild!.textContent = `Drop ${listed(FORMATS, "or")} files`;
  document.addEventListener("dragover", (event) => {
    event.preventDefault();
    hint.hidden = false;
  });
  document.addEventListener("dragleave", (event) => {
    // Without a related target, the pointer has left the whole window.
    if (event.relatedTarget === null) hint.hidden = true;
  });
  document.addEventListener("drop", (event) => {
    hint.hidden = true;
    // Otherwise the browser would leave the page and open what was dropped.
    event.preventDefault();
    const items = [...event.dataTransfer!.items].filter(({ kind }) => kind === "file");
    const isFolder = items.map((item) => item.webkitGetAsEntry()?.isDirectory ?? false);
    const files = [...event.dataTransfer!.files].filter((_, i) => !isFolder[i]);
    const folders = isFolder.filter(Boolean).length;
    if (files.length > 0) open(files, folders > 0 ? ["A folder is left out; drop its files."] : []);
    else refuse(folders > 0 ? "That is a folder; drop its files." : "That is not a file; drop a file.");
  });
}
