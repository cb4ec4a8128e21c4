// Pictures of a page, read in Node.
import sharp from "sharp";

/** Four bytes for each pixel: red, green, blue and opacity. */
export interface Pixels {
  data: Uint8Array;
  width: number;
  height: number;
}

export async function pixelsOf(image: Buffer): Promise<Pixels> {
  const { data, info } = await sharp(image).ensureAlpha().raw().toBuffer({ resolveWithObject: true });
  return { data, width: info.width, height: info.height };
}

/** How far apart a pixel of two pictures is in the channel that differs most. Pixels are counted in bytes. */
export function apart(one: Pixels, other: Pixels, at: number): number {
  return Math.max(...[0, 1, 2].map((channel) => Math.abs(one.data[at + channel]! - other.data[at + channel]!)));
}

/** How many pixels of two screenshots differ by more than a trace. */
export async function differentPixels(before: Buffer, after: Buffer): Promise<number> {
  const [one, other] = await Promise.all([pixelsOf(before), pixelsOf(after)]);
  let different = 0;
  for (let at = 0; at < one.data.length; at += 4) if (apart(one, other, at) > 8) different++;
  return different;
}
