import "../styles/keys.css";
import type { Viewer } from "../view/viewer.ts";
import type { Spot } from "./find.ts";
import type { Marks } from "./marks.ts";
import { byId } from "../controls/controls.ts";
import { isKeyOf } from "../controls/keys.ts";

/** The things that all tools share. */
export interface Bench {
  viewer: Viewer;
  marks: Marks;
  /** The direction that is up, as a vector of length 1. */
  upward: () => readonly [number, number, number];
  /** The index of the point at a spot, or a sentence if there is none. */
  pointAt: (spot: Spot) => number | string;
  /** Whether hidden points count, too. */
  through: () => boolean;
  /** The name of the cloud. */
  name: () => string;
  /** Must be called when marks have changed: they are part of the address. */
  changed: () => void;
  /** Runs something when the picture is final; see `Patience`. */
  whenFinal: (run: () => void, here?: boolean) => void;
}

/** One tool of the bar. Its button is #tool-NAME, its words and controls are in #NAME-card. */
export interface Tool {
  readonly name: "pick" | "measure" | "select" | "label" | "export" | "stations";
  /** Whether the tool uses clicks or drags on the canvas. */
  readonly uses: "clicks" | "drags" | "nothing";
  /** Called at a click, and for the middle of the picture when Enter is pressed. */
  click?(spot: Spot): void;
  /** Gives up a step that has been begun. Returns `false` if there is no such step. */
  cancel?(): boolean;
  /** Called when the tool is put away. A step that has been begun is given up. Finished steps stay. */
  leave?(): void;
  /** Called when the card is about to be shown. */
  open?(): void;
  /** Called when a cloud is shown. */
  begin?(): void;
  /** Forgets everything, because another cloud is shown. */
  clear?(): void;
}

/** Whether a key is meant for a text field or a list. */
export function isTyping({ target }: Event): boolean {
  const isText = target instanceof HTMLInputElement && !["radio", "checkbox", "range"].includes(target.type);
  return isText || target instanceof HTMLSelectElement;
}

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
    if (isKeyOf("sheet", event) && !isTyping(event) && !event.ctrlKey && !event.metaKey) toggle();
  });
}
