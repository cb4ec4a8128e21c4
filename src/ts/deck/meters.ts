/** The radius of deck.gl's Earth, in meters. */
const RADIUS = 40.03e6 / (2 * Math.PI);
const RADIANS = Math.PI / 180;
/** deck.gl draws nothing nearer to the poles. */
const HIGHEST = 89.9;

/**
 * Meters to the east, to the north and upwards of an origin, from longitude, latitude and height. East and north
 * lie on the Web Mercator map, enlarged so that a meter is a meter at the origin. So shapes are those that deck.gl
 * draws. The farther from the origin's latitude, the more they differ from the ground's: by 0.3 % at 20 km, 45° north.
 */
export class LocalMeters {
  readonly #longitude: number;
  readonly #height: number;
  readonly #northing: number;
  readonly #scale: number;

  constructor([longitude = 0, latitude = 0, height = 0]: readonly number[]) {
    this.#longitude = longitude;
    this.#height = height;
    this.#northing = northing(latitude);
    this.#scale = RADIUS * Math.cos(RADIANS * clamped(latitude));
  }

  /** Meters around the middle of these points. */
  static amid(points: Float64Array): LocalMeters {
    const [least, most] = [
      [Infinity, Infinity],
      [-Infinity, -Infinity],
    ];
    for (let i = 0; i < points.length; i++) {
      const axis = i % 3;
      if (axis < 2 && Number.isFinite(points[i])) {
        least[axis] = Math.min(least[axis]!, points[i]!);
        most[axis] = Math.max(most[axis]!, points[i]!);
      }
    }
    const middle = least.map((x, axis) => (x + most[axis]!) / 2);
    return new LocalMeters(middle.every(Number.isFinite) ? middle : []);
  }

  of([longitude = NaN, latitude = NaN, height = 0]: Iterable<number>): [number, number, number] {
    const turn = longitude - this.#longitude;
    // A map repeats around the world.
    const nearest = Math.abs(turn) > 180 ? turn - 360 * Math.round(turn / 360) : turn;
    return [
      this.#scale * RADIANS * nearest,
      this.#scale * (northing(latitude) - this.#northing),
      height - this.#height,
    ];
  }
}

function northing(latitude: number): number {
  return Math.asinh(Math.tan(RADIANS * clamped(latitude)));
}

function clamped(latitude: number): number {
  return Math.min(Math.max(latitude, -HIGHEST), HIGHEST);
}
