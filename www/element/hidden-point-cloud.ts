import type { TimedView } from "../view/inquiry.ts";
import { SETTINGS } from "../settings/table.ts";
import { canDraw } from "../view/theme.ts";
import type * as Api from "./api.ts";
import {
  adoptEarly,
  ATTRIBUTE_NAMES,
  placeOf,
  Problem,
  readAttributes,
  type Reading,
  reflect,
  SOURCES,
  valueOf,
  write,
} from "./attributes.ts";
import { Frame } from "./frame.ts";
import { type Listener, Pointing, Showing } from "./showing.ts";

type Events = Api.HiddenPointCloudEventMap;
type Reflected = Exclude<
  keyof Api.HiddenPointCloudElement,
  | keyof HTMLElement
  | "viewpoint"
  | "target"
  | "state"
  | "ready"
  | "count"
  | "visibleCount"
  | "visible"
  | "reset"
  | "pick"
  | "project"
  | "toBlob"
>;
type Own = Omit<Api.HiddenPointCloudElement, keyof HTMLElement | Reflected>;

/** A picture is nearly in sight at this distance from the window, in heights of it. */
const NEAR = 0.5;

/** A server has no elements. There, importing this module defines the class and does nothing else. */
const Base = "HTMLElement" in globalThis ? HTMLElement : (Object as unknown as typeof HTMLElement);

class HiddenPointCloud extends Base implements Own {
  static readonly observedAttributes: readonly string[] = ATTRIBUTE_NAMES;

