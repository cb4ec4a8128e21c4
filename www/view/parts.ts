/** The answers that a reference can give about a point. */
export const HIDDEN = 0;
export const VISIBLE = 1;
/** The point is outside the picture, so a z-buffer has no answer. */
export const OUTSIDE = 2;

/** Our answer beside the answer of a reference. */
export interface Parts {
  /**
   * All points in five parts, each in ascending order. `ends` holds the ends of the first four parts:
   *
   *     order   [ both see | only ours | only the reference | ours, outside | the rest ]
   */
  order: Uint32Array;
  ends: [both: number, onlyOurs: number, onlyReference: number, outside: number];
}

/** `said`: the reference's answer about each point. `ours`: our visible points, ascending. */
export function partsOf(said: Uint8Array, ours: Uint32Array): Parts {
  const kinds = new Uint8Array(said.length);
  const sizes = [0, 0, 0, 0, 0];
  for (let i = 0, next = 0; i < said.length; i++) {
    const isOurs = ours[next] === i;
    if (isOurs) next++;
    const kind = isOurs ? (said[i] === VISIBLE ? 0 : said[i] === HIDDEN ? 1 : 3) : said[i] === VISIBLE ? 2 : 4;
    kinds[i] = kind;
    sizes[kind]!++;
  }
  let end = 0;
  const [both, onlyOurs, onlyReference, outside] = sizes.map((size) => (end += size)) as [
    number,
    number,
    number,
    number,
    number,
  ];
  const at = [0, both, onlyOurs, onlyReference, outside];
  const order = new Uint32Array(said.length);
  for (let i = 0; i < kinds.length; i++) order[at[kinds[i]!]!++] = i;
  return { order, ends: [both, onlyOurs, onlyReference, outside] };
}
