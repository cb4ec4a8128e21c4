/**
 * Writes the points of `now` into `order`: first those that are in `before`, too. Both lists are ascending. Returns how
 * many these are, and the points that are only in `before`.
 */
export function changeOf(
  before: Uint32Array,
  now: Uint32Array,
  order: Uint32Array,
): { kept: number; going: Uint32Array } {
  const going = new Uint32Array(before.length);
  let [kept, gone, end] = [0, 0, now.length];
  for (let i = 0, j = 0; i < before.length || j < now.length;) {
    const old = before[i] ?? Infinity;
    const next = now[j] ?? Infinity;
    if (old === next) order[kept++] = old;
    else if (old < next) going[gone++] = old;
    else order[--end] = next;
    if (old <= next) i++;
    if (next <= old) j++;
  }
  return { kept, going: going.slice(0, gone) };
}
