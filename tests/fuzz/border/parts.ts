// What a question about some points of a cloud answers, as of a cloud of these points alone.
import type { VisibilityMap } from "hidden-point-removal";
import { require } from "./outcome.js";
import type { Part } from "./table.js";

const NONE = 2 ** 32 - 1;

type Fields = Record<string, ArrayLike<number> & Iterable<number>>;

/**
 * An answer in the numbers of a cloud of the part alone. For the others it must say that they are not there.
 * `places`: where a map is asked what it hides.
 */
export function inPart(name: string, answer: unknown, part: Part, places: Float32Array = new Float32Array()): unknown {
  const others = Array.from({ length: part.length }, (_, i) => i).filter((i) => !part.points.includes(i));
  const silent = (values: ArrayLike<number>, none: number) => {
    const told = others.filter((i) => !Object.is(values[i], none));
    require(told.length === 0, `${name} tells of points that are not there: ${told.join()}`);
  };
  if (name === "coverage" || name === "illuminate") {
    if (name === "coverage") silent(answer as Uint32Array, 0);
    return part.of(answer as Uint32Array);
  }
  if (name === "visibilityMap") {
    const map = answer as VisibilityMap;
    return [map.viewpoint, map.hides(places)];
  }
  if (typeof answer !== "object" || answer === null || ArrayBuffer.isView(answer)) return answer;
  const fields: Record<string, unknown> = { ...answer };
  const { indices, triangles, scores, seen, unseen, values, offsets } = answer as Fields;
  if (triangles !== undefined) fields["triangles"] = part.own(triangles);
  if (scores !== undefined) fields["scores"] = part.of(scores);
  if (name === "panorama") {
    fields["indices"] = Array.from(indices!, (index) => (index === NONE ? NONE : (part.own([index])[0] ?? -1)));
  } else if (indices !== undefined) {
    fields["indices"] = part.own(indices);
    require(part.own(indices).length === indices.length, `${name} sees points that are not there`);
  }
  if (unseen !== undefined) Object.assign(fields, { seen: part.own(seen!), unseen: part.own(unseen) });
  if (values !== undefined) {
    silent(seen!, 0);
    Object.assign(fields, { values: part.of(values), seen: part.of(seen!) });
  }
  if (offsets !== undefined) {
    const counts = Array.from({ length: part.length }, (_, i) => offsets[i + 1]! - offsets[i]!);
    silent(counts, 0);
    fields["offsets"] = part.of(counts);
  }
  delete fields["options"];
  return fields;
}
