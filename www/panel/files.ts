import { byId } from "../controls/dom.ts";

export interface FileActions {
  /** With what the user has to know besides. */
  open: (file: File, notes: string[]) => void;
  /** What was dropped cannot be opened. */
  refuse: (sentence: string) => void;
}

/** A file chosen by the button or dropped anywhere on the page. */
export function onFile({ open, refuse }: FileActions): void {
  const input = byId("file", HTMLInputElement);
  byId("open").addEventListener("click", () => {
    input.click();
  });
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    // Emptied, so that choosing the same file again is a change again.
    if (file) open(file, []);
    input.value = "";
  });

  const hint = byId("drop");
  document.addEventListener("dragover", (event) => {
    event.preventDefault();
    hint.hidden = false;
  });
  document.addEventListener("dragleave", (event) => {
    // Without a related target the pointer has left the window, not just one element for another.
    if (event.relatedTarget === null) hint.hidden = true;
  });
  document.addEventListener("drop", (event) => {
    hint.hidden = true;
    // Whatever it is: the browser would leave the page for it.
    event.preventDefault();
    const { items, files } = event.dataTransfer!;
    const file = files[0];
    if (!file) refuse("That is not a file; drop a file.");
    else if (items[0]?.webkitGetAsEntry()?.isDirectory) refuse("That is a folder; drop a file.");
    else open(file, files.length > 1 ? [`Of the ${files.length} files only the first was opened, ${file.name}.`] : []);
  });
}
