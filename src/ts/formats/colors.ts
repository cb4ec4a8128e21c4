import type { FilledColumn } from "./column.js";
import type { Values } from "./numbers.js";

/**
 * The display colors in bytes. A file may have bytes, shares of 1, or 16 bits, in which many programs write bytes.
 * Returns no colors if some are missing or all are black: then the file has the columns, but nobody has filled them in.
 */
export function displayColors(channels: readonly [Values, Values, Values]): Uint8Array<ArrayBuffer> | null {
  const scale = displayScale(channels);
  if (scale === 0) return null;
  const colors = new Uint8ClampedArray(3 * channels[0].length);
  channels.forEach((values, channel) => {
    for (let i = 0; i < values.length; i++) colors[3 * i + channel] = values[i]! * scale;
  });
  return new Uint8Array(colors.buffer);
}

/** The factor that makes bytes of colors; 0 if some are missing or all are black. */
export function displayScale(channels: readonly Values[]): number {
  let largest = 0;
  for (const values of channels) {
    for (const value of values) {
      if (!Number.isFinite(value)) return 0;
      if (value > largest) largest = value;
    }
  }
  if (largest === 0) return 0;
  return channels[0] instanceof Uint8Array ? 1 : largest <= 1 ? 255 : largest > 255 ? 255 / 65535 : 1;
}

/** The colors in bytes, if bytes hold all that the columns say. */
export function byteColors(columns: readonly FilledColumn[]): Uint8Array<ArrayBuffer> | null {
  const channels = ["red", "green", "blue"].map((color) => columns.find(({ name }) => name === color)?.values);
  const scale = channels[0] instanceof Uint8Array ? 1 : 257;
  const Type = scale === 1 ? Uint8Array : Uint16Array;
  if (!channels.every((values) => values instanceof Type && values.every((value) => value % scale === 0))) return null;
  const colors = new Uint8Array(3 * channels[0]!.length);
  for (let i = 0; i < colors.length; i++) colors[i] = channels[i % 3]![Math.floor(i / 3)]! / scale;
  return colors;
}

/** The factor of the first spherical harmonic, 1 ÷ (2 √π). */
const HARMONIC = 0.28209479177387814;

/** The colors of Gaussian splats, of which files keep the first harmonic. Null if they have none, or others besides. */
export function splatColors(columns: readonly FilledColumn[]): Uint8Array<ArrayBuffer> | null {
  const valuesOf = (wanted: string) => columns.find(({ name }) => name === wanted)?.values;
  const harmonics = [0, 1, 2].map((channel) => valuesOf(`f_dc_${channel}`));
  if (!harmonics.every((values) => values !== undefined) || valuesOf("red")) return null;
  const colors = new Uint8ClampedArray(3 * harmonics[0]!.length);
  for (let i = 0; i < colors.length; i++) {
    colors[i] = 255 * (0.5 + HARMONIC * harmonics[i % 3]![Math.floor(i / 3)]!);
  }
  return new Uint8Array(colors.buffer);
}
