import "../styles/keys.css";
import type { Store } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import { copy } from "./export.ts";
import { button, make, openDialog } from "./make.ts";

/** Opens the code that shows the present view elsewhere. `link`: the address of the page; `null`: a file of this device. */
export function showUse(viewer: Viewer, store: Store, name: string, link: string | null): void {
  const { inquiry, answer } = viewer.scene;
  const { viewpoint, method } = answer.question;
  const src = link === null ? null : new URL(link).searchParams.get("src");
  // A sample of the page is no file that another program could read.
  const file = src === null ? (link === null ? name : "scan.laz") : new URL(src, document.baseURI).href;
  // Classes are left out by a mask, which is too long for a line of code.
  const options = JSON.stringify(inquiry.options(method), (key, value: unknown) => (key === "mask" ? undefined : value))
    .replaceAll(/"(\w+)":/g, " $1: ")
    .replace(/(.)}$/, "$1 }");
  const codes = {
    "npm package": [
      "// npm install hidden-point-removal",
      'import { init, PointCloud } from "hidden-point-removal";',
      'import { readCloud } from "hidden-point-removal/files";',
      "",
      "await init();",
      `const { positions } = await readCloud(${JSON.stringify(file)});`,
      "const cloud = new PointCloud(positions);",
      `const { indices, count } = cloud.visibleFrom([${viewpoint.join(", ")}], ${options});`,
    ],
    "three.js": [
      "// points: a THREE.Points with these positions",
      'import { HiddenPointFilter } from "hidden-point-removal/three";',
      "",
      `camera.position.set(${viewpoint.join(", ")});`,
      `camera.lookAt(${(viewer.target ?? viewer.cloud!.center).join(", ")});`,
      "camera.updateMatrixWorld();",
      `const filter = new HiddenPointFilter(points, ${options});`,
      "renderer.setAnimationLoop(() => {",
      "  filter.update(camera);",
      "  renderer.render(scene, camera);",
      "});",
    ],
    "HTML element": elementOf(link, name, viewpoint, store.current.up),
  };
  const said = make("output", {});
  const parts = Object.entries(codes).flatMap(([title, lines]) => {
    const code = lines.join("\n");
    const run = async () => {
      said.textContent = (await copy(code)) ? "Copied." : "The browser does not let this page copy; select the code.";
    };
    return [make("h3", {}, title), make("pre", { tabindex: "0" }, code), button(`Copy ${title}`, () => void run())];
  });
  openDialog("use", "Use in your page", ...parts, said);
}

/** The attributes of the element `<hidden-point-cloud>`, by their parameters in the address. */
const ATTRIBUTES: Readonly<Record<string, string>> = {
  sample: "sample",
  src: "src",
  points: "limit",
  view: "viewpoint",
  target: "target",
  size: "point-size",
  fov: "fov",
  up: "up",
  color: "color",
  hidden: "hidden-points",
  looks: "looks",
  exponent: "exponent",
  radius: "radius",
  inversion: "inversion",
};

/** The lines of a page that show what a link of this page shows, or a file of this device from this viewpoint. */
function elementOf(link: string | null, name: string, viewpoint: readonly number[], up: string): string[] {
  const searchParams =
    link === null ? new URLSearchParams({ src: name, view: viewpoint.join(), up }) : new URL(link).searchParams;
  const escaped = (text: string) => text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");
  const attributes = Object.entries(ATTRIBUTES).flatMap(([parameter, attribute]) => {
    const value = searchParams.get(parameter);
    if (value === null) return [];
    // In another page, an address must be a whole one.
    const isAddress = parameter === "src" && link !== null;
    return ` ${attribute}="${escaped(isAddress ? new URL(value, document.baseURI).href : value)}"`;
  });
  const module = new URL("hidden-point-cloud.js", document.baseURI).href;
  return [
    `<script type="module" src="${escaped(module)}"></script>`,
    `<hidden-point-cloud${attributes.join("")}></hidden-point-cloud>`,
  ];
}
