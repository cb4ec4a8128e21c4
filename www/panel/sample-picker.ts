import { SAMPLES, type Sample, sampleNamed } from "../samples/samples.ts";
import { byId, nextFrame } from "../controls/dom.ts";

/** The size in CSS pixels. tests/browser/thumbnails.ts makes the pictures twice as large. */
const THUMBNAIL = { width: 84, height: 56 };

/** Small pictures of some samples, the list of all, and under it the source of the current cloud. */
export class SamplePicker {
  readonly #select = byId("sample", HTMLSelectElement);
  readonly #credit = byId("credit");
  readonly #thumbnails = byId("thumbnails");
  /** The name of the user's own file. */
  readonly #own = byId("own");
  /** The value of the entry that is on screen. */
  #shown: string | null = null;

  constructor(onPick: (sample: Sample) => void) {
    this.#select.append(...SAMPLES.map(({ name, label }) => new Option(label, name)));
    this.#thumbnails.append(
      ...SAMPLES.filter((sample) => sample.picture).map((sample) =>
        thumbnail(sample, () => {
          onPick(sample);
        }),
      ),
    );
    this.#select.addEventListener("change", () => {
      // The empty value stands for the user's own file, which is on screen already.
      if (this.#select.value !== "") onPick(sampleNamed(this.#select.value));
    });
  }

  showSample(sample: Sample): void {
    void this.#showPictures();
    this.#removeOwn();
    this.#select.value = this.#shown = sample.name;
    this.#mark(sample.name);
    this.#credit.replaceChildren(`${sample.credit.text} `);
    if (!sample.credit.link) return;
    const link = document.createElement("a");
    link.href = sample.credit.link.href;
    link.textContent = sample.credit.link.text;
    this.#credit.append(link);
  }

  showOwn(name: string): void {
    void this.#showPictures();
    this.#removeOwn();
    const none = new Option("Choose a sample", "", true, true);
    none.hidden = true;
    this.#select.prepend(none);
    this.#own.textContent = name;
    this.#own.hidden = false;
    this.#shown = "";
    this.#mark(null);
    this.#credit.textContent = "";
  }

  /** Goes back to the cloud on screen, after another one could not be opened. */
  restore(): void {
    void this.#showPictures();
    this.#select.value = this.#shown ?? "";
  }

  /** Loads the pictures after the first cloud, so that they do not slow its loading down. */
  async #showPictures(): Promise<void> {
    await nextFrame();
    for (const button of this.#thumbnails.querySelectorAll("button")) {
      const image = button.querySelector("img")!;
      if (!image.hasAttribute("src")) image.src = `thumbnails/${button.dataset["sample"]}.webp`;
    }
  }

  /** Presses the picture of the sample that is on screen. */
  #mark(name: string | null): void {
    for (const button of this.#thumbnails.children) {
      button.setAttribute("aria-pressed", String((button as HTMLElement).dataset["sample"] === name));
    }
  }

  #removeOwn(): void {
    this.#own.hidden = true;
    this.#own.textContent = "";
    this.#select.querySelector('option[value=""]')?.remove();
  }
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
  button.append(image, picture!);
  button.addEventListener("click", pick);
  return button;
}
