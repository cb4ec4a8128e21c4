import type { StoryName } from "../settings/table.ts";
import "./stories.css";
import { nextFrame } from "../controls/controls.ts";
import { button, make } from "../tools/make.ts";

/** A number that the tools find while a story is told. */
export type Figure = "distance" | "unseen";

/** The page's state, as an address would ask for it without the cloud, and a sentence about it. */
export interface Step {
  address: string;
  /** A figure in braces stands for its number. */
  says: string;
}

export interface Story {
  title: string;
  steps: readonly Step[];
}

/* Points are named by their indices: each sample has the same points on every machine. */

const STREET = "view=-19.2,-0.6,3.2&target=-4,0.3,3.2";
/** A tree, and a point that lies behind the front of the house, in a room, or one of the front itself. */
const [TREE, ROOM, FRONT] = [60627, 82518, 88955];

const NAMES = `label=266118,Vase&label=296076,Plant&label=284173,Books&label=299060,Picture&label=249104,Table`;

const ABOVE = "view=-34,-17,24&target=-4,0,1.5";
const FIRST = "station=-21,1.1,1.75,First";
const SECOND = "station=22,0.9,1.75,Second";

export const TOLD: Record<StoryName, Story> = {
  measure: {
    title: "Measure",
    steps: [
      {
        address: `${STREET}&compare=1&measure=${TREE},${ROOM}`,
        says: "How far is it from the tree to the house on the left? In a cloud, one sees through the wall: the tape takes the point next to the cursor, in a room behind. {distance} m.",
      },
      {
        address: `${STREET}&compare=0&measure=${TREE},${FRONT}`,
        says: "Now the hidden points are left out. The same click takes the front of the house. {distance} m.",
      },
      {
        address: `view=-17,-3,17&target=-5,2.5,1&measure=${TREE},${ROOM}&measure=${TREE},${FRONT}`,
        says: "Both tapes from above. The longer one went through the wall.",
      },
    ],
  },
  label: {
    title: "Label",
    steps: [
      {
        address: `view=-2.35,1.62,1.75&target=-1.45,1.36,1&${NAMES}`,
        says: "Names hang on points of this room.",
      },
      {
        address: `view=2.05,1.6,4.4&target=1.2,1.1,0&${NAMES}`,
        says: "From the hall only the names behind the open door are left. The others are behind the wall, so they go.",
      },
      {
        address: `view=-1,1.62,4.6&target=1.2,1.1,0.5&${NAMES}`,
        says: "A few steps to the left, the door shows another part of the room. Nobody has told the page where the walls are: the points do.",
      },
    ],
  },
  survey: {
    title: "Survey",
    steps: [
      {
        address: `${ABOVE}&${FIRST}`,
        says: "A laser scanner stands in the street. The red points are hidden from it: {unseen} of them.",
      },
      {
        address: `${ABOVE}&${FIRST}&${SECOND}`,
        says: "A second scanner at the other end of the street. Neither of them sees {unseen} points.",
      },
      {
        address: `view=-3,-3.2,5&target=3,4.5,1&${FIRST}&${SECOND}`,
        says: "What is still red lies behind cars and trees, and in the rooms. That is where a third scanner has to look.",
      },
    ],
  },
};

/** The page, as a story uses it. */
export interface Stage {
  /** Shows what an address without a cloud asks for. Resolves when the picture is final. */
  show: (address: string, signal: AbortSignal) => Promise<void>;
  /** `null`: it is not known yet. */
  figure: (name: Figure) => number | null;
  /** Called when the story is put away. */
  ended: () => void;
}

const WRITTEN: Record<Figure, Intl.NumberFormat> = {
  distance: new Intl.NumberFormat("en-US", { minimumFractionDigits: 1, maximumFractionDigits: 1 }),
  unseen: new Intl.NumberFormat("en-US"),
};

/** Tells a story step by step, by its buttons. */
export class Player {
  readonly #story: Story;
  readonly #stage: Stage;
  readonly #says = make("p", { "aria-live": "polite" });
  readonly #back = button("Back", () => void this.#go(this.#at - 1));
  readonly #next = button("Next", () => void this.#go((this.#at + 1) % this.#story.steps.length));
  readonly #box: HTMLElement;
  #turn = new AbortController();
  #at = 0;

  constructor(story: Story, stage: Stage) {
    this.#story = story;
    this.#stage = stage;
    const end = button("End", () => this.end());
    const heading = make("h2", {}, story.title);
    const row = make("div", { class: "row" }, this.#back, this.#next, end);
    this.#box = make("section", { id: "story", "aria-label": `Story: ${story.title}` }, heading, this.#says, row);
  }

  /** Begins, and shows the story in an element of the page. */
  begin(over: HTMLElement): void {
    over.append(this.#box);
    void this.#go(0);
  }

  end(): void {
    if (!this.#box.isConnected) return;
    this.#turn.abort();
    this.#box.remove();
    this.#stage.ended();
  }

  async #go(to: number): Promise<void> {
    this.#turn.abort();
    const { signal } = (this.#turn = new AbortController());
    const { steps } = this.#story;
    this.#at = to;
    const step = steps[to]!;
    this.#back.disabled = to === 0;
    this.#next.textContent = to === steps.length - 1 ? "Again" : "Next";
    // The figures of the step before are not those of this one.
    this.#say(step, () => null);
    const isHere = () => !signal.aborted;
    await this.#stage.show(step.address, signal);
    while (isHere() && !this.#say(step, this.#stage.figure)) await nextFrame();
  }

  /** Says the sentence of a step. Returns whether all of its figures are known. */
  #say({ says }: Step, figure: Stage["figure"]): boolean {
    let isWhole = true;
    const sentence = says.replace(/\{(\w+)\}/g, (_, name: Figure) => {
      const value = figure(name);
      isWhole &&= value !== null;
      return value === null ? "…" : WRITTEN[name].format(value);
    });
    if (sentence !== this.#says.textContent) this.#says.textContent = sentence;
    return isWhole;
  }
}
