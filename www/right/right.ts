import "./right.css";
import { methodOf, operatorOf } from "../view/inquiry.ts";
import { errorsOf, pictureFrom, Projected, VISIBLE, zBuffer } from "../compare/zbuffer.ts";
import { traced } from "../compare/truth.ts";
import type { KnownSurface } from "../samples/samples.ts";
import { USUAL_SETTINGS } from "../settings/settings.ts";
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

/**
 * Judges three methods by rays to the true surface, from the viewpoint of the last answer. Only the points in the picture
 * count, since a z-buffer knows no others. Rejects if the signal aborts.
 */
export async function judge(viewer: Viewer, surface: KnownSurface, signal: AbortSignal): Promise<Judged> {
  const { scene } = viewer;
  const { cloud, inquiry } = scene;
  const at = scene.answer.question.viewpoint;
  const truth = await traced(scene, surface, at, signal);

  const projected = new Projected(cloud.local, pictureFrom(viewer, at));
  const said = zBuffer(projected, projected.splatFor(inquiry.cloud.spacing));
  const buffered = said.map((kind) => (kind === VISIBLE ? 1 : 0));
  const verdictOf = (method: string, shown: Uint8Array): Verdict => ({
    method,
    shown,
    ...errorsOf(projected, shown, truth),
  });
  const verdicts = [verdictOf("Z-buffer of this picture", buffered)];
  const settings = { ...USUAL_SETTINGS, looks: 3 as const };
  for (const [name, method] of [
    ["One hull, automatic radius", operatorOf(settings)],
    ["Three looks, as on this page", methodOf(settings)],
  ] as const) {
    const visibility = await inquiry.aside({ viewpoint: at, method });
    signal.throwIfAborted();
    verdicts.push(verdictOf(name, visibility.mask()));
  }
  const inside = projected.depth.reduce((sum, depth) => sum + (depth > 0 ? 1 : 0), 0);
  return { projected, inside, truth, verdicts };
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
  if (!surface) {
    body.append("Nobody knows which points of this cloud are visible in truth: it has no true surface.");
    return;
  }
  const words = "A ray goes from the eye to each point. Those that the true surface stops are hidden.";
  body.append(make("p", {}, words), make("progress", { "aria-label": "Judging" }));
  try {
    body.replaceChildren(...judgment(await judge(viewer, surface, closing.signal)));
  } catch (error) {
    if (closing.signal.aborted) return;
    dialog.close();
    throw error;
  }
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
  const pictures = verdicts.map((verdict) =>
    make(
      "figure",
      {},
      drawn(judged, verdict),
      make("figcaption", {}, `${verdict.method}: ${percent(verdict.wrong + verdict.missed)} wrong`),
    ),
  );
  return [words, tableOf(verdicts), make("div", { class: "pictures" }, ...pictures)];
}

/** The shares of errors. The row with the fewest stands out. */
function tableOf(verdicts: readonly Verdict[]): HTMLTableElement {
  const best = Math.min(...verdicts.map(({ wrong, missed }) => wrong + missed));
  const heads = ["Method", "Shown, but hidden", "Hidden, but visible", "Wrong"];
  const head = make("tr", {}, ...heads.map((text) => make("th", { scope: "col" }, text)));
  const body = verdicts.map(({ method, wrong, missed }) => {
    const row = tableRow(method, ...[wrong, missed, wrong + missed].map(percent));
    row.classList.toggle("best", wrong + missed === best);
    return row;
  });
  return make("table", {}, make("thead", {}, head), make("tbody", {}, ...body));
}

function swatch(color: string): HTMLElement {
  const made = make("span", { class: "swatch" });
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
