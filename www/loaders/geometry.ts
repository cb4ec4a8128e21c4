import { type BufferAttribute, type BufferGeometry, Color, SRGBColorSpace } from "three";
import type { LoadedCloud } from "../cloud.ts";

/** The points of a geometry one of three's loaders made: every position once, whatever faces it may have. */
export function pointsOf(geometry: BufferGeometry, precision: "single" | "double"): LoadedCloud {
  const position = geometry.getAttribute("position") as BufferAttribute | undefined;
  if (!position) return { positions: new Float32Array(0), colors: null };
  const positions = precision === "single" ? new Float32Array(position.array) : new Float64Array(position.array);
  return { positions, colors: colorsOf(geometry, positions.length / 3) };
}

/** The loaders convert colors to linear light; the page draws them as the file shows them. */
function colorsOf(geometry: BufferGeometry, count: number): Uint8Array | null {
  const attribute = geometry.getAttribute("color") as BufferAttribute | undefined;
  if (!attribute || attribute.count !== count) return null;
  const colors = new Uint8Array(3 * count);
  const color = new Color();
  const shown = { r: 0, g: 0, b: 0 };
  for (let i = 0; i < count; i++) {
    color.fromBufferAttribute(attribute, i).getRGB(shown, SRGBColorSpace);
    // An OBJ file may color some vertices and not others: then there is no color for the whole.
    if (Number.isNaN(shown.r)) return null;
    colors[3 * i] = byte(shown.r);
    colors[3 * i + 1] = byte(shown.g);
    colors[3 * i + 2] = byte(shown.b);
  }
  return colors;
}

function byte(value: number): number {
  return Math.round(255 * Math.min(1, Math.max(0, value)));
}
