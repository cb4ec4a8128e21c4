import type { Answers, Found, Query, QueryKind } from "../query/queries.js";
import { allocating, HprError, naming } from "../base/errors.js";
import type { Bindings, Instance } from "../instance/instance.js";
import { checkStations } from "../query/calibration.js";
import { newCounts, viewFrom } from "../query/surveys.js";
import { hasScores, resolvedInversion, type ViewSettings } from "../query/view-options.js";

/** A cloud in the memory of an instance. */
interface Target {
  instance: Instance;
  handle: number;
  dimension: number;
  length: number;
}

/** In the order of the core's numbers. */
const SURFACES = ["clean", "noisy", "layered"] as const;

type CoreAnswer = ReturnType<Bindings["visibleFrom"]>;

const performers: { [K in QueryKind]: (target: Target, query: Query<K>) => Answers[K] } = {
  visibleFrom: (target, { viewpoint, settings }) => {
    const { instance, handle, dimension } = target;
    const [x, y, z] = viewpoint as [number, number, number];
    const answer = instance.call((bindings) =>
      dimension > 3
        ? bindings.visibleFromSeveral(handle, Float64Array.from(viewpoint), 1, settings)
        : bindings.visibleFrom(handle, x, y, z, settings),
    );
    return found(target, settings, answer);
  },

  visibilityMap: ({ instance, handle }, { viewpoint, settings, map, camera }) => {
    const [x, y, z] = viewpoint;
    if (camera) map.set(instance.call((bindings) => bindings.cameraPlace(camera)).subarray(3), 1);
    return { ...instance.call((bindings) => bindings.visibilityMap(handle, x, y, z, settings, map)), viewpoint };
  },

  panorama: ({ instance, handle }, { viewpoint, settings, width, height, up }) => {
    const pixels = width * height;
    const { ranges, indices } = allocating(`${pixels} pixels`, () => ({
      ranges: new Float32Array(pixels),
      indices: new Uint32Array(pixels),
    }));
    const asked = Float64Array.of(...viewpoint, width, height, ...up);
    const areas = new Float64Array(2);
    instance.call((bindings) => {
      bindings.panorama(handle, asked, settings, ranges, indices, areas);
    });
    return { ranges, indices, skyViewFactor: areas[0]!, solidAngle: areas[1]! };
  },

  visibleFromDirection: (target, { direction, settings }) => {
    const [x, y, z] = direction as [number, number, number];
    const answer = target.instance.call((bindings) => bindings.visibleFromDirection(target.handle, x, y, z, settings));
    return found(target, settings, answer);
  },

  visibleFromSeveral: (target, { viewpoints, k, settings }) => {
    const { instance, handle } = target;
    const answer = instance.call((bindings) => bindings.visibleFromSeveral(handle, viewpoints, k, settings));
    return found(target, settings, answer);
  },

  visibleFromSeats: (target, { seats, k, settings }) => {
    const counts = newCounts(target.length);
    const views = seats.map((_, at): Found => {
      const { indices, ...view } = perform(target, viewFrom(seats, at, settings));
      for (const index of indices) counts[index]! += 1;
      return { ...view, indices: new Uint32Array(0) };
    });
    // Of several radii, the largest.
    const largest = views.reduce((a, b) => (b.radius > a.radius ? b : a));
    const evaluations = views.reduce((sum, view) => sum + view.evaluations, 0);
    const inverted = views.some((view) => view.inverted);
    return { ...largest, evaluations, inverted, indices: atLeast(counts, k) };
  },

  visibleFromCamera: (target, { camera, settings, towards = false }) => {
    const { instance, handle } = target;
    const place = (indices: Uint32Array) => {
      const shown = allocating(`${6 * indices.length} numbers`, () => new Float32Array(6 * indices.length));
      instance.call((bindings) => {
        bindings.project(handle, camera, indices, shown);
      });
      return shown;
    };
    // The camera is checked first.
    const viewpoint = [...instance.call((bindings) => bindings.cameraPlace(camera)).subarray(0, 3)];
    const seen = perform(target, { kind: "visibleFrom", viewpoint, settings });
    const inverted = instance.call((bindings) => bindings.seemsInverted(handle, camera));
    return { ...seen, ...inImage(seen.indices, place(seen.indices), towards), inverted };
  },

  sees: ({ instance, handle }, { viewpoint, positions, settings }) => {
    const [x, y, z] = viewpoint as [number, number, number];
    const seen = allocating(`${positions.length / 3} bytes`, () => new Uint8Array(positions.length / 3));
    instance.call((bindings) => {
      bindings.sees(handle, x, y, z, positions, settings, seen);
    });
    return { seen };
  },

  autoRadius: ({ instance, handle, dimension }, { viewpoint, settings }) => {
    const [x, y, z] = viewpoint as [number, number, number];
    return instance.call((bindings) =>
      dimension > 3
        ? bindings.hyperAutoRadius(handle, Float64Array.from(viewpoint), settings)
        : bindings.autoRadius(handle, x, y, z, settings),
    );
  },

  calibrate: ({ instance, handle, length }, query) => {
    checkStations(query, length);
    const { viewpoints, ends, indices, settings } = query;
    return instance.call((bindings) => bindings.calibrate(handle, viewpoints, ends, indices, settings));
  },

  noise: ({ instance, handle, dimension }) => ({
    noise: dimension > 3 ? 0 : instance.call((bindings) => bindings.noise(handle)),
  }),

  surface: ({ instance, handle, dimension }) => ({
    surface: SURFACES[dimension > 3 ? 0 : instance.call((bindings) => bindings.surface(handle))]!,
  }),

  reconstruct: (target, { viewpoint, settings, maxEdge }) => {
    const [x, y, z] = viewpoint as [number, number, number];
    const answer = target.instance.call((bindings) => bindings.reconstruct(target.handle, x, y, z, settings, maxEdge));
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
      bindings.illuminate(handle, lights, settings, triangles, smoothing, ambient, brightness);
    });
    return { brightness };
  },
};