  readonly #frame = new Frame(this.attachShadow({ mode: "open", delegatesFocus: true }));
  #showing: { showing: Showing; pointing: Pointing } | null = null;
  #state: Own["state"] = "empty";
  #ready = new Settling();
  /** Whether the attributes name another cloud than the present one, which is shown or is being loaded. */
  #stale = true;
  /** Whether an attribute of the view was set, maybe to the same value again. */
  #looks = false;
  #updating = false;
  readonly #sight = new IntersectionObserver((entries) => this.#look(entries.at(-1)!.isIntersecting), {
    rootMargin: `${100 * NEAR}%`,
  });
  /** The messages that have been reported already, by attribute. */
  #told = new Map<string, string>();

  connectedCallback(): void {
    adoptEarly(this);
    this.#sight.observe(this);
    this.#touch();
  }

  disconnectedCallback(): void {
    // An element that is moved in the document leaves it and is back at once.
    queueMicrotask(() => {
      if (!this.isConnected) this.#sleep();
    });
  }

  /** The element was moved and never left the document. */
  connectedMoveCallback(): void {
    this.#touch();
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    // Setting the same address again starts another attempt.
    const renamed =
      name === "src" || (SOURCES.includes(name) && before !== now && !(name === "sample" && this.getAttribute("src")));
    if (renamed) this.#renew();
    this.#looks ||= name === "viewpoint" || name === "target";
    this.#touch();
  }

  get state(): Own["state"] {
    return this.#state;
  }

  get ready(): Promise<void> {
    return this.#ready.promise;
  }

  get count(): number {
    return this.#showing?.showing.cloud?.count ?? 0;
  }

  get visibleCount(): number {
    return this.#visible.length;
  }

  get visible(): Uint32Array {
    return this.#visible.slice();
  }

  get viewpoint(): Api.Place | null {
    const { showing } = this.#showing ?? {};
    return showing?.cloud ? [...showing.viewer.viewpoint] : (valueOf(this, "viewpoint") ?? null);
  }

  set viewpoint(place: Api.Place | null) {
    write(this, "viewpoint", place && Array.from(place).join(","));
  }

  get target(): Api.Place | null {
    const { showing } = this.#showing ?? {};
    return showing?.cloud ? [...(showing.viewer.target ?? showing.cloud.center)] : (valueOf(this, "target") ?? null);
  }

  set target(place: Api.Place | null) {
    write(this, "target", place && Array.from(place).join(","));
  }

  reset(): void {
    this.#showing?.showing.moves.reset();
  }

  pick(clientX: number, clientY: number, options?: { through?: boolean; tolerance?: number }): Api.PickedPoint | null {
    return this.#showing?.pointing.pick(clientX, clientY, options) ?? null;
  }

  project(position: ArrayLike<number>): { x: number; y: number } | null {
    return this.#showing?.pointing.project(placeOf(position)) ?? null;
  }

  async toBlob(): Promise<Blob> {
    if (!this.#showing?.showing.cloud) throw new Problem("source", "There is no cloud to make a picture of.");
    return this.#showing.showing.viewer.stage.snapshot();
  }

  get #visible(): Uint32Array {
    const { showing } = this.#showing ?? {};
    return showing?.cloud ? showing.viewer.scene.visible : new Uint32Array(0);
  }

  /** Lets attributes that are written together take effect together. */
  #touch(): void {
    if (this.#updating) return;
    this.#updating = true;
    queueMicrotask(() => {
      this.#updating = false;
      if (this.isConnected) this.#update();
    });
  }

  #update(): void {
    const looks = this.#looks;
    this.#looks = false;
    const reading = readAttributes(this);
    this.#frame.setLabel(this.getAttribute("label"));
    const there = this.#showing?.showing ?? null;
    const showing = there ?? this.#wake(reading);
    for (const problem of this.#newProblems(reading)) this.#emit("error", { error: problem });
    if (!showing) return;
    if (there) showing.follow(reading, looks);
    if (!this.#stale) return;
    this.#stale = false;
    this.#state = reading.src === null && reading.sample === null ? "empty" : "loading";
    showing.open();
  }

  /** Returns `null` if nothing can be drawn. This error is reported once. */
  #wake(reading: Reading): Showing | null {
    if (this.#state === "error") return null;
    const canvas = this.#frame.newCanvas();
    if (!canDraw(canvas)) {
      this.#frame.removeCanvas();
      const problem = new Problem(
        "webgl",
        "This cloud is drawn with WebGL 2, which this browser does not offer or has switched off.",
      );
      if (!this.#frame.showFallback()) this.#frame.sayError(problem.message);
      this.#fail(problem);
      return null;
    }
    const showing = new Showing(this.#frame, canvas, reading, this.#listener());
    const pointing = new Pointing(showing.canvas, showing.viewer);
    pointing.onPick((point) => this.#emit("pick", point));
    this.#showing = { showing, pointing };
    const { top, bottom } = this.getBoundingClientRect();
    // The observer comes later, when many elements have made their contexts.
    this.#look(bottom > -NEAR * innerHeight && top < (1 + NEAR) * innerHeight);
    return showing;
  }

  /** Only a picture in sight, or nearly so, keeps its context: a browser takes those of pictures in sight otherwise. */
  #look(isNear: boolean): void {
    if (this.#showing) this.#showing.showing.viewer.stage.isWanted = isNear;
  }

  #sleep(): void {
    this.#sight.disconnect();
    this.#showing?.showing.dispose();
    this.#showing = null;
    this.#state = "empty";
    this.#renew();
  }

  #renew(): void {
    this.#stale = true;
    this.#ready = this.#ready.renewed();
  }

  #listener(): Listener {
    return {
      loaded: (total, notes) => {
        this.#state = "ready";
        this.#emit("load", { total, notes });
        this.#ready.resolve();
      },
      failed: (problem) => this.#fail(problem),
      answered: (answer) => this.#answer(answer),
      progressed: (fraction) => this.#emit("progress", { fraction }),
      refused: (problem) => this.#emit("error", { error: problem }),
      moved: ({ hidden, freeze }) => {
        if (hidden !== (valueOf(this, "hidden-points") ?? SETTINGS.hidden.usual)) {
          this.setAttribute("hidden-points", hidden);
        }
        this.toggleAttribute("frozen", freeze !== null);
      },
    };
  }

  #answer(answer: TimedView): void {
    const { question, kind, visibility, milliseconds } = answer;
    this.#emit("change", {
      count: visibility.count,
      viewpoint: [...question.viewpoint],
      radius: visibility.radius,
      milliseconds,
      answer: kind,
    });
  }

  #fail(problem: Problem): void {
    this.#state = "error";
    this.#emit("error", { error: problem });
    this.#ready.reject(problem);
  }

  /** The problems that have not been reported yet. A problem is reported again after its attribute has changed. */
  #newProblems({ problems }: Reading): Problem[] {
    const fresh = [...problems]
      .filter(([attribute, { message }]) => this.#told.get(attribute) !== message)
      .map(([, problem]) => problem);
    // Who writes a page has rarely a listener for errors.
    for (const { message } of fresh) console.warn(`<hidden-point-cloud>: ${message}`);
    this.#told = new Map([...problems].map(([attribute, { message }]) => [attribute, message]));
    return fresh;
  }

  #emit<Type extends keyof Events>(type: Type, detail: Events[Type]["detail"]): void {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}

/** A promise that is settled from outside, at most once. */
class Settling {
  readonly promise: Promise<void>;
  resolve!: () => void;
  reject!: (problem: Problem) => void;
  #settled = false;

  constructor() {
    this.promise = new Promise((resolve, reject) => {
      this.resolve = () => {
        this.#settled = true;
        resolve();
      };
      this.reject = (problem) => {
        this.#settled = true;
        reject(problem);
      };
    });
    // The error event reports the error. A promise that nobody waits for must not report it as well.
    this.promise.catch(() => undefined);
  }

  /** A new promise if this one is settled. */
  renewed(): Settling {
    return this.#settled ? new Settling() : this;
  }
}

if ("customElements" in globalThis) {
  reflect(HiddenPointCloud.prototype);
  if (!customElements.get("hidden-point-cloud")) customElements.define("hidden-point-cloud", HiddenPointCloud);
}

export const HiddenPointCloudElement = HiddenPointCloud as unknown as typeof Api.HiddenPointCloudElement;
