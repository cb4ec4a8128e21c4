/**
 * The true properties of typed arrays. Their own properties, their class and the frame that they
 * come from may hide these.
 */
const prototype = Object.getPrototypeOf(Uint8Array.prototype) as Uint8Array;

/** A typed array of numbers that positions may be read from. */
export type NumberArray =
  | Int8Array
  | Uint8Array
  | Uint8ClampedArray
  | Int16Array
  | Uint16Array
  | Int32Array
  | Uint32Array
  | Float32Array
  | Float64Array;
type TypedArrayClass<T> = new (buffer: ArrayBufferLike, byteOffset: number, length: number) => T;

/** The constructors by name. Float16Array is left out: not every platform has it. */
const NUMBER_ARRAYS = new Map<string | undefined, TypedArrayClass<NumberArray>>([
  ["Int8Array", Int8Array],
  ["Uint8Array", Uint8Array],
  ["Uint8ClampedArray", Uint8ClampedArray],
  ["Int16Array", Int16Array],
  ["Uint16Array", Uint16Array],
  ["Int32Array", Int32Array],
  ["Uint32Array", Uint32Array],
  ["Float32Array", Float32Array],
  ["Float64Array", Float64Array],
]);

/** The name of a typed array's built-in type; undefined for anything else. */
export function typedArrayType(value: unknown): string | undefined {
  return ownGetter(Symbol.toStringTag, value) as string | undefined;
}

export function isNumberArray(value: unknown): value is NumberArray {
  return NUMBER_ARRAYS.has(typedArrayType(value));
}

/** {@link plainView} for an array whose type is known only at run time. */
export function plainNumbers(view: NumberArray): NumberArray | undefined {
  return plainView(view, NUMBER_ARRAYS.get(typedArrayType(view))!);
}

/**
 * The same memory in a plain typed array, which no subclass can change. Undefined if the memory is
 * gone: transferred away, or cut off by a resize.
 */
export function plainView<T extends NumberArray>(view: T, Plain: TypedArrayClass<T>): T | undefined {
  try {
    // This throws if the memory is gone, and has no other effect.
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
