import type { CloudFile } from "./cloud-file.js";
import type { FilledColumn, Values } from "./numbers.js";

/**
 * The display colors in bytes. A file may have bytes, shares of 1, or 16 bits, in which many programs write bytes.
 * Returns no colors if all are black: then the file has the columns, but nobody has filled them in.
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

/** The factor that makes bytes of colors; 0 if all are black. Some programs write bytes times 256 into 16 bits. */
export function displayScale(channels: readonly Values[]): number {
  let largest = 0;
  let areBytes = true;
  for (const values of channels) {
    for (const value of values) {
      if (!Number.isFinite(value)) continue;
      if (value > largest) largest = value;
      if (value % 256 !== 0) areBytes = false;
    }
  }
  if (largest === 0) return 0;
  if (channels[0] instanceof Uint8Array) return 1;
  if (largest > 255) return areBytes ? 1 / 256 : 255 / 65535;
  return largest <= 1 ? 255 : 1;
}

const CHANNELS = ["red", "green", "blue"] as const;
/** How files call the colors, in small letters. CloudCompare's rf, gf and bf are shares of 1. */
const SPELLED: readonly ((channel: string) => string)[] = [
  (channel) => channel,
  (channel) => channel[0]!,
  (channel) => `${channel[0]!}f`,
  (channel) => `diffuse_${channel}`,
  (channel) => `color_${channel}`,
  (channel) => `color_${channel[0]!}`,
  (channel) => `${channel}_color`,
  (channel) => `color${channel}`,
];

/** The cloud with the usual names of its colors. Where only some points have a color, the others are white. */
export function withColors(cloud: CloudFile): CloudFile {
  const names = cloud.columns.map(({ name }) => name.toLowerCase());
  const places = SPELLED.map((spelled) => CHANNELS.map((channel) => names.indexOf(spelled(channel)))).find(
    (found) => !found.includes(-1),
  );
  if (places === undefined) return cloud;
  const channels = places.map((place) => cloud.columns[place]!.values);
  const missing = missingColors(channels);
  const white = filled(channels, missing);
  const columns = cloud.columns.map((column, place) => {
    const channel = places.indexOf(place);
    return channel < 0 ? column : { ...column, name: CHANNELS[channel]!, values: white[channel]! };
  });
  const says = `${missing.length} of its points have no color: they are white`;
  return { ...cloud, columns, notes: missing.length > 0 ? [...cloud.notes, says] : cloud.notes };
}

/** The points without a color, if others have one. */
function missingColors(channels: readonly Values[]): number[] {
  const [red, green, blue] = channels as [Values, Values, Values];
  const missing: number[] = [];
  for (let i = 0; i < red.length; i++) if (Number.isNaN(red[i]! + green[i]! + blue[i]!)) missing.push(i);
  return missing.length < red.length ? missing : [];
}

function filled(channels: readonly Values[], missing: readonly number[]): readonly Values[] {
  const scale = displayScale(channels);
  if (missing.length === 0 || scale === 0) return channels;
  for (const values of channels) for (const i of missing) values[i] = Math.round(255 / scale);
  const areBytes = scale === 1 && channels.every((values) => values.every((value) => Number.isInteger(value)));
  return areBytes ? channels.map((values) => Uint8Array.from(values)) : channels;
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
