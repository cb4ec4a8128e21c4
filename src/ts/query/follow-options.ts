import { describe, HprError, naming } from "../base/errors.js";
import type { AnswerKind, Stage } from "../follow/refinement.js";
import { givenOptions } from "./options.js";
import { VIEW_OPTIONS, viewSettings, type VisibilityOptions } from "./view-options.js";

/** How answers follow a viewpoint that moves. */
export interface FollowOptions {
  /**
   * Asked when the viewpoint has been at rest for 100 ms. These are the options of a view, as if no
   * others were given. `false`: nothing more is asked. Default: the view itself with `looks: 3`, in three
   * dimensions and if none of `radius`, `exponent`, `inversion`, `looks`, `draft` and `sample` is given.
   */
  settle?: VisibilityOptions | false | undefined;
  /**
   * What stands in while the answer for the present viewpoint is computed:
   *
   * - `"map"`, the default where the points are drawn with shaders that can be changed (three's WebGL renderer):
   *   the newest map of directions, by which the graphics card leaves out points in every frame. It hides only
   *   points that the answer at rest hides, too. The answer at rest is the only other one. Drafts stand in where
   *   there are no such shaders, for directions, with `vote`, and if the radius is searched.
   * - `"draft"`, the default elsewhere: the newest draft. It is certain that the points that a draft leaves out
   *   are hidden from the draft's viewpoint. No draft is asked of clouds with fewer than 10,000
   *   points, because their answer comes within a frame.
   * - `"keep"`: the last answer. No drafts are asked.
   * - `"all"`: all points. No drafts are asked.
   *
   * Views with `looks`, `radius: "search"` or `"opposite"` have no draft of their own. The draft of the
   * automatic radius stands in for them.
   */
  stale?: "map" | "draft" | "all" | "keep" | undefined;
  /**
   * How far the viewpoint must move for a new answer, as a share of the cloud's spacing. For an
   * orthographic view, the direction must turn by this number of milliradians. Shorter moves cannot
   * be seen. At least 0. Default 0.001.
   */
  moveThreshold?: number | undefined;
}

/** {@link FollowOptions}, checked and complete. */
export interface FollowSettings {
  stages: readonly Stage<VisibilityOptions>[];
  /** The questions where maps can be drawn. Undefined if no map is asked. */
  mapped: readonly Stage<VisibilityOptions>[] | undefined;
  stale: "map" | "draft" | "all" | "keep";
  moveThreshold: number;
}

export const FOLLOW_OPTIONS = ["settle", "stale", "moveThreshold"] as const;

/** Below this number of points, neither drafts nor maps are asked. */
const DRAFTED_FROM = 10_000;
/** A viewpoint that has not moved for this number of milliseconds is at rest. */
export const REST = 100;
/** With one of these options, the exact answer of the view itself is the final one. */
const FINAL_OPTIONS = ["radius", "exponent", "inversion", "looks", "draft", "sample"] as const;

/**
 * `view` are the options of the view itself, which were checked already. `dimension` is that of the cloud.
 * Drafts are for answers that come later: `isLater`.
 */
export function followSettings(
  given: Record<string, unknown>,
  view: VisibilityOptions,
  { dimension = 3, isLater = true, hasShaders = false } = {},
): FollowSettings {
  const usual: FollowSettings["stale"] = hasShaders ? "map" : "draft";
  const { settle = usualSettle(view, dimension), stale = usual, moveThreshold = 0.001 } = given;
  if (!isStale(stale) || (stale === "map" && !hasShaders)) {
    const names = `${hasShaders ? `"map", ` : ""}"draft", "all" or "keep"`;
    throw new HprError("option", `stale must be ${names}, got ${describe(stale)}`);
  }
  if (typeof moveThreshold !== "number" || !(moveThreshold >= 0 && moveThreshold < Infinity)) {
    throw new HprError(
      "option",
      `moveThreshold must be a finite number and at least 0, got ${describe(moveThreshold)}`,
    );
  }
  const stages = [stageOf(view)];
  if ((stale === "draft" || stale === "map") && isLater && !isQuick(view)) {
    stages.unshift(stageOf(draftOf(view)));
  }
  if (settle !== false) {
    stages.push({ ...stageOf(readSettle(settle)), rest: REST });
  }
  const atRest = stages.at(-1)!;
  const mapped = stale === "map" && isLater && hasMap(atRest.options) ? mappedStages(atRest) : undefined;
  return { stages, mapped, stale, moveThreshold };
}

/** The stages for a cloud with this number of points. `isMapped`: maps can be drawn for this view. */
export function stagesFor(
  { stages, mapped }: FollowSettings,
  points: number,
  isMapped = false,
): readonly Stage<VisibilityOptions>[] {
  if (points < DRAFTED_FROM) {
    return stages.length > 1 && stages[0]!.kind === "draft" ? stages.slice(1) : stages;
  }
  return (isMapped ? mapped : undefined) ?? stages;
}

function isStale(stale: unknown): stale is FollowSettings["stale"] {
  return stale === "map" || stale === "draft" || stale === "all" || stale === "keep";
}

/** A map belongs to the question that is asked at rest. Nothing is asked in between. */
function mappedStages(atRest: Stage<VisibilityOptions>): Stage<VisibilityOptions>[] {
  return [
    { kind: "map", options: { ...atRest.options, scores: undefined }, rest: 0 },
    { ...atRest, rest: REST },
  ];
}

/** Whether a map may stand in for this question. */
function hasMap({ draft, vote, radius }: VisibilityOptions): boolean {
  return draft !== true && vote === undefined && radius !== "search" && radius !== "opposite";
}

function usualSettle(view: VisibilityOptions, dimension: number): VisibilityOptions | false {
  const isFinal = dimension !== 3 || FINAL_OPTIONS.some((name) => view[name] !== undefined);
  return isFinal ? false : { ...view, looks: 3 };
}

function readSettle(settle: unknown): VisibilityOptions {
  return naming("settle", () => {
    const given = givenOptions(settle, VIEW_OPTIONS);
    viewSettings(given, 3);
    return given;
  });
}

function stageOf(options: VisibilityOptions): Stage<VisibilityOptions> {
  const kind: AnswerKind = options.draft === true ? "draft" : options.looks === undefined ? "operator" : "looks";
  return { kind, options, rest: 0 };
}

/** Whether a view takes less time than its draft would. */
function isQuick({ draft, sample }: VisibilityOptions): boolean {
  return draft === true || sample !== undefined;
}

/** The options of a draft. Where the view itself has none, it is a draft of the automatic radius. */
function draftOf(view: VisibilityOptions): VisibilityOptions {
  const { radius } = view;
  return {
    ...view,
    looks: undefined,
    scores: undefined,
    radius: radius === "search" || radius === "opposite" ? undefined : radius,
    draft: true,
  };
}
