import "./how.css";
import { hiddenPointRemoval, init, PointCloud } from "hidden-point-removal";
import { button, make, openDialog } from "../tools/make.ts";

const WORDS =
  "Every point is flipped out of a circle around the eye: the nearer it is, the farther it goes. The points on the convex hull of the flipped points are the ones that the eye sees. In space it is the same, with a sphere.";

/** A flower before a wall, as the eye at the origin sees them. */
const POINTS = [
  ...Array.from({ length: 44 }, (_, i) => {
    const turn = (2 * Math.PI * i) / 44;
    const radius = 1 + 0.42 * Math.cos(3 * turn);
    return [3 + radius * Math.cos(turn), radius * Math.sin(turn)] as const;
  }),
  ...Array.from({ length: 26 }, (_, i) => [5.2, -3.4 + (6.8 * i) / 25] as const),
];
const FARTHEST = Math.max(...POINTS.map((point) => Math.hypot(...point)));
/** The exponent of the slider's end, and how far from the automatic one an exponent is about right. */
const MOST = 3;
const NEAR = 0.4;

/** Opens the lesson: the same in the plane, where it can be drawn. */
export async function showHow(): Promise<void> {
  await init();
  const positions = Float64Array.from(POINTS.flat());
  const cloud = new PointCloud(positions, { dimension: 2 });
  const { exponent: automatic } = cloud.autoRadius([0, 0]);
  cloud.dispose();
  const [scene, flipped] = [picture("The points and the eye"), picture("The flipped points and their hull")] as const;
  scene.setAttribute("viewBox", "-0.5 -3.7 6.2 7.4");
  const slider = make("input", { id: "how-radius", type: "range", min: "0", max: String(MOST), step: "0.02" });
  const output = make("output", { for: "how-radius" });
  const says = make("p", { role: "status" });
  const show = () => {
    const exponent = slider.valueAsNumber;
    const radius = FARTHEST * 10 ** exponent;
    const seen = new Set(hiddenPointRemoval(positions, [0, 0], { dimension: 2, exponent }).indices);
    const away = POINTS.map(([x, y]) => {
      const factor = (2 * radius) / Math.hypot(x, y) - 1;
      return [factor * x, factor * y] as const;
    });
    // What is far away is drawn as small as all of it has to be.
    const size = Math.max(...away.flat().map(Math.abs));
    flipped.setAttribute("viewBox", `${-0.1 * size} ${-0.6 * size} ${1.2 * size} ${1.2 * size}`);
    draw(scene, POINTS, seen, 0.07);
    draw(flipped, away, seen, 0.01 * size, radius);
    output.value = `${radius < 10 * FARTHEST ? (radius / FARTHEST).toFixed(1) : Math.round(radius / FARTHEST).toLocaleString("en-US")} × the farthest distance`;
    slider.ariaValueText = output.value;
    says.textContent = `${seen.size} of ${POINTS.length} points are on the hull. ${verdict(exponent - automatic)}`;
  };
  const choose = () => {
    slider.value = String(automatic);
    show();
  };
  slider.addEventListener("input", show);
  openDialog(
    "how",
    "How it works",
    make("p", { class: "note" }, WORDS),
    make("div", { class: "pictures" }, scene, flipped),
    make("div", { class: "slider" }, make("label", { for: "how-radius" }, "Radius of the circle"), output, slider),
    says,
    button("Automatic radius", choose),
    " ",
  );
  choose();
}

function picture(label: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("role", "img");
  svg.ariaLabel = label;
  return svg;
}

/** The eye, the points, and with a radius the circle and the hull of the points that are on it. */
function draw(
  svg: SVGSVGElement,
  points: readonly (readonly [number, number])[],
  seen: ReadonlySet<number>,
  size: number,
  radius?: number,
): void {
  const dots = points.map(
    ([x, y], i) => `<circle class="${seen.has(i) ? "seen" : "hidden"}" cx="${x}" cy="${y}" r="${size}" />`,
  );
  const hull = points
    .filter((_, i) => seen.has(i))
    .sort((a, b) => Math.atan2(a[1], a[0]) - Math.atan2(b[1], b[0]))
    .map((point) => point.join())
    .join(" ");
  svg.innerHTML = `
    ${radius === undefined ? "" : `<circle class="circle" r="${radius}" /><polygon points="0,0 ${hull}" />`}
    ${dots.join("")}
    <circle class="eye" r="${3 * size}" />`;
}

/** What the radius does, by how far its exponent is from the automatic one. */
function verdict(above: number): string {
  if (above > NEAR) return "Too large: the flipped points are almost a circle, so the back is on the hull, too.";
  if (above < -NEAR) return "Too small: the hull passes over hollows, so visible points are missed.";
  return "About the automatic radius: the points of the front are on the hull, and those behind them inside it.";
}
