import { SAMPLES, type Sample, sampleNamed } from "../samples.ts";
import { byId } from "./dom.ts";

/** The list of samples, and the line under it that says where the current cloud is from. */
export class SamplePicker {
  private readonly select = byId("sample", HTMLSelectElement);
  private readonly credit = byId("credit");
  /** The value of the entry that is on screen. */
  private shown: string | null = null;

  constructor(onPick: (sample: Sample) => void) {
    this.select.append(...SAMPLES.map(({ name, label }) => new Option(label, name)));
    this.select.addEventListener("change", () => {
      // The entry for one's own file stands for what is shown already.
      if (this.select.value !== "") onPick(sampleNamed(this.select.value));
    });
  }

  showSample(sample: Sample): void {
    this.removeOwn();
    this.select.value = this.shown = sample.name;
    this.credit.replaceChildren(`${sample.credit.text} `);
    if (!sample.credit.link) return;
    const link = document.createElement("a");
    link.href = sample.credit.link.href;
    link.textContent = sample.credit.link.text;
    this.credit.append(link);
  }

  showOwn(name: string): void {
    this.removeOwn();
    this.select.prepend(new Option(name, "", true, true));
    this.shown = "";
    this.credit.textContent = "";
  }

  /** After a cloud that could not be opened: back to the one that is still there. */
  restore(): void {
    this.select.value = this.shown ?? "";
  }

  private removeOwn(): void {
    this.select.querySelector('option[value=""]')?.remove();
  }
}
