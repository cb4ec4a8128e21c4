import type { Visibility } from "hidden-point-removal";
import type { WorkerPointCloud } from "hidden-point-removal/worker";

export type Viewpoint = [number, number, number];

/** A viewpoint in the file's coordinates and an exponent, or null for the automatic radius. */
export interface Question {
  viewpoint: Viewpoint;
  exponent: number | null;
}

/** What the worker found, with the question it belongs to. */
export interface Answer {
  question: Question;
  visibility: Visibility;
  /** When it was asked (performance.now), and how long it took once it had its turn. */
  asked: number;
  milliseconds: number;
}

/** Orbit controls come back some bits off when nothing has moved; so little of the cloud's size is no new viewpoint. */
const SAME = 1e-9;

/** Keeps the answer up with the viewpoint: the worker finishes what it has begun, then takes the newest question. */
export class Refilter {
  onAnswer: (answer: Answer) => void = () => undefined;
  onError: (error: unknown) => void = () => undefined;
  private readonly cloud: WorkerPointCloud;
  private readonly radius: number;
  private last: Question | null = null;
  private settled = 0;

  constructor(cloud: WorkerPointCloud, radius: number) {
    this.cloud = cloud;
    this.radius = radius;
  }

  /** Called every frame; does nothing while the question stays the same. */
  want(question: Question): void {
    if (this.last && this.isSame(question, this.last)) return;
    this.ask(question).then(this.onAnswer, (error: unknown) => {
      // Overtaken by a newer question.
      if (!(error instanceof DOMException && error.name === "AbortError")) this.onError(error);
    });
  }

  async ask(question: Question): Promise<Answer> {
    this.last = question;
    const { viewpoint, exponent } = question;
    const asked = performance.now();
    const visibility = await this.cloud.visibleFrom(viewpoint, { latest: true, ...(exponent === null ? {} : { exponent }) });
    const begun = Math.max(asked, this.settled);
    this.settled = performance.now();
    return { question, visibility, asked, milliseconds: this.settled - begun };
  }

  dispose(): void {
    this.onAnswer = this.onError = () => undefined;
    void this.cloud.dispose();
  }

  private isSame(a: Question, b: Question): boolean {
    return a.exponent === b.exponent && a.viewpoint.every((value, axis) => Math.abs(value - b.viewpoint[axis]!) <= SAME * this.radius);
  }
}
