import "../styles/keys.css";
import type { Viewer } from "../view/viewer.ts";
import type { Spot } from "./find.ts";
import type { Marks } from "./marks.ts";
import { type Action, isKeyOf, type Key, KEYS, SHEET, shownKeys } from "../controls/keys.ts";
import { make, openDialog } from "./make.ts";

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

/** The sheet with all keys. */
export function bindKeysSheet(): void {
  document.addEventListener("keydown", (event) => {
    if (!isKeyOf("sheet", event) || isTyping(event) || event.ctrlKey || event.metaKey) return;
    const open = document.querySelector<HTMLDialogElement>("#keys");
    const sheet = SHEET.flatMap(([title, how]) => rows(title, how));
    if (open) open.close();
    else openDialog("keys", "Mouse, touch and keys", make("dl", {}, ...sheet));
  });
}

/** A row of the sheet. An action in braces stands for its keys, a word in brackets for a key. */
function rows(title: string, how: string): [HTMLElement, HTMLElement] {
  const parts = how.split(/(\{\w+\}|\[\w+\])/).flatMap((part) => {
    if (part.startsWith("[")) return [make("kbd", {}, part.slice(1, -1))];
    if (!part.startsWith("{")) return [part];
    const action = part.slice(1, -1) as Action;
    const { shift }: Key = KEYS[action];
    return shownKeys(action).flatMap((word, i) => [...(i > 0 ? [shift ? " + " : " "] : []), make("kbd", {}, word)]);
  });
  return [make("dt", {}, title), make("dd", {}, ...parts)];
}
