import "./stories.css";
import { nextFrame } from "../controls/controls.ts";
import { button, make } from "../tools/make.ts";
import type { Figure, Step, Story } from "./stories.ts";

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
