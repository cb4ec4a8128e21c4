import type { TimedView } from "../ask/inquiry.ts";
import { Follower, type Round } from "hidden-point-removal/worker";
import { Newest } from "../ask/newest.ts";
import type { Settings } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import { pictureFrom } from "./picture.ts";
import type { PictureAnswer, PictureQuestion } from "./protocol.ts";
import { Reference, sentenceOf } from "./reference.ts";

/** The settings, and a text of everything that the picture depends on. */
interface Wanted {
  settings: Settings;
  key: string;
}

/** Our answer beside the z-buffer of the same picture. Every new answer and every turn needs a new z-buffer. */
export class AgainstPicture {
  /** The z-buffer's last answer, and our answer to compare with it. */
  result: { picture: PictureAnswer; ours: TimedView } | null = null;
  problem: string | null = null;
  readonly #viewer: Viewer;
  readonly #changed: () => void;
  readonly #worker: Reference<PictureQuestion, PictureAnswer>;
  readonly #newest = new Newest<Wanted>((a, b) => a.key === b.key);
  readonly #follower = new Follower({
    next: () => (this.#newest.isNew ? this.#round(this.#newest.take()) : undefined),
    refused: (error) => {
      this.problem = `The z-buffer could not be computed: ${sentenceOf(error)}`;
      this.#viewer.showParts(null);
      this.#changed();
    },
  });

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
    if (this.problem !== null) return;
    const { answer } = this.#viewer.scene;
    const { matrix, ...rest } = pictureFrom(this.#viewer, answer.question.viewpoint);
    // Orbit controls can change the last bits of the matrix although nothing has moved.
    const key = JSON.stringify([answer.asked, matrix.map(Math.fround), rest, settings.splat]);
    this.#newest.want({ settings, key });
    this.#follower.follow();
  }

  dispose(): void {
    this.#follower.stop();
    this.#worker.dispose();
  }

  #round({ settings: { splat } }: Wanted): Round<PictureAnswer | null> {
    const { answer: ours } = this.#viewer.scene;
    return {
      ask: () => {
        const width = splat === "auto" ? { spacing: this.#viewer.scene.inquiry.spacing } : splat;
        const picture = pictureFrom(this.#viewer, ours.question.viewpoint);
        return this.#worker.ask({ picture, splat: width, visible: ours.visibility.indices });
      },
      use: (answer) => {
        if (answer === null) return undefined;
        this.result = { picture: answer, ours };
        this.#viewer.showParts(answer.parts);
        return this.#changed;
      },
    };
  }
}