/** The indices that were counted at least `k` times, ascending. */
function atLeast(counts: Uint32Array, k: number): Uint32Array<ArrayBuffer> {
  const number = counts.reduce((sum, count) => sum + Number(count >= k), 0);
  const indices = allocating(`${number} indices`, () => new Uint32Array(number));
  let next = 0;
  counts.forEach((count, index) => {
    if (count >= k) indices[next++] = index;
  });
  return indices;
}

/** The points that are in the image. `shown` holds x, y, the depth and the direction of each, which are 0 outside. */
function inImage(indices: Uint32Array<ArrayBuffer>, shown: Float32Array<ArrayBuffer>, towards: boolean) {
  let count = 0;
  for (let i = 0; i < indices.length; i++) {
    if (shown[6 * i + 2]! > 0) {
      indices[count] = indices[i]!;
      shown.copyWithin(6 * count, 6 * i, 6 * i + 6);
      count += 1;
    }
  }
  const numbers = (from: number, each: number) =>
    Float32Array.from({ length: each * count }, (_, k) => shown[6 * Math.floor(k / each) + from + (k % each)]!);
  return allocating(`${count} pixels`, () => ({
    indices: indices.slice(0, count),
    pixels: numbers(0, 2),
    depths: numbers(2, 1),
    ...(towards && { towards: numbers(3, 3) }),
  }));
}

/** Asks the core. */
export function perform<K extends QueryKind>(target: Target, query: Query<K>): Answers[K] {
  return naming(query.argument, () => performers[query.kind](target, query));
}

function found({ length }: Target, settings: ViewSettings, answer: CoreAnswer): Found {
  const { indices, radius, exponent, evaluations, scales } = answer;
  const found: Found = {
    indices,
    radius,
    exponent,
    evaluations,
    inversion: resolvedInversion(settings, scales),
    exact: answer.exact === 1,
    length,
  };
  return hasScores(settings) ? { ...found, scores: answer.scores } : found;
}
