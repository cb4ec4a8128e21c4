/** The indices below `count` that pass the test, ascending. */
export function indicesWhere(count: number, test: (index: number) => boolean): Uint32Array {
  const found = new Uint32Array(count);
  let size = 0;
  for (let i = 0; i < count; i++) if (test(i)) found[size++] = i;
  return found.slice(0, size);
}
