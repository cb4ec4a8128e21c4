import type { Viewer } from "../view/viewer.ts";
import type { Spot } from "./find.ts";
import type { Marks } from "./marks.ts";

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
