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
