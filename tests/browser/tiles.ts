// One cloud in two tiled formats: a Potree octree of version 2, and 3D Tiles of .pnts.
import { bumpySphere } from "../package/support.js";

/** Coordinates are multiples of this, so that sums of offsets are exact. */
const UNIT = 1 / 1024;
/** The corner and the side length of the cube around all points. */
const CORNER = -2;
const SIDE = 4;
const LEVELS = 2;
/** Bits of x, y, z in the number of an eighth. */
const BITS = [4, 2, 1];

/** The files by their names. Potree's files are read in parts. */
export type Files = ReadonlyMap<string, Buffer>;
type Point = number[];

interface Cell {
  name: string;
  corner: Point;
  side: number;
  points: Point[];
  children: Cell[];
}

export function cloud(): Point[] {
  const numbers = Array.from(bumpySphere(3, 6000), (x) => Math.round(x / UNIT) * UNIT);
  return Array.from({ length: numbers.length / 3 }, (_, i) => numbers.slice(3 * i, 3 * i + 3));
}

/** Some of the points stay in the cell itself, as a coarser level. The others go to its eighths. */
function cellOf(name: string, corner: Point, side: number, points: Point[], levels: number): Cell {
  if (levels === 0) {
    return { name, corner, side, points, children: [] };
  }
  const half = side / 2;
  const eighths = new Map<number, Point[]>();
  for (const point of points.filter((_, i) => i % 5 !== 0)) {
    const number = BITS.reduce((sum, bit, axis) => sum + (point[axis]! >= corner[axis]! + half ? bit : 0), 0);
    eighths.set(number, [...(eighths.get(number) ?? []), point]);
  }
  const children = [...eighths]
    .sort(([a], [b]) => a - b)
    .map(([number, inside]) => {
      const low = corner.map((x, axis) => x + (number & BITS[axis]! ? half : 0));
      return cellOf(`${name}${number}`, low, half, inside, levels - 1);
    });
  return { name, corner, side, points: points.filter((_, i) => i % 5 === 0), children };
}

const rootCell = () => cellOf("r", [CORNER, CORNER, CORNER], SIDE, cloud(), LEVELS);

/** The cells in the order of a Potree hierarchy. */
function cellsBelow(root: Cell): Cell[] {
  const cells = [root];
  for (const { children } of cells) cells.push(...children);
  return cells;
}

export function potreeFiles(): Files {
  const cells = cellsBelow(rootCell());
  const hierarchy = Buffer.alloc(22 * cells.length);
  const octree = Buffer.from(
    Int32Array.from(
      cells.flatMap(({ points }) => points.flat()),
      (x) => x / UNIT,
    ).buffer,
  );
  let offset = 0;
  cells.forEach(({ points, children }, i) => {
    const size = 12 * points.length;
    hierarchy.writeUInt8(children.length === 0 ? 1 : 0, 22 * i);
    hierarchy.writeUInt8(
      children.reduce((mask, { name }) => mask | (1 << Number(name.at(-1))), 0),
      22 * i + 1,
    );
    hierarchy.writeUInt32LE(points.length, 22 * i + 2);
    hierarchy.writeBigInt64LE(BigInt(offset), 22 * i + 6);
    hierarchy.writeBigInt64LE(BigInt(size), 22 * i + 14);
    offset += size;
  });
  const [low, high] = [Array<number>(3).fill(CORNER), Array<number>(3).fill(CORNER + SIDE)];
  const metadata = {
    version: "2.0",
    name: "cloud",
    points: offset / 12,
    hierarchy: { firstChunkSize: hierarchy.length, stepSize: 4, depth: LEVELS },
    offset: [0, 0, 0],
    scale: [UNIT, UNIT, UNIT],
    spacing: 0.1,
    boundingBox: { min: low, max: high },
    encoding: "DEFAULT",
    attributes: [{ name: "position", size: 12, numElements: 3, elementSize: 4, type: "int32", min: low, max: high }],
  };
  return new Map([
    ["metadata.json", Buffer.from(JSON.stringify(metadata))],
    ["hierarchy.bin", hierarchy],
    ["octree.bin", octree],
  ]);
}

export function tilesFiles(): Files {
  const root = rootCell();
  const tileOf = ({ name, corner, side, children }: Cell): object => {
    const [x, y, z] = corner.map((low) => low + side / 2);
    const half = side / 2;
    return {
      boundingVolume: { box: [x, y, z, half, 0, 0, 0, half, 0, 0, 0, half] },
      geometricError: children.length === 0 ? 0 : side,
      refine: "ADD",
      content: { uri: `${name}.pnts` },
      children: children.map(tileOf),
    };
  };
  // The root's transform moves everything by whole numbers.
  const transform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 100, -20, 3, 1];
  const tileset = { asset: { version: "1.0" }, geometricError: 2 * SIDE, root: { ...tileOf(root), transform } };
  const files = cellsBelow(root).map((cell): [string, Buffer] => [`${cell.name}.pnts`, pntsOf(cell)]);
  return new Map([["tileset.json", Buffer.from(JSON.stringify(tileset))], ...files]);
}

function pntsOf({ corner, points }: Cell): Buffer {
  const local = Float32Array.from(points.flatMap((point) => point.map((x, axis) => x - corner[axis]!)));
  const json = JSON.stringify({ POINTS_LENGTH: points.length, RTC_CENTER: corner, POSITION: { byteOffset: 0 } });
  const table = Buffer.from(json.padEnd(Math.ceil((28 + json.length) / 8) * 8 - 28));
  const header = Buffer.alloc(28);
  header.write("pnts");
  header.writeUInt32LE(1, 4);
  header.writeUInt32LE(28 + table.length + local.byteLength, 8);
  header.writeUInt32LE(table.length, 12);
  header.writeUInt32LE(local.byteLength, 16);
  return Buffer.concat([header, table, Buffer.from(local.buffer)]);
}
