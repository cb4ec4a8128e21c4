/**
 * Lets a class take part in `using`, on platforms that have it. On others, `Symbol.dispose` is
 * undefined, and a method written with that name would be called "undefined".
 */
export function addDisposeSymbol(prototype: { dispose(): unknown }): void {
  const { dispose } = Symbol as { dispose?: symbol };
  if (dispose !== undefined) {
    Object.defineProperty(prototype, dispose, {
      value(this: { dispose(): unknown }) {
        this.dispose();
      },
      configurable: true,
      writable: true,
    });
  }
}

/**
 * Gives the instances of a class a name of their own in `Object.prototype.toString`. Vue makes no proxy of
 * such an object (`reactive`, `ref`), and no proxy could reach private members. The name is written out,
 * because bundlers shorten the names of classes.
 */
export function addTag(prototype: object, name: string): void {
  Object.defineProperty(prototype, Symbol.toStringTag, { value: name, configurable: true });
}

/** Sets properties of an object. The result takes them back, except for those that somebody else has set since. */
export function override<T extends object>(object: T, own: Partial<T>): () => void {
  const names = Object.keys(own) as (keyof T & string)[];
  const before = names.map((name) => Object.getOwnPropertyDescriptor(object, name));
  Object.assign(object, own);
  return () => {
    for (const [i, name] of names.entries()) {
      if (object[name] !== own[name]) {
        continue;
      }
      if (before[i] === undefined) {
        Reflect.deleteProperty(object, name);
      } else {
        Object.defineProperty(object, name, before[i]);
      }
    }
  };
}
