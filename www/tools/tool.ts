import type { Viewer } from "../view/viewer.ts";
import type { Spot } from "./find.ts";
import type { Marks } from "./marks.ts";

/** What all tools work with. */
export interface Bench {
  viewer: Viewer;
  marks: Marks;
  /** Whether also hidden points are meant. */
  through: () => boolean;
}

/** One tool of the bar. Its button is #tool-NAME; what it says and can be told, #NAME-card. */
export interface Tool {
  readonly name: string;
  /** Whether clicks on the canvas are the tool's, or drags, or neither. */
  readonly uses: "clicks" | "drags" | "nothing";
  /** A click, or Enter for the middle of the picture. */
  click?(spot: Spot): void;
  /** Gives up what has been begun; `false` where nothing has. */
  cancel?(): boolean;
  /** Another tool takes its place, or none: what has been begun is given up, what is done stays. */
  leave?(): void;
  /** The card is about to be seen. */
  open?(): void;
  /** Forgets everything: the cloud is another one. */
  clear?(): void;
}
