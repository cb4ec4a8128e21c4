import { BufferAttribute, DynamicDrawUsage, type InterleavedBufferAttribute } from "three";

import { allocating } from "../base/memory.js";
import type { Shades } from "./shades.js";
import { versionOf } from "./attribute.js";

/** The `color` of a geometry. */
export type ColorAttribute = BufferAttribute | InterleavedBufferAttribute;

interface Made {
  attribute: BufferAttribute;
  source: ColorAttribute | undefined;
  sourceVersion: number;
  shadesVersion: number;
}

/**
 * The colors of hidden points that are dimmed softly: red, green and blue of the points themselves, and
 * an opacity for each. Each camera has its own.
 */
export class SoftColors {
  readonly #made = new WeakMap<Shades, Made>();

  /** Nothing is written unless the colors or the shades have changed. White if the points have no colors. */
  of(shades: Shades, source: ColorAttribute | undefined): BufferAttribute {
    let made = this.#made.get(shades);
    if (made === undefined || made.source !== source) {
      const attribute = emptyFor(shades.opacities.length, source);
      made = { attribute, source, sourceVersion: -1, shadesVersion: -1 };
      this.#made.set(shades, made);
    }
    const sourceVersion = source === undefined ? 0 : versionOf(source);
    if (made.sourceVersion !== sourceVersion || made.shadesVersion !== shades.version) {
      made.sourceVersion = sourceVersion;
      made.shadesVersion = shades.version;
      write(made.attribute, shades.opacities, source);
    }
    return made.attribute;
  }
}

/** Colors of single bytes stay so. All others are kept in single precision. */
function emptyFor(count: number, source: ColorAttribute | undefined): BufferAttribute {
  const isSmall = source === undefined || (source.normalized && source.array.BYTES_PER_ELEMENT === 1);
  const numbers = allocating(`${count} colors`, () => new (isSmall ? Uint8Array : Float32Array)(4 * count));
  return new BufferAttribute(numbers, 4, isSmall).setUsage(DynamicDrawUsage);
}

function write(attribute: BufferAttribute, opacities: Uint8Array, source: ColorAttribute | undefined): void {
  const numbers = attribute.array;
  // One is 255 in normalized bytes.
  const one = attribute.normalized ? 255 : 1;
  const hasOpacity = source !== undefined && source.itemSize > 3;
  const count = Math.min(opacities.length, source?.count ?? opacities.length);
  for (let i = 0, to = 0; i < count; i++, to += 4) {
    numbers[to] = one * (source?.getX(i) ?? 1);
    numbers[to + 1] = one * (source?.getY(i) ?? 1);
    numbers[to + 2] = one * (source?.getZ(i) ?? 1);
    numbers[to + 3] = ((one * opacities[i]!) / 255) * (hasOpacity ? source.getW(i) : 1);
  }
  attribute.needsUpdate = true;
}
