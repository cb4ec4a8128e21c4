import "../styles/tool-card.css";
import "../styles/divider.css";
import { Vector3 } from "three";
import { upVector } from "../cloud/cloud.ts";
import { byId } from "../controls/controls.ts";
import { type Action, isKeyOf, pressed, shownKeys } from "../controls/keys.ts";
import type { MarkParameter } from "../settings/address.ts";
import type { Store } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import { Compare } from "./compare.ts";
import { Export, type ExportActions } from "./export.ts";
import { Information, ScaleBar } from "./information.ts";
import { type Bench, bindKeysSheet, isTyping, type Tool } from "./tool.ts";
import { Label } from "./label.ts";
import { linkOf, type Marked, restore } from "./link.ts";
import { Marks } from "./marks.ts";
import { Measure } from "./measure.ts";
import { onClick, Patience, spotOf, TOLERANCE } from "./pointer.ts";
import { PartControls } from "./part.ts";
import { Pick } from "./pick.ts";
import { pointAt, type Spot } from "./find.ts";
import { Select } from "./select.ts";
import { Stations } from "./stations.ts";

/** The bar over the cloud. At most one of its tools is active. The active tool receives the clicks or the drags. */
export class Tools {
  readonly #viewer: Viewer;
  readonly #tools: Tool[];
  readonly #marks: Marks;
  readonly #stage = byId("stage");
  readonly #canvas = byId("view", HTMLCanvasElement);
  readonly #through = byId("through", HTMLInputElement);
  readonly #compare: Compare;
  readonly #patience: Patience;
  readonly #information: Information;
  readonly #scaleBar: ScaleBar;
  readonly #marked: Marked;
  readonly #part: PartControls;
  #active: Tool | null = null;

