import type { TimedView } from "../ask/inquiry.ts";
import { Newest } from "../ask/newest.ts";
import type { Settings } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import { pictureFrom } from "./picture.ts";
import type { PictureAnswer, PictureQuestion } from "./protocol.ts";
import { Reference, sentenceOf } from "./reference.ts";

/** Our answer beside the z-buffer of the same picture. The z-buffer is computed again for every answer and every turn. */
export class AgainstPicture {
  /** The z-buffer's last answer, and our answer to compare with it. */
  result: { picture: PictureAnswer; ours: TimedView } | null = null;
  problem: string | null = null;
  readonly #viewer: Viewer;
  readonly #changed: () => void;
  readonly #worker: Reference<PictureQuestion, PictureAnswer>;
  readonly #newest = new Newest<Settings>((settings) => this.#ask(settings));
  #wanted = "";
  #ended = false;

  constructor(viewer: Viewer, changed: () => void) {
    this.#viewer = viewer;
    this.#changed = changed;
    this.#worker = new Reference(
      new Worker(new URL("./zbuffer-worker.ts", import.meta.url), { type: "module" }),
      viewer.scene.cloud.local,
    );
  }

  /** Called every frame. */
  follow(settings: Settings): void {
    const { answer } = this.#viewer.scene;
    const { matrix, ...rest } = pictureFrom(this.#viewer, answer.question.viewpoint);
    // Orbit controls return a few bits off when nothing has moved.
    const wanted = JSON.stringify([answer.asked, matrix.map(Math.fround), rest, settings.splat]);
    if (wanted === this.#wanted || this.problem !== null) return;
    this.#wanted = wanted;
    this.#newest.want(settings);
  }

  dispose(): void {
    this.#ended = true;
    this.#worker.dispose();
  }

  #isOver(): boolean {
    return this.#ended;
  }

  async #ask({ splat }: Settings): Promise<void> {
    if (this.#ended) return;
    try {
      const width = splat === "auto" ? { spacing: this.#viewer.scene.inquiry.spacing } : splat;
      const { answer: ours } = this.#viewer.scene;
      const picture = pictureFrom(this.#viewer, ours.question.viewpoint);
      const answer = await this.#worker.ask({ picture, splat: width, visible: ours.visibility.indices });
      if (answer === null) return;
      this.result = { picture: answer, ours };
      this.#viewer.showParts(answer.parts);
    } catch (error) {
      if (this.#isOver()) return;
      this.problem = `The z-buffer could not be computed: ${sentenceOf(error)}`;
      this.#viewer.showParts(null);
    }
    this.#changed();
  }
}
