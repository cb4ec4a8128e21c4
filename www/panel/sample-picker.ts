import { type Sample, sampleNamed, SAMPLES } from "../samples/samples.ts";
import { byId } from "../controls/controls.ts";

/** The size in CSS pixels. tests/browser/thumbnails.ts makes the pictures twice as large. */
const THUMBNAIL = { width: 75, height: 50 };

/** Small pictures of some samples, the list of all, and the source of the current cloud. */
export class SamplePicker {
  readonly #select = byId("sample", HTMLSelectElement);
  /** The places where the source of the cloud is named. */
  readonly #credits = document.querySelectorAll(".credit");
  readonly #thumbnails = byId("thumbnails");
  /** The value of the entry that is on screen. */
  #shown: string | null = null;

  readonly #turn: () => void;

  /** `turn`: makes another side of the cloud the upper one. */
  constructor(onPick: (sample: Sample) => void, turn: () => void) {
    this.#turn = turn;
    this.#select.append(...SAMPLES.map(({ name, label }) => new Option(label, name)));
    this.#thumbnails.append(
      ...SAMPLES.filter((sample) => sample.picture).map((sample) => thumbnail(sample, () => onPick(sample))),
    );
    this.#select.addEventListener("change", () => {
      // The empty value stands for the user's own file, which is on screen already.
      if (this.#select.value !== "") onPick(sampleNamed(this.#select.value));
    });
  }

  showSample(sample: Sample): void {
    this.#select.value = this.#shown = sample.name;
    this.#mark(sample.name);
    for (const credit of this.#credits) {
      credit.replaceChildren(...creditOf(sample));
      credit.classList.remove("own");
    }
  }

  showOwn(name: string): void {
    this.#select.value = this.#shown = "";
    this.#mark(null);
    for (const credit of this.#credits) {
      const turn = document.createElement("button");
      turn.type = "button";
      turn.textContent = "Turn upright";
      turn.addEventListener("click", this.#turn);
      const found = document.createElement("span");
      found.className = "found";
      credit.replaceChildren(`${name} `, turn, " ", found);
      credit.classList.add("own");
    }
  }

  /** Goes back to the cloud on screen, after another one could not be opened. */
  restore(): void {
    this.#select.value = this.#shown ?? "";
  }

  /** Presses the picture of the sample that is on screen. */
  #mark(name: string | null): void {
    for (const button of this.#thumbnails.children) {
      button.setAttribute("aria-pressed", String((button as HTMLElement).dataset["sample"] === name));
    }
  }
}

function creditOf({ credit: { text, link } }: Sample): (string | Node)[] {
  if (!link) return [text];
  const made = document.createElement("a");
  made.href = link.href;
  made.textContent = link.text;
  return [`${text} `, made];
}

function thumbnail({ name, label, picture }: Sample, pick: () => void): HTMLButtonElement {
  const button = document.createElement("button");
  button.type = "button";
  button.dataset["sample"] = name;
  button.title = label;
  const image = document.createElement("img");
  image.width = THUMBNAIL.width;
  image.height = THUMBNAIL.height;
  image.alt = "";
  image.src = `thumbnails/${name}.avif`;
  button.append(image, picture!);
  button.addEventListener("click", pick);
  return button;
}