  constructor(viewer: Viewer, store: Store, actions: ExportActions) {
    this.#viewer = viewer;
    this.#marks = new Marks(document.querySelector<SVGSVGElement>("#marks")!, viewer);
    this.#patience = new Patience(viewer);
    const bench: Bench = {
      viewer,
      marks: this.#marks,
      upward: () => upVector(store.current.up),
      pointAt: (spot) => {
        const through = bench.through();
        return pointAt(viewer, spot, through) ?? (through ? "No point there." : "No visible point there.");
      },
      through: () => this.#through.checked,
      name: actions.name,
      changed: actions.changed,
      whenFinal: (run, here) => this.#patience.whenFinal(run, here),
    };
    const select: Select = new Select(bench, this.#canvas, () => this.#active === select);
    const measure = new Measure(bench);
    const label = new Label(bench);
    const exports = new Export(
      bench,
      () => select.indices,
      actions,
      () => linkOf(this.#marked).left,
    );
    const stations = new Stations(bench, store, byId("stations-card"));
    this.#marked = { measure, label, stations };
    this.#tools = [new Pick(bench), measure, select, label, stations, exports];
    for (const tool of this.#tools) byId(`tool-${tool.name}`).addEventListener("click", () => this.#toggle(tool));
    for (const name of [...this.#tools.map((tool) => tool.name), "compare"] as const) {
      const [key, element] = [shownKeys(name).join(" "), byId(`tool-${name}`)];
      element.setAttribute("aria-keyshortcuts", key);
      element.title += ` (${key})`;
    }
    onClick(this.#canvas, (spot) => this.#click(spot));
    this.#canvas.addEventListener("dblclick", (event) => this.#goTo(spotOf(this.#canvas, event)));
    this.#compare = new Compare(viewer, store);
    this.#information = new Information(bench);
    this.#part = new PartControls(viewer, store, () => select.indices);
    if (viewer.cloud) this.#part.begin();
    this.#scaleBar = new ScaleBar(this.#marks.svg, viewer);
    bindKeysSheet();
    byId("tools").inert = false;
    this.#bindKeys(viewer);
  }

  /** Marks and stations for the address. */
  get marks(): Record<MarkParameter, string[]> {
    return linkOf(this.#marked).parameters;
  }

  /** The last distance, or how many points no station sees. `null`: it is not known. */
  figure(name: "distance" | "unseen"): number | null {
    const { measure, stations } = this.#marked;
    return name === "distance" ? measure.distance : stations.unseen;
  }

  /** Sets the marks of an address. Returns a sentence if some of them do not suit the cloud. */
  restore(search: string): string | null {
    return restore(search, this.#marked, this.#viewer.cloud!.count)
      ? null
      : "Some marks or stations in the address do not suit this cloud. They are left out.";
  }

  /** Called before another cloud is shown. */
  clear(): void {
    this.#patience.clear();
    for (const tool of this.#tools) tool.clear?.();
  }

  /** Called when a cloud is shown. */
  begin(): void {
    for (const tool of this.#tools) tool.begin?.();
    this.#part.begin();
  }

  /** Called when other points have become visible. */
  follow(): void {
    this.#marks.invalidate();
    this.#compare.follow();
  }

  /** Called every frame. */
  place(): void {
    this.#patience.follow();
    this.#marks.place();
    this.#information.follow();
    this.#scaleBar.place();
  }

  /** Lets the active tool use a click, as soon as it is certain which points are visible. */
  #click(spot: Spot): void {
    const tool = this.#active;
    if (!this.#viewer.cloud || !tool?.click) return;
    this.#patience.whenFinal(() => {
      if (tool === this.#active) tool.click!(spot);
    });
  }

  /** Flies to the point at a spot. While a tool uses the clicks, a double click is two of them. */
  #goTo(spot: Spot): void {
    const { cloud, navigation } = this.#viewer;
    if (!cloud || this.#active?.uses === "clicks") return;
    const index = pointAt(this.#viewer, spot, false);
    if (index !== null) navigation.goTo(new Vector3().fromArray(cloud.local, 3 * index));
  }

  #toggle(tool: Tool): void {
    this.#show(this.#active === tool ? null : tool);
  }

  #show(active: Tool | null): void {
    this.#active?.leave?.();
    this.#active = active;
    if (active) this.#stage.dataset["uses"] = active.uses;
    else delete this.#stage.dataset["uses"];
    for (const tool of this.#tools) {
      byId(`tool-${tool.name}`).setAttribute("aria-pressed", String(tool === active));
      byId(`${tool.name}-card`).hidden = tool !== active;
    }
    byId("tool-card").hidden = active === null;
    byId("through-choice").hidden = active?.uses === "nothing";
    active?.open?.();
  }

  #bindKeys(viewer: Viewer): void {
    const actions: Action[] = ["compare", "middle", ...this.#tools.map(({ name }) => name)];
    document.addEventListener("keydown", (event) => {
      const found = pressed(event, actions);
      if (!found || event.repeat || isTyping(event) || document.querySelector("dialog[open], #story")) return;
      if (found.action === "middle" && event.target !== this.#canvas) return;
      // The key opens the drawer, too.
      if (found.action !== "compare" && !byId("tools").checkVisibility()) byId("drawer").click();
      if (found.action === "compare") {
        this.#compare.toggle();
      } else if (found.action !== "middle") {
        this.#toggle(this.#tools.find(({ name }) => name === found.action)!);
      } else if (viewer.cloud) {
        // Otherwise the same press would submit the form that has just got the focus.
        event.preventDefault();
        const { width, height } = viewer.stage.size;
        // The middle of what nothing covers: the cloud is framed there.
        this.#click({ x: width / 2, y: (viewer.stage.shape.free * height) / 2, tolerance: TOLERANCE });
      }
    });
    this.#stage.addEventListener("keydown", (event) => {
      if (!isKeyOf("cancel", event) || !this.#active) return;
      // The key cancels a step that has begun. Without such a step, it ends the use of the tool.
      if (!this.#active.cancel?.()) this.#show(null);
      this.#canvas.focus();
    });
  }
}
