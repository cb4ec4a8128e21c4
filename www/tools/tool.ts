import type { Viewer } from "../view/viewer.ts";
import type { Spot } from "./find.ts";
import type { Marks } from "./marks.ts";

/** Shared by all tools. */
export interface Bench {
  viewer: Viewer;
  marks: Marks;
  /** Whether hidden points count as well. */
  through: () => boolean;
}

/** One tool of the bar. Its button is #tool-NAME, its words and controls are in #NAME-card. */
export interface Tool {
  readonly name: "pick" | "measure" | "select" | "label" | "export";
  /** The tool takes clicks on the canvas, or drags, or neither. */
  readonly uses: "clicks" | "drags" | "nothing";
  /** A click, or Enter for the middle of the picture. */
  click?(spot: Spot): void;
  /** Gives up a step that has been begun; `false` if there is none. */
  cancel?(): boolean;
  /** The tool is put away: a step that has been begun is given up, finished ones stay. */
  leave?(): void;
  /** The card is about to be shown. */
  open?(): void;
  /** Forgets everything: another cloud is shown. */
  clear?(): void;
}
