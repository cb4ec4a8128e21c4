/** The bytes of a point: x, y, z in f32. */
const POINT = 12;
/** Fewer points wait for more of them. */
const LEAST = 10_000;

/** Makes points of the bytes of a sample, in the order in which they arrive. They are measured from the first point. */
export class ArrivingPoints {
  readonly #onPoints: (points: Float32Array) => void;
  #waiting: Uint8Array[] = [];
  #bytes = 0;
  #first: [number, number, number] | null = null;

  constructor(onPoints: (points: Float32Array) => void) {
    this.#onPoints = onPoints;
  }

  take(part: Uint8Array): void {
    this.#waiting.push(part);
    this.#bytes += part.length;
    const count = Math.floor(this.#bytes / POINT);
    if (count < LEAST) return;
    const joined = new Uint8Array(this.#bytes);
    let at = 0;
    for (const bytes of this.#waiting) {
      joined.set(bytes, at);
      at += bytes.length;
    }
    const points = new Float32Array(joined.buffer, 0, 3 * count).slice();
    this.#waiting = [joined.subarray(count * POINT)];
    this.#bytes -= count * POINT;
    this.#first ??= [points[0]!, points[1]!, points[2]!];
    for (let i = 0; i < points.length; i++) points[i] = points[i]! - this.#first[i % 3]!;
    this.#onPoints(points);
  }
}
