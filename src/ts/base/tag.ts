/**
 * Gives the instances of a class a name of their own in `Object.prototype.toString`. Vue makes no proxy of
 * such an object (`reactive`, `ref`), and no proxy could reach private members. The name is written out,
 * because bundlers shorten the names of classes.
 */
export function addTag(prototype: object, name: string): void {
  Object.defineProperty(prototype, Symbol.toStringTag, { value: name, configurable: true });
}
