/** A map that takes longer, in milliseconds, is older than a frame when it is drawn. */
const FRAME = 16;
/** As many points as a map has by default. */
const MOST = 32_768;
const LEAST = 10_000;

/** How many points the next map has: so many that it takes a frame, also on a slower machine. */
export class Pace {
  #points = MOST;
  #before = FRAME;

  get points(): number {
    return this.#points;
  }

  /** A map took so many milliseconds. Two maps decide: a single one may have waited, or be the first of its size. */
  took(milliseconds: number): void {
    const [faster, slower] = [Math.min(milliseconds, this.#before), Math.max(milliseconds, this.#before)];
    const times = faster > FRAME ? 0.8 : slower < 0.75 * FRAME ? 1.25 : 1;
    const points = Math.min(Math.max(Math.round(this.#points * times), LEAST), MOST);
    this.#before = points === this.#points ? milliseconds : FRAME;
    this.#points = points;
  }
}
