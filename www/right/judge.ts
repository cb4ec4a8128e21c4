import { operatorOf, viewOf } from "../ask/question.ts";
import { pictureFrom } from "../compare/picture.ts";
import { traced } from "../compare/truth.ts";
import { Projected, VISIBLE, zBuffer } from "../compare/zbuffer.ts";
import type { KnownSurface } from "../samples/samples.ts";
import { USUAL_SETTINGS } from "../settings/settings.ts";
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
  const settings = { ...USUAL_SETTINGS, looks: 3 as const };
  for (const [method, question] of [
    ["One hull, automatic radius", { ...viewOf(at, settings), method: operatorOf(settings) }],
    ["Three looks, as on this page", viewOf(at, settings)],
  ] as const) {
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
