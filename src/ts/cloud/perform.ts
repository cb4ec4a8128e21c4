import type { Answers, Found } from "../query/answers.js";
import { HprError } from "../base/errors.js";
import type { Bindings, Instance } from "../instance/instance.js";
import { allocating } from "../base/memory.js";
import type { Query, QueryKind } from "../query/queries.js";
import { roomIn, type Spares } from "./spares.js";
import { resolvedInversion, type ViewSettings } from "../query/view-options.js";

/** A cloud in the memory of an instance. */
interface Target {
  instance: Instance;
  handle: number;
  dimension: number;
  length: number;
  /** These may hold memory for the answer's indices. */
  spares: Spares;
}

type CoreAnswer = ReturnType<Bindings["visibleFrom"]>;

const performers: { [K in QueryKind]: (target: Target, query: Query<K>) => Answers[K] } = {
  visibleFrom: (target, { viewpoint, settings, sector }) => {
    const { instance, handle, dimension } = target;
    const [x, y, z] = viewpoint as [number, number, number];
    const options = coreOptions(settings, target.spares);
    const answer = instance.call((bindings) => {
      if (dimension > 3) {
        return bindings.hyperVisibleFrom(handle, Float64Array.from(viewpoint), 1, options);
      }
      return sector === undefined
        ? bindings.visibleFrom(handle, x, y, z, options)
        : bindings.visibleInSector(handle, x, y, z, options, sector.number, sector.count);
    });
    return found(target, settings, answer);
  },

  visibleFromDirection: (target, { direction, settings }) => {
    const [x, y, z] = direction as [number, number, number];
    const options = coreOptions(settings, target.spares);
    const answer = target.instance.call((bindings) => bindings.visibleFromDirection(target.handle, x, y, z, options));
    return found(target, settings, answer);
  },

  visibleFromSeveral: (target, { viewpoints, k, settings }) => {
    const { instance, handle, dimension } = target;
    const options = coreOptions(settings, target.spares);
    const answer = instance.call((bindings) =>
      dimension > 3
        ? bindings.hyperVisibleFrom(handle, viewpoints, k, options)
        : bindings.visibleFromSeveral(handle, viewpoints, k, options),
    );
    return found(target, settings, answer);
  },

  autoRadius: ({ instance, handle, dimension }, { viewpoint, settings }) => {
    const [x, y, z] = viewpoint as [number, number, number];
    return instance.call((bindings) =>
      dimension > 3
        ? bindings.hyperAutoRadius(handle, Float64Array.from(viewpoint), coreOptions(settings))
        : bindings.autoRadius(handle, x, y, z, coreOptions(settings)),
    );
  },

  reconstruct: (target, { viewpoint, settings, maxEdge }) => {
    const [x, y, z] = viewpoint as [number, number, number];
    const options = coreOptions(settings, target.spares);
    const answer = target.instance.call((bindings) => bindings.reconstruct(target.handle, x, y, z, options, maxEdge));
    return { ...found(target, settings, answer), triangles: answer.triangles };
  },

  illuminate: ({ instance, handle, length }, { lights, settings, triangles, smoothing, ambient }) => {
    const stray = triangles?.findIndex((index) => index >= length) ?? -1;
    if (stray >= 0) {
      throw new HprError(
        "option",
        `triangles[${stray}] must be the index of a point, below ${length}, got ${triangles![stray]!}`,
      );
    }
    const brightness = allocating(`${length} numbers`, () => new Float32Array(length));
    instance.call((bindings) => {
      bindings.illuminate(handle, lights, coreOptions(settings), triangles, smoothing, ambient, brightness);
    });
    return { brightness };
  },
};

/** Asks the core. */
export function perform<K extends QueryKind>(target: Target, query: Query<K>): Answers[K] {
  return performers[query.kind](target, query);
}

/** A view's settings as the core reads them. The core calls `memory` for its arrays, first for the indices. */
export function coreOptions(settings: ViewSettings, spares?: Spares) {
  let left = spares;
  const memory = (length: number) => {
    const spare = left?.take();
    left = undefined;
    return roomIn(spare, length);
  };
  return { ...settings, memory };
}

function found({ length }: Target, settings: ViewSettings, answer: CoreAnswer): Found {
  const { indices, radius, exponent, evaluations, scales } = answer;
  const found: Found = {
    indices,
    radius,
    exponent,
    evaluations,
    inversion: resolvedInversion(settings, scales),
    exact: !settings.draft && settings.sample === 0,
    length,
  };
  return settings.scores ? { ...found, scores: answer.scores } : found;
}
