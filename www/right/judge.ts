import { operatorOf, type ViewQuestion, viewOf } from "../ask/question.ts";
import { nextFrame } from "../controls/dom.ts";
import { pictureFrom, picturesAround } from "../compare/picture.ts";
import { traced } from "../compare/truth.ts";
import { Projected, VISIBLE, zBuffer } from "../compare/zbuffer.ts";
import type { KnownSurface } from "../samples/samples.ts";
import { USUAL_SETTINGS, type Viewpoint } from "../settings/settings.ts";
import { type Measured, measuredBy } from "../open/stations.ts";
import type { Viewer } from "../view/viewer.ts";

/** What one method says about the points in the picture, beside the truth. */
export interface Verdict {
  method: string;
  /** For each point of the cloud: 1 if the method shows it. */
  shown: Uint8Array;
  /** Shares of the points in the picture: shown although they are hidden, and hidden although they are visible. */
  wrong: number;
  missed: number;
}

export interface Judged {
  /** The places of the points in the picture. */
  projected: Projected;
  /** The number of points in the picture. */
  inside: number;
  /** For each point of the cloud: 1 if a ray from the eye reaches it. */
  truth: Uint8Array;
  verdicts: Verdict[];
}

/** The questions of one hull and of looks, each with its name. */
function questionsAt(at: Viewpoint): [method: string, question: ViewQuestion][] {
  const settings = { ...USUAL_SETTINGS, looks: 3 as const };
  return [
    ["One hull, automatic radius", { ...viewOf(at, settings), method: operatorOf(settings) }],
    ["Three looks, as on this page", viewOf(at, settings)],
  ];
}

/**
 * Judges three methods by rays to the true surface, from the viewpoint of the last answer. Only the points in the picture
 * count, since a z-buffer knows no others. Rejects if the signal aborts.
 */
export async function judge(
  viewer: Viewer,
  surface: KnownSurface,
  onProgress: (share: number) => void,
  signal: AbortSignal,
): Promise<Judged> {
  const { scene } = viewer;
  const { cloud, inquiry } = scene;
  const at = scene.answer.question.viewpoint;
  const truth = await traced(scene, surface, at, signal, onProgress);

  const projected = new Projected(cloud.local, pictureFrom(viewer, at));
  const said = zBuffer(projected, projected.splatFor(inquiry.spacing));
  const buffered = said.map((kind) => (kind === VISIBLE ? 1 : 0));
  const verdicts = [verdictOf("Z-buffer of this picture", buffered)];
  for (const [method, question] of questionsAt(at)) {
    const { visibility } = await inquiry.aside(question);
    signal.throwIfAborted();
    verdicts.push(verdictOf(method, visibility.mask()));
  }
  const inside = projected.depth.reduce((sum, depth) => sum + (depth > 0 ? 1 : 0), 0);
  return { projected, inside, truth, verdicts };

  function verdictOf(method: string, shown: Uint8Array): Verdict {
    let [count, wrong, missed] = [0, 0, 0];
    for (const [i, depth] of projected.depth.entries()) {
      if (depth === 0) continue;
      count++;
      if (shown[i] === truth[i]) continue;
      if (shown[i]) wrong++;
      else missed++;
    }
    return { method, shown, wrong: wrong / count, missed: missed / count };
  }
}

/** Of the points that stations have measured, the share that a method misses from there; and the share of all that it shows. */
export interface StationVerdict {
  method: string;
  missed: number;
  shown: number;
}

/** More stations would take minutes with a large scan. */
const MOST_STATIONS = 4;

/** The stations that judge: all of them, or an even share. */
export function judges(viewer: Viewer): Measured[] {
  const all = measuredBy(viewer.scene);
  const step = Math.ceil(all.length / MOST_STATIONS);
  return all.filter((_, i) => i % step === 0);
}

/** Judges three methods by the stations of a scan: each surely sees the points that it has measured. */
export async function judgeByStations(
  viewer: Viewer,
  stations: readonly Measured[],
  onProgress: (share: number) => void,
  signal: AbortSignal,
): Promise<StationVerdict[]> {
  const { cloud, inquiry } = viewer.scene;
  const sums = new Map<string, { missed: number; shown: number }>();
  const own = stations.reduce((sum, { indices }) => sum + indices.length, 0);
  const note = (method: string, mask: Uint8Array, indices: Uint32Array) => {
    const { missed, shown } = sums.get(method) ?? { missed: 0, shown: 0 };
    sums.set(method, {
      missed: missed + indices.reduce((sum, index) => sum + 1 - mask[index]!, 0),
      shown: shown + mask.reduce((sum, one) => sum + one, 0),
    });
  };
  for (const [i, { viewpoint, indices }] of stations.entries()) {
    onProgress(i / stations.length);
    const mask = new Uint8Array(cloud.count);
    for (const picture of picturesAround(cloud, viewpoint)) {
      const projected = new Projected(cloud.local, picture);
      const said = zBuffer(projected, projected.splatFor(inquiry.spacing));
      for (let point = 0; point < mask.length; point++) if (said[point] === VISIBLE) mask[point] = 1;
      // The dialog may be closed between two pictures.
      await nextFrame();
      signal.throwIfAborted();
    }
    note("Z-buffer of six pictures", mask, indices);
    for (const [method, question] of questionsAt(viewpoint)) {
      const { visibility } = await inquiry.aside(question);
      signal.throwIfAborted();
      note(method, visibility.mask(), indices);
    }
  }
  return [...sums].map(([method, { missed, shown }]) => ({
    method,
    missed: missed / own,
    shown: shown / (stations.length * cloud.count),
  }));
}
