/**
 * What typed arrays are by themselves. Their own properties, their class and the
 * frame they come from may say something else.
 */
const prototype = Object.getPrototypeOf(Uint8Array.prototype) as Uint8Array;

type TypedArray = Uint8Array | Uint32Array | Float32Array | Float64Array;
type TypedArrayClass<T> = new (buffer: ArrayBufferLike, byteOffset: number, length: number) => T;

/** The name of a typed array's built-in type; undefined for anything else. */
export function typedArrayType(value: unknown): string | undefined {
  return ownGetter(Symbol.toStringTag, value) as string | undefined;
}

/**
 * The same memory in a plain typed array, which no subclass has a say in.
 * Undefined where the memory is gone: transferred away, or cut off by a resize.
 */
export function plainView<T extends TypedArray>(view: T, Plain: TypedArrayClass<T>): T | undefined {
  try {
    // Throws where the memory is gone, and does nothing else.
    prototype.keys.call(view);
  } catch {
    return undefined;
  }
  return new Plain(
    ownGetter("buffer", view) as ArrayBufferLike,
    ownGetter("byteOffset", view) as number,
    ownGetter("length", view) as number,
  );
}

function ownGetter(name: PropertyKey, value: unknown): unknown {
  return Object.getOwnPropertyDescriptor(prototype, name)?.get?.call(value);
}
