import { byId } from "../controls/controls.ts";
import { ENDINGS } from "../../src/ts/formats/cloud-file.js";
import { FORMATS, listed } from "../settings/limits.ts";

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
