import "./right.css";
import { methodOf, operatorOf, type ViewQuestion } from "../view/inquiry.ts";
import { nextFrame } from "../controls/controls.ts";
import { pictureFrom, picturesAround, Projected, VISIBLE, zBuffer } from "../compare/zbuffer.ts";
import { traced } from "../compare/truth.ts";
import type { KnownSurface } from "../samples/samples.ts";
import { USUAL_SETTINGS, type Viewpoint } from "../settings/settings.ts";
import { type Measured, measuredBy } from "../open/wishes.ts";
import type { Viewer } from "../view/viewer.ts";
import { make, openDialog, tableRow } from "../tools/make.ts";
import { THEMES } from "../view/theme.ts";

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
    ["One hull, automatic radius", { viewpoint: at, method: operatorOf(settings) }],
    ["Three looks, as on this page", { viewpoint: at, method: methodOf(settings) }],
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
  const said = zBuffer(projected, projected.splatFor(inquiry.cloud.spacing));
  const buffered = said.map((kind) => (kind === VISIBLE ? 1 : 0));
  const verdicts = [verdictOf("Z-buffer of this picture", buffered)];
  for (const [method, question] of questionsAt(at)) {
    const visibility = await inquiry.aside(question);
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
      const said = zBuffer(projected, projected.splatFor(inquiry.cloud.spacing));
      for (let point = 0; point < mask.length; point++) if (said[point] === VISIBLE) mask[point] = 1;
      // The dialog may be closed between two pictures.
      await nextFrame();
      signal.throwIfAborted();
    }
    note("Z-buffer of six pictures", mask, indices);
    for (const [method, question] of questionsAt(viewpoint)) {
      const visibility = await inquiry.aside(question);
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

const number = new Intl.NumberFormat("en-US");
const percent = (share: number) => `${(100 * share).toFixed(2)} %`;

/** The width of a picture in pixels, and what is left free at each of its edges. */
const WIDTH = 640;
const EDGE = 8;

/** Opens the judgment about the viewer's present cloud and viewpoint. Resolves when it is there, or when it is closed. */
export async function showRight(viewer: Viewer): Promise<void> {
  const closing = new AbortController();
  const body = make("div", {});
  const dialog = openDialog("right", "How right is it?", body);
  dialog.addEventListener("close", () => closing.abort());
  const { surface } = viewer.scene;
  const stations = judges(viewer);
  if (!surface && stations.length === 0) {
    body.append(
      make(
        "p",
        {},
        "Nobody knows which points of this cloud are visible in truth: it has no true surface, and no stations.",
      ),
    );
    return;
  }
  const progress = make("progress", { max: "1", "aria-label": "Judging" });
  const onProgress = (share: number) => (progress.value = share);
  const words = surface
    ? "A ray goes from the eye to each point. Those that the true surface stops are hidden."
    : "A station sees the points that it has measured. From each station, three methods are asked.";
  body.append(make("p", {}, words), progress);
  try {
    const judged = surface
      ? judgment(await judge(viewer, surface, onProgress, closing.signal))
      : byStations(await judgeByStations(viewer, stations, onProgress, closing.signal), stations.length);
    body.replaceChildren(...judged);
  } catch (error) {
    if (closing.signal.aborted) return;
    dialog.close();
    throw error;
  }
}

function byStations(verdicts: readonly StationVerdict[], count: number): Node[] {
  const [whose, they] =
    count === 1 ? ["The scan’s station sees", "it has"] : [`${count} stations of the scan see`, "they have"];
  return [
    make("p", {}, `${whose} the points that ${they} measured. A method that hides one of them is wrong.`),
    tableOf(
      ["Method", "Own points missed", "Of all points, shown"],
      verdicts.map(({ method, missed, shown }) => ({ method, shares: [missed, shown] })),
    ),
    make("p", { class: "note" }, "What a method shows wrongly, a scan cannot tell: one that shows more misses less."),
  ];
}

function judgment(judged: Judged): Node[] {
  const { verdicts, inside } = judged;
  const words = make(
    "p",
    {},
    `Rays from the eye to the true surface say which of the ${number.format(inside)} points in this picture are visible. Each method is wrong about some of them: `,
    swatch("--only-ours"),
    "shown although hidden, ",
    swatch("--only-reference"),
    "hidden although visible.",
  );
  const table = tableOf(
    ["Method", "Shown, but hidden", "Hidden, but visible", "Wrong"],
    verdicts.map(({ method, wrong, missed }) => ({
      method,
      shares: [wrong, missed, wrong + missed],
      error: wrong + missed,
    })),
  );
  const pictures = verdicts.map((verdict) =>
    make(
      "figure",
      {},
      drawn(judged, verdict),
      make("figcaption", {}, `${verdict.method}: ${percent(verdict.wrong + verdict.missed)} wrong`),
    ),
  );
  return [words, table, make("div", { class: "pictures" }, ...pictures)];
}

/** A table of shares. The row with the smallest error stands out, if errors are known. */
function tableOf(
  heads: readonly string[],
  rows: readonly { method: string; shares: number[]; error?: number }[],
): HTMLTableElement {
  const best = Math.min(...rows.map(({ error = 1 }) => error));
  const head = make("tr", {}, ...heads.map((text) => make("th", { scope: "col" }, text)));
  const body = rows.map(({ method, shares, error }) => {
    const row = tableRow(method, ...shares.map(percent));
    row.classList.toggle("best", error === best);
    return row;
  });
  return make("table", {}, make("thead", {}, head), make("tbody", {}, ...body));
}

function swatch(color: string): HTMLElement {
  const made = make("i");
  made.style.background = `var(${color})`;
  return made;
}

/** The points that a method shows, and its errors over them, in the part of the picture that has points. */
function drawn({ projected, truth }: Judged, { method, shown }: Verdict): HTMLCanvasElement {
  const { x, y, depth } = projected;
  const ends = (places: Float64Array) => {
    const inside = places.filter((_, i) => depth[i]! > 0);
    return [
      inside.reduce((a, b) => Math.min(a, b), Infinity) - EDGE,
      inside.reduce((a, b) => Math.max(a, b), 0) + EDGE,
    ];
  };
  const [[left, right], [top, bottom]] = [ends(x), ends(y)] as [[number, number], [number, number]];
  // A tower is no wider than it would be in a photo.
  const width = Math.max(right - left, (bottom - top) * 1.4);
  const scale = WIDTH / width;
  const canvas = make("canvas", {
    width: String(WIDTH),
    height: String(Math.round(scale * (bottom - top))),
    role: "img",
    "aria-label": `Errors: ${method}`,
  });
  const context = canvas.getContext("2d")!;
  context.translate(WIDTH / 2 - (scale * (left + right)) / 2, -scale * top);
  const theme = THEMES[document.documentElement.dataset["theme"] === "light" ? "light" : "dark"];
  // Errors are drawn last, so that nothing covers them.
  const draw = (color: string, side: number, isDrawn: (i: number) => boolean) => {
    context.fillStyle = color;
    for (let i = 0; i < depth.length; i++) {
      if (depth[i]! > 0 && isDrawn(i)) context.fillRect(scale * x[i]! - side / 2, scale * y[i]! - side / 2, side, side);
    }
  };
  draw(theme.hiddenDimmed, 1, (i) => shown[i] === 1 && truth[i] === 1);
  draw(theme.onlyReference, 2, (i) => shown[i] === 0 && truth[i] === 1);
  draw(theme.onlyOurs, 2, (i) => shown[i] === 1 && truth[i] === 0);
  return canvas;
}
