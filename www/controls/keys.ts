/*
 * The one table of keys. The handlers, the sheet of keys, the labels for screen readers and docs/EMBED.md are made from
 * it.
 */

export interface Key {
  /** As keyboard events name them, letters in lower case. Handlers are told which of them is pressed. */
  keys: readonly string[];
  /** Only together with Shift. */
  shift?: true;
  /** As one sees them on a keyboard; as in `keys`, in capitals, where this is missing. */
  shown?: readonly string[];
  /** As one says them. */
  said?: string;
  /** The end of a sentence that begins with them; for the keys that screen readers and the document name. */
  does?: string;
}

const ARROWS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"];

export const KEYS = {
  orbit: { keys: ARROWS, shown: ["arrow keys"], said: "arrow keys", does: "orbit" },
  pan: { keys: ARROWS, shift: true, shown: ["Shift", "arrow keys"], said: "Shift and arrow keys", does: "pan" },
  zoom: { keys: ["+", "=", "-"], shown: ["+", "−"], said: "plus and minus", does: "zoom" },
  lens: { keys: ["[", "]"], said: "square brackets", does: "change the field of view" },
  freeze: { keys: ["v"], does: "freezes the viewpoint" },
  hidden: { keys: ["h"], does: "shows hidden points" },
  reset: { keys: ["r"], does: "resets the view" },
  fullScreen: { keys: ["f"] },
  pick: { keys: ["p"], does: "picks a point" },
  measure: { keys: ["m"] },
  label: { keys: ["l"] },
  select: { keys: ["s"] },
  compare: { keys: ["c"] },
  export: { keys: ["e"] },
  middle: { keys: ["Enter"], shown: ["Enter"], does: "picks the point in the middle" },
  cancel: { keys: ["Escape"], shown: ["Esc"] },
  sheet: { keys: ["?"], said: "the question mark", does: "shows all keys" },
  /** While a light has the focus. */
  light: { keys: [...ARROWS, "+", "=", "-"], shown: ["arrow keys", "+", "−"] },
  /** While the divider has the focus. */
  divide: {
    keys: ["ArrowLeft", "ArrowRight", "ArrowDown", "ArrowUp", "PageDown", "PageUp", "Home", "End"],
    shown: ["←", "→"],
  },
} satisfies Record<string, Key>;

export type Action = keyof typeof KEYS;

/** The sheet of keys, row by row; an action in braces stands for its keys. */
export const SHEET: readonly (readonly [title: string, how: string])[] = [
  ["Orbit", "drag · one finger · {orbit}"],
  ["Pan", "right drag · two fingers · {pan}"],
  ["Zoom", "wheel · pinch · {zoom}"],
  ["Field of view", "[Alt] + wheel · {lens}"],
  ["Freeze viewpoint", "{freeze}"],
  ["Hidden points", "{hidden}"],
  ["Reset view", "{reset}"],
  ["Full screen", "{fullScreen}"],
  ["Pick, measure, label", "{pick} {measure} {label} · click, or {middle} for the middle of the picture"],
  ["Select", "{select} · drag · [Shift] adds, [Alt] takes away"],
  ["Compare", "{compare} · drag the line · {divide} on it"],
  ["Export", "{export}"],
  ["A light", "drag it · {light} on it"],
  ["Give up, close", "{cancel}"],
  ["This sheet", "{sheet}"],
];

/** The keys of a picture that stands in another page. */
export const ELEMENT_KEYS: readonly Action[] = ["orbit", "pan", "zoom", "lens", "freeze", "hidden", "reset", "middle"];

/** As one sees them on a keyboard. */
export function shownKeys(action: Action): readonly string[] {
  const { keys, shown }: Key = KEYS[action];
  return shown ?? keys.map((key) => key.toUpperCase());
}

/** For screen readers: what the keys of some actions do, without a full stop. */
export function spokenKeys(actions: readonly Action[]): string {
  const sentence = actions
    .map((action) => {
      const { said, does }: Key = KEYS[action];
      return `${said ?? shownKeys(action).join(" ")} ${does!}`;
    })
    .join(", ");
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}

/** The action that a key asks for, and the number of the key among the action's. With Ctrl, Meta or Alt: `null`. */
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

/** Whether a key is one of the action's, whatever else is held down. */
export function isKeyOf(action: Action, { key }: KeyboardEvent): boolean {
  const { keys }: Key = KEYS[action];
  return keys.includes(key);
}
