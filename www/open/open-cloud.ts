import { init } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import type { Up } from "../cloud/cloud.ts";
import { loadCloud, type LoadRequest } from "../loaders/index.ts";
import type { Sample } from "../samples/samples.ts";
import type { Settings } from "../settings/settings.ts";
import { type AskedView, findHome, type Home, inReachOnly, levelFrom } from "../view/framing.ts";
import { Inquiry, isHang } from "../view/inquiry.ts";
import { CloudPoints } from "../view/points.ts";
import { THEMES } from "../view/theme.ts";
import type { Opened } from "../view/viewer.ts";
import { usableColor, usualLook } from "./requests.ts";

/** A cloud to be opened, and the way in which it is to be shown. */
export interface CloudRequest {
  request: LoadRequest;
  sample: Sample | null;
  view: AskedView | null;
  /** Settings that belong to this cloud alone. */
  settings: Partial<Settings>;
}

/** The place in which the cloud will be shown. */
export interface Place {
  /** The settings at the moment when the cloud has been loaded. */
  settings: () => Settings;
  /** Width by height of the picture, and the share of its height that nothing covers. */
  shape: () => { aspect: number; free: number };
  /** The words in a sentence for a view that is asked for, such as "in the address". */
  asked: string;
  /** Whether a small cloud shares a worker with the other clouds of the document. */
  shared: boolean;
  signal: AbortSignal;
  onProgress: (step: string, fraction: number | null) => void;
  /** Called when a worker has got the cloud. The page's thread has nothing to do meanwhile. */
  onHanded?: () => void;
}

/** A cloud that can be shown, and everything that changes with it. */
export interface PreparedCloud {
  opened: Opened;
  /** The settings to be set before the cloud is shown. */
  settings: Partial<Settings>;
  /** The settings that the cloud has if nothing else is asked for. */
  usual: Pick<Settings, "size" | "fieldOfView" | "up">;
  /** The view that is asked for. `null` if no view is asked for, or if it is out of reach. */
  view: AskedView | null;
  /** Returns the first view, if this view is asked for, or the `whole` cloud with points that lie far away. */
  homeFrom: (view: AskedView | null, whole?: boolean) => (up: Up) => Home;
  /** The columns of a table that were taken for x, y and z, if other ones may have been meant. */
  columnsAt: readonly number[] | undefined;
  /** Sentences about requests that cannot be met. */
  refusals: string[];
  /** Sentences that the user has to read about the cloud. */
  notes: string[];
}

/** The field of view from a station, which stands among its points. */
const FROM_STATION = 65;
/** Below this number of points one worker is enough. */
const SHARED_BELOW = 200_000;
/**
 * With two cores, one worker answers. A second one would delay the first picture: it sorts the same points, while the
 * first picture is drawn, and each view is one worker's work.
 */
const hasFewCores = () => navigator.hardwareConcurrency <= 2;

/** Loads a cloud and finds its first answer. Nothing is shown yet, and a failure leaves nothing behind. */
export async function openCloud(
  { request, sample, view: wanted, settings: wished }: CloudRequest,
  place: Place,
): Promise<PreparedCloud> {
  const { signal, onProgress } = place;
  // The ending of a file's name tells which way is up.
  const { name } = request.kind === "files" ? request.files[0]! : request;
  // The WebAssembly is downloaded beside the cloud. If that fails, the error is reported when the cloud needs it.
  init().catch(() => undefined);
  const { cloud, positions, copy, ...loaded } = await loadCloud(request, signal, (step, fraction) => {
    onProgress(sentence(step, request.name, fraction), fraction);
  });
  const stations = loaded.taken?.stations ?? [];
  const [station] = stations;
  const alone = stations.length === 1 ? station : undefined;
  const usual = {
    ...usualLook(sample, name, loaded.taken?.up, cloud),
    ...(alone && { fieldOfView: FROM_STATION }),
  };
  const { view, places, notes: farNotes } = inReachOnly(cloud, wanted, wished, place.asked);
  const own: Partial<Settings> = {
    ...usual,
    ...leaving(place.settings()),
    ...wished,
    ...places,
  };
  const { color, notes: colorNote } = usableColor(
    own.color ?? place.settings().color,
    cloud,
    wished.color !== undefined,
  );
  own.color = color;
  const classNotes: string[] = [];
  if (own.without && !cloud.attributes.some(({ name: column }) => column === own.without!.column)) {
    classNotes.push(`The cloud has no “${own.without.column}”, so no class is left out.`);
    own.without = null;
  }
  const { fieldOfView: fov, up } = { ...usual, ...wished };
  const homeFrom = (asked: AskedView | null, whole?: boolean) => (upward: Up) => {
    const lens = { fov, ...place.shape() };
    const taken = alone ? { at: alone.viewpoint, target: levelFrom(cloud, alone.viewpoint, upward) } : null;
    const sameUp = upward === up;
    return findHome(cloud, upward, sameUp ? sample : null, (sameUp ? asked : null) ?? taken, lens, whole);
  };
  const home = homeFrom(view)(up);
  // The worker takes the copy. The page keeps the file's own coordinates for the tools.
  const shared = place.shared && cloud.count < SHARED_BELOW;
  const made = (given: Float32Array | Float64Array, report: (fraction: number) => void) =>
    WorkerPointCloud.create(given, {
      signal,
      transfer: true,
      ...(shared ? { shared } : hasFewCores() ? { workers: 1 } : {}),
      onProgress: report,
    });
  const report = (fraction: number) => onProgress(sentence("Preparing", request.name, fraction), fraction);
  // A worker that hangs is replaced once.
  const making = made(copy, report).catch((error: unknown) => {
    if (!isHang(error)) throw error;
    return made(positions.slice(), report);
  });
  place.onHanded?.();
  const worker = await making;
  onProgress(`Finding the visible points of ${request.name}.`, null);
  const another = () => WorkerPointCloud.create(positions.slice(), { workers: 1, transfer: true });
  const points = new CloudPoints(cloud, THEMES.dark);
  const inquiry = new Inquiry(worker, another, points, positions);
  try {
    const answer = await inquiry.first(own.freeze ?? home.viewpoint, { ...place.settings(), ...own });
    signal.throwIfAborted();
    const opened = {
      cloud,
      points,
      positions,
      inquiry,
      home,
      answer,
      findHome: homeFrom(view),
      ...(sample?.surface && { surface: sample.surface }),
    };
    return {
      opened,
      settings: own,
      usual,
      view,
      homeFrom,
      columnsAt: loaded.columnsAt,
      refusals: [...farNotes, ...colorNote, ...classNotes],
      notes: loaded.notes ?? [],
    };
  } catch (error) {
    inquiry.dispose();
    throw error;
  }
}

function sentence(step: string, name: string, fraction: number | null): string {
  return `${step} ${name}${fraction === null ? "" : `: ${Math.floor(100 * fraction)}\u00a0%`}.`;
}

/** The settings without those of the cloud before: lengths in its units, a frozen eye, and the ghosts around that eye. */
function leaving({ radius, freeze, hidden }: Settings): Partial<Settings> {
  return {
    freeze: null,
    box: null,
    without: null,
    thickness: "auto",
    ...("length" in radius && { radius: { rule: "auto" } }),
    ...(freeze && hidden === "dimmed" && { hidden: "off" }),
  };
}
