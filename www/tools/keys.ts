import { byId } from "../controls/dom.ts";

/** The sheet with all keys. A modal dialog keeps the focus, closes by Escape and gives the focus back by itself. */
export function bindKeysSheet(): void {
  const sheet = byId("keys", HTMLDialogElement);
  const open = () => {
    sheet.showModal();
    // Its only button is at its end: the sheet itself has the focus, is read from its beginning and scrolls by keys.
    sheet.focus();
    sheet.scrollTop = 0;
  };
  const toggle = () => {
    if (sheet.open) sheet.close();
    else open();
  };
  byId("tool-keys").addEventListener("click", toggle);
  byId("keys-close").addEventListener("click", toggle);
  // A click beside the sheet is one on the dialog itself.
  sheet.addEventListener("click", (event) => {
    if (event.target === sheet) sheet.close();
  });
  document.addEventListener("keydown", (event) => {
    const typing =
      event.target instanceof HTMLInputElement && !["radio", "checkbox", "range"].includes(event.target.type);
    if (event.key === "?" && !typing && !event.ctrlKey && !event.metaKey) toggle();
  });
}
