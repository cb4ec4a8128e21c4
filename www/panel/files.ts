import { byId } from "../controls/dom.ts";

export interface FileActions {
  /** `notes`: sentences that the user has to read about the file. */
  open: (file: File, notes: string[]) => void;
  /** Something was dropped that cannot be opened. */
  refuse: (sentence: string) => void;
}

/** Calls `open` for a file that is chosen by the button or dropped anywhere on the page. */
export function onFile({ open, refuse }: FileActions): void {
  const input = byId("file", HTMLInputElement);
  byId("open").addEventListener("click", () => {
    input.click();
  });
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    // The input is emptied, so that choosing the same file again is a change.
    if (file) open(file, []);
    input.value = "";
  });

  const hint = byId("drop");
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
    const { items, files } = event.dataTransfer!;
    const file = files[0];
    if (!file) refuse("That is not a file; drop a file.");
    else if (items[0]?.webkitGetAsEntry()?.isDirectory) refuse("That is a folder; drop a file.");
    else open(file, files.length > 1 ? [`Of the ${files.length} files only the first was opened, ${file.name}.`] : []);
  });
}
