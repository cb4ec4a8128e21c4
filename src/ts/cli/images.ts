// Reads the images of cameras with sharp.
import { stat } from "node:fs/promises";
import { basename, isAbsolute, join, relative, sep } from "node:path";

import type { TransferImage } from "../cloud/transfer.js";
import { InputProblem } from "./files.js";

const ENDINGS = ["", ".jpg", ".jpeg", ".png", ".JPG", ".JPEG", ".PNG"];

/**
 * The pixels of an image as they are in the file: gray ones of 8 or 16 bits, and otherwise red, green and blue. The file is
 * found in the folder by the name that the camera gives, with or without the folders in it, and the ending.
 */
export async function readImage(folder: string, image: string): Promise<TransferImage> {
  const name = await fileOf(folder, image);
  const { default: sharp } = await import("sharp").catch((cause: unknown) => {
    throw new InputProblem("--images reads images with sharp: npm install sharp", { cause });
  });
  try {
    const found = sharp(name);
    const { space, depth, hasAlpha } = await found.metadata();
    const isGray = /^(b-w|grey16)$/.test(space) && !hasAlpha;
    const pixels = found.toColourspace(isGray ? space : "srgb");
    const isDeep = isGray && depth === "ushort";
    const { data, info } = await pixels
      .raw({ depth: isDeep ? "ushort" : "uchar" })
      .toBuffer({ resolveWithObject: true });
    const { width, height, channels } = info;
    // The bytes are copied, so that they start where 16 bits may start.
    const bytes = Uint8Array.from(data);
    return { data: isDeep ? new Uint16Array(bytes.buffer) : bytes, width, height, channels };
  } catch (cause) {
    throw new InputProblem(`${name} cannot be read: ${(cause as Error).message}`, { cause });
  }
}

async function fileOf(folder: string, image: string): Promise<string> {
  const named = image.replaceAll("\\", "/");
  // The name comes from a file of cameras, which may be anybody's.
  const inside = relative(folder, join(folder, named));
  if (inside === ".." || inside.startsWith(`..${sep}`) || isAbsolute(named)) {
    throw new InputProblem(`the image ${image} of a camera lies outside of ${folder}`);
  }
  for (const name of new Set([named, basename(named)])) {
    for (const ending of ENDINGS) {
      const path = join(folder, name + ending);
      if ((await stat(path).catch(() => undefined))?.isFile() === true) return path;
    }
  }
  throw new InputProblem(image === "" ? "a camera has no image" : `${folder} has no image ${image}`);
}
