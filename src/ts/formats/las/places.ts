import { LAS_POINT_BYTES } from "./header.js";
import type { NumberType } from "../numbers.js";

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

/** For each point format (ASPRS, LAS Specification 1.4 R15): the places of its color and its time. */
const FORMATS: Record<number, { color?: number; time?: number; infrared?: number }> = {
  0: {},
  1: { time: 20 },
  2: { color: 20 },
  3: { time: 20, color: 28 },
  4: { time: 20 },
  5: { time: 20, color: 28 },
  6: { time: 22 },
  7: { time: 22, color: 30 },
  8: { time: 22, color: 30, infrared: 36 },
  9: { time: 22 },
  10: { time: 22, color: 30, infrared: 36 },
};

/** Where the numbers of a point format are, besides x, y and z. `null`: there is no such format. */
export function layoutOf(format: number): PointLayout | null {
  const layout = FORMATS[format];
  if (!layout) return null;
  const { color, time, infrared } = layout;
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
    bytes: LAS_POINT_BYTES[format]!,
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
