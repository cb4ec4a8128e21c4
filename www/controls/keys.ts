/*
 * The one table of keys. The handlers, the sheet of keys, the labels for screen readers and docs/EMBED.md are made from
 * it.
 */

export interface Key {
  /** The names of the keys in keyboard events, with letters in lower case. Handlers get the place in this list. */
  keys: readonly string[];
  /** The keys work only together with Shift. */
  shift?: true;
  /** The keys as they look on a keyboard. If this is missing, they are those of `keys` in capitals. */
  shown?: readonly string[];
  /** The spoken words for the keys. */
  said?: string;
  /** The end of a sentence that begins with the keys. Only keys for screen readers and for the document have it. */
  does?: string;
}

const ARROWS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"];

export const KEYS = {
  orbit: { keys: ARROWS, shown: ["arrow keys"], said: "arrow keys", does: "orbit" },
  pan: { keys: ARROWS, shift: true, shown: ["Shift", "arrow keys"], said: "Shift and arrow keys", does: "pan" },
  zoom: { keys: ["+", "=", "-"], shown: ["+", "−"], said: "plus and minus", does: "zoom" },
  freeze: { keys: ["v"], does: "freezes the viewpoint" },
  hidden: { keys: ["h"], does: "shows hidden points" },
  reset: { keys: ["r"], does: "resets the view" },
  pick: { keys: ["p"], does: "picks a point" },
  measure: { keys: ["m"] },
  label: { keys: ["l"] },
  select: { keys: ["s"] },
  compare: { keys: ["c"] },
  stations: { keys: ["t"] },
  export: { keys: ["e"] },
  middle: { keys: ["Enter"], shown: ["Enter"], does: "picks the point in the middle" },
  cancel: { keys: ["Escape"], shown: ["Esc"] },
  sheet: { keys: ["?"], said: "the question mark", does: "shows all keys" },
  /** These keys work while the divider has the focus. */
  divide: {
    keys: ["ArrowLeft", "ArrowRight", "ArrowDown", "ArrowUp", "PageDown", "PageUp", "Home", "End"],
    shown: ["←", "→"],
  },
} satisfies Record<string, Key>;

export type Action = keyof typeof KEYS;

/** The rows of the sheet of keys. An action in braces stands for its keys. */
export const SHEET: readonly (readonly [title: string, how: string])[] = [
  ["Orbit", "drag · one finger · {orbit}"],
  ["Pan", "right drag · two fingers · {pan}"],
  ["Zoom", "wheel · pinch · {zoom}"],
  ["Go to a point", "double click"],
  ["Freeze viewpoint", "{freeze}"],
  ["Hidden points", "{hidden}"],
  ["Reset view", "{reset}"],
  ["Pick, measure, label", "{pick} {measure} {label} · click, or {middle} for the middle of the picture"],
  ["Select", "{select} · drag · [Shift] adds"],
  ["Compare", "{compare} · drag the line · {divide} on it"],
  ["Stations", "{stations} · click, or {middle} for the middle of the picture"],
  ["Export", "{export}"],
  ["Give up, close", "{cancel}"],
  ["This sheet", "{sheet}"],
];

/** The keys of a picture that is part of another page. */
export const ELEMENT_KEYS: readonly Action[] = ["orbit", "pan", "zoom", "freeze", "hidden", "reset", "middle"];

/** The keys of an action as they look on a keyboard. */
export function shownKeys(action: Action): readonly string[] {
  const { keys, shown }: Key = KEYS[action];
  return shown ?? keys.map((key) => key.toUpperCase());
}

/** A sentence for screen readers about the keys of some actions, without a full stop. */
export function spokenKeys(actions: readonly Action[]): string {
  const sentence = actions
    .map((action) => {
      const { said, does }: Key = KEYS[action];
      return `${said ?? shownKeys(action).join(" ")} ${does!}`;
    })
    .join(", ");
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}

/** Returns the action of a pressed key, and the key's number in its list. With Ctrl, Meta or Alt, returns `null`. */
export function pressed<Name extends Action>(
  event: KeyboardEvent,
  among: readonly Name[],
): { action: Name; nth: number } | null {
  if (event.ctrlKey || event.metaKey || event.altKey) return null;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  for (const action of among) {
    const { keys, shift }: Key = KEYS[action];
    const nth = keys.indexOf(key);
    if (nth >= 0 && (!shift || event.shiftKey)) return { action, nth };
  }
  return null;
}

/** Whether a key belongs to the action. It does not matter which other keys are held down. */
export function isKeyOf(action: Action, { key }: KeyboardEvent): boolean {
  const { keys }: Key = KEYS[action];
  return keys.includes(key);
}
