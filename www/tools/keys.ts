import "../styles/keys.css";
import { byId } from "../controls/dom.ts";
import { isKeyOf } from "../controls/keys.ts";

/** The sheet with all keys. A modal dialog keeps the focus, closes by Escape and gives the focus back by itself. */
export function bindKeysSheet(): void {
  const sheet = byId("keys", HTMLDialogElement);
  const open = () => {
    sheet.showModal();
    // The only button is at the end of the sheet. With the focus on the sheet, it is read and scrolled from its beginning.
    sheet.focus();
    sheet.scrollTop = 0;
  };
  const toggle = () => {
    if (sheet.open) sheet.close();
    else open();
  };
  byId("keys-close").addEventListener("click", toggle);
  // A click beside the sheet is a click on the dialog itself.
  sheet.addEventListener("click", (event) => {
    if (event.target === sheet) sheet.close();
  });
  document.addEventListener("keydown", (event) => {
    const typing =
      event.target instanceof HTMLInputElement && !["radio", "checkbox", "range"].includes(event.target.type);
    if (isKeyOf("sheet", event) && !typing && !event.ctrlKey && !event.metaKey) toggle();
  });
}
