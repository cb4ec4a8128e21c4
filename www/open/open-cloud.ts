import { WorkerPointCloud } from "hidden-point-removal/worker";
import { Inquiry } from "../ask/inquiry.ts";
import { WorkerCloud } from "../ask/worker-cloud.ts";
import type { Cloud, Up } from "../cloud/cloud.ts";
import { loadCloud, type LoadRequest } from "../loaders/index.ts";
import { type KnownSurface, NO_SURFACE, type Sample, usualLook } from "../samples/samples.ts";
import { type Against, OWN_COLORS, type Settings } from "../settings/settings.ts";
import { colorChoices } from "../view/colors.ts";
import { type AskedView, findHome, type Home, inReachOnly } from "../view/framing.ts";
import type { Opened } from "../view/viewer.ts";

/** What is to be opened, and how it is to be seen. */
export interface Wish {
  request: LoadRequest;
  sample: Sample | null;
  view: AskedView | null;
  /** Settings that belong to this cloud alone. */
  settings: Partial<Settings>;
}

/** Where it is to be shown. */
export interface Place {
  /** The settings as they are when the cloud has been loaded. */
  settings: () => Settings;
  /** Width by height of the picture. */
  aspect: () => number;
  /** What a sentence says of a place that is asked for: the view "in the address". */
  asked: string;
  /** Whether there are other clouds beside it, with which a small one shares a worker. */
  shared: boolean;
  signal: AbortSignal;
  onProgress: (step: string, fraction: number | null) => void;
}

/** A cloud that can be shown, and what changes with it. */
export interface Ready {
  opened: Opened;
  /** To be set before it is shown. */
  settings: Partial<Settings>;
  /** What it would be seen with if nothing were asked for. */
  usual: Pick<Settings, "size" | "fieldOfView" | "up">;
  /** The view asked for, where that can be had. */
  view: AskedView | null;
  /** Where it is first looked at from if that view is asked for. */
  homeFrom: (view: AskedView | null) => (up: Up) => Home;
  /** What was asked for and cannot be had. */
  refusals: string[];
  /** What the user has to know about the cloud. */
  notes: string[];
}

/** Fewer points than these are one worker's work anyway. */
const SHARED_BELOW = 200_000;

/** From what is wished for to a cloud with its first answer. Nothing is shown yet, and what fails leaves nothing behind. */
export async function openCloud(
  { request, sample, view: wanted, settings: wished }: Wish,
  place: Place,
): Promise<Ready> {
  const { signal, onProgress } = place;
  const { cloud, positions, copy, ...loaded } = await loadCloud(request, signal, (step, fraction) => {
    onProgress(`${step} ${request.name}.`, fraction);
  });
  onProgress(`Finding the visible points of ${request.name}.`, null);
  const usual = usualLook(sample, request.name, cloud.count, loaded.taken?.up);
  const { view, places, notes: farNotes } = inReachOnly(cloud, wanted, wished, place.asked);
  const own: Partial<Settings> = {
    ...usual,
    freeze: null,
    lights: [],
    ...radiusFor(place.settings()),
    ...wished,
    ...places,
  };
  const { color, notes: colorNote } = usableColor(
    own.color ?? place.settings().color,
    cloud,
    wished.color !== undefined,
  );
  own.color = color;
  const surface = surfaceOf(request, sample, loaded.isMesh);
  const { against, notes: againstNote } = usableAgainst(
    own.against ?? place.settings().against,
    surface,
    wished.against !== undefined,
  );
  own.against = against;

  const { fieldOfView: fov, up } = { ...usual, ...wished };
  const taken = loaded.taken?.from ? { at: loaded.taken.from, target: null } : null;
  const homeFrom = (asked: AskedView | null) => (upward: Up) => {
    const lens = { fov, aspect: place.aspect() };
    const sameUp = upward === up;
    return findHome(cloud, upward, sameUp ? sample : null, sameUp ? (asked ?? taken) : null, lens);
  };
  const home = homeFrom(view)(up);

  // The page keeps the file's own coordinates for the tools.
  const worker = await WorkerPointCloud.create(copy, {
    signal,
    transfer: true,
    shared: place.shared && cloud.count < SHARED_BELOW,
  });
  const another = async () => new WorkerCloud(await WorkerPointCloud.create(positions, { workers: 1 }), cloud.center);
  const inquiry = new Inquiry(new WorkerCloud(worker, cloud.center), another, cloud.radius);
  try {
    const answer = await inquiry.first(own.freeze ?? home.viewpoint, { ...place.settings(), ...own });
    signal.throwIfAborted();
    const opened = { cloud, positions, inquiry, home, answer, findHome: homeFrom(view), surface };
    return {
      opened,
      settings: own,
      usual,
      view,
      homeFrom,
      refusals: [...farNotes, ...colorNote, ...againstNote],
      notes: loaded.notes ?? [],
    };
  } catch (error) {
    inquiry.dispose();
    throw error;
  }
}

/** What the cloud before, or the address, was colored by may be something that this one does not have. */
export function usableColor(color: string, cloud: Cloud, asked: boolean): { color: string; notes: string[] } {
  if (colorChoices(cloud).some(({ value }) => value === color)) return { color, notes: [] };
  const notes = asked ? [`It has nothing called “${color}” to be colored by, so it has its usual colors.`] : [];
  return { color: OWN_COLORS, notes };
}

/** Of a mesh of one's own the faces are read again when they are asked for. */
function surfaceOf(request: LoadRequest, sample: Sample | null, isMesh = false): KnownSurface | string {
  if (isMesh && request.kind === "file") return { file: request.file };
  if (isMesh && request.kind === "url") return { file: request.url };
  return sample?.surface ?? NO_SURFACE;
}

/** Of some clouds no surface is known that ours could be compared with. */
function usableAgainst(
  against: Against,
  surface: KnownSurface | string,
  asked: boolean,
): { against: Against; notes: string[] } {
  if (against !== "surface" || typeof surface !== "string") return { against, notes: [] };
  return {
    against: "all",
    notes: asked ? [`There is no true surface to compare with, so all points are. ${surface}`] : [],
  };
}

/** A radius in units of the cloud before means nothing to the next one. */
function radiusFor({ radius }: Settings): Partial<Settings> {
  return "length" in radius ? { radius: { rule: "auto" } } : {};
}

/** The bytes of a sample are beside the page, or the module, with that address. */
export function requestFor(sample: Sample, base: string): LoadRequest {
  return "file" in sample.from
    ? { kind: "sample", name: sample.label, url: new URL(sample.from.file, base).href }
    : { kind: "shape", name: sample.label, shape: sample.from.shape };
}
