import type { NumberType } from "../../../src/ts/formats/numbers.js";

/** Where a point's number is in its record. The reader and the writer of LAS take it from the same table. */
export interface FieldPlace {
  name: string;
  type: NumberType;
  offset: number;
  /** The bits of a byte that belong to it, from the lowest one on. Without them, it has its own bytes. */
  bits?: readonly [first: number, count: number];
  /** Nobody colors points by it. */
  isDetail?: true;
}

export interface PointLayout {
  bytes: number;
  places: readonly FieldPlace[];
}

/** For each point format (ASPRS, LAS Specification 1.4 R15): its length, and the places of its color and its time. */
const FORMATS: Record<number, { bytes: number; color?: number; time?: number; infrared?: number }> = {
  0: { bytes: 20 },
  1: { bytes: 28, time: 20 },
  2: { bytes: 26, color: 20 },
  3: { bytes: 34, time: 20, color: 28 },
  4: { bytes: 57, time: 20 },
  5: { bytes: 63, time: 20, color: 28 },
  6: { bytes: 30, time: 22 },
  7: { bytes: 36, time: 22, color: 30 },
  8: { bytes: 38, time: 22, color: 30, infrared: 36 },
  9: { bytes: 59, time: 22 },
  10: { bytes: 67, time: 22, color: 30, infrared: 36 },
};

/** Where the numbers of a point format are, besides x, y and z. `null`: there is no such format. */
export function layoutOf(format: number): PointLayout | null {
  const layout = FORMATS[format];
  if (!layout) return null;
  const { bytes, color, time, infrared } = layout;
  const own = (name: string, type: NumberType, offset: number): FieldPlace => ({ name, type, offset });
  const shared = (name: string, offset: number, first: number, count: number): FieldPlace => ({
    name,
    type: "uint8",
    offset,
    bits: [first, count],
  });
  const detail = (place: FieldPlace): FieldPlace => ({ ...place, isDetail: true });
  const isNew = format >= 6;
  return {
    bytes,
    places: [
      ...(color === undefined
        ? []
        : ["red", "green", "blue"].map((channel, i) => own(channel, "uint16", color + 2 * i))),
      own("intensity", "uint16", 12),
      isNew ? own("classification", "uint8", 16) : shared("classification", 15, 0, 5),
      shared("return number", 14, 0, isNew ? 4 : 3),
      own("point source", "uint16", isNew ? 20 : 18),
      ...(time === undefined ? [] : [own("time", "float64", time)]),
      ...(infrared === undefined ? [] : [own("near infrared", "uint16", infrared)]),
      detail(isNew ? shared("number of returns", 14, 4, 4) : shared("number of returns", 14, 3, 3)),
      detail(isNew ? own("scan angle", "int16", 18) : own("scan angle", "int8", 16)),
      detail(own("user data", "uint8", 17)),
      detail(isNew ? shared("class flags", 15, 0, 4) : shared("class flags", 15, 5, 3)),
      ...(isNew ? [detail(shared("scanner channel", 15, 4, 2))] : []),
      detail(shared("scan direction", isNew ? 15 : 14, 6, 1)),
      detail(shared("edge of flight line", isNew ? 15 : 14, 7, 1)),
    ],
  };
}
