import "./right.css";
import { button, make } from "../tools/make.ts";
import { THEMES } from "../view/theme.ts";
import type { Viewer } from "../view/viewer.ts";
import { judge, type Judged, type Verdict } from "./judge.ts";

const number = new Intl.NumberFormat("en-US");
const percent = (share: number) => `${(100 * share).toFixed(2)} %`;

/** The pixels of a picture for each of its CSS pixels, and its width. */
const WIDTH = 640;

/** Opens the judgment about the viewer's present cloud and viewpoint. Resolves when it is there, or when it is closed. */
export async function showRight(viewer: Viewer): Promise<void> {
  const closing = new AbortController();
  const body = make("div", {});
  const dialog = make(
    "dialog",
    { id: "right", tabindex: "-1", "aria-labelledby": "right-title" },
    make("h2", { id: "right-title" }, "How right is it?"),
    body,
    button("Close", () => {
      dialog.close();
    }),
  );
  dialog.addEventListener("close", () => {
    closing.abort();
    dialog.remove();
  });
  // A click beside it is a click on the dialog itself.
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  document.body.append(dialog);
  dialog.showModal();
  dialog.focus();

  const { surface } = viewer.scene;
  if (typeof surface === "string") {
    body.append(make("p", {}, `Nobody knows which points of this cloud are visible in truth. ${surface}`));
    return;
  }
  const progress = make("progress", { max: "1", "aria-label": "Tracing rays" });
  body.append(
    make("p", {}, "A ray goes from the eye to each point. Those that the true surface stops are hidden."),
    progress,
  );
  try {
    const judged = await judge(
      viewer,
      surface,
      (share) => {
        progress.value = share;
      },
      closing.signal,
    );
    body.replaceChildren(...judgment(judged));
  } catch (error) {
    if (closing.signal.aborted) return;
    dialog.close();
    throw error;
  }
}

function judgment(judged: Judged): Node[] {
  const { verdicts, inside } = judged;
  const best = Math.min(...verdicts.map(({ wrong, missed }) => wrong + missed));
  const words = make(
    "p",
    {},
    `Rays from the eye to the true surface say which of the ${number.format(inside)} points in this picture are visible. Each method is wrong about some of them: `,
    swatch("--only-ours"),
    "shown although hidden, ",
    swatch("--only-reference"),
    "hidden although visible.",
  );
  const table = make(
    "table",
    {},
    make(
      "thead",
      {},
      make(
        "tr",
        {},
        ...["Method", "Shown, but hidden", "Hidden, but visible", "Wrong"].map((text) =>
          make("th", { scope: "col" }, text),
        ),
      ),
    ),
    make("tbody", {}, ...verdicts.map((verdict) => rowOf(verdict, best))),
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

function rowOf({ method, wrong, missed }: Verdict, best: number): HTMLTableRowElement {
  const together = wrong + missed;
  const row = make("tr", {}, make("th", { scope: "row" }, method));
  for (const text of [wrong, missed, together].map(percent)) row.append(make("td", {}, text));
  row.classList.toggle("best", together === best);
  return row;
}

function swatch(color: string): HTMLElement {
  const made = make("i");
  made.style.background = `var(${color})`;
  return made;
}

/** The points that a method shows, and its errors over them. */
function drawn({ projected, truth }: Judged, { method, shown }: Verdict): HTMLCanvasElement {
  const { x, y, depth, picture } = projected;
  const scale = WIDTH / picture.width;
  const height = Math.round(scale * picture.height);
  const canvas = make("canvas", {
    width: String(WIDTH),
    height: String(height),
    role: "img",
    "aria-label": `Errors: ${method}`,
  });
  const context = canvas.getContext("2d")!;
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
