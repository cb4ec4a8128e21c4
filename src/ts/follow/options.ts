import { describe, HprError, naming } from "../base/errors.js";
import { givenOptions, pick } from "../query/options.js";
import { type FollowedOptions, VIEW_OPTIONS, viewSettings, type VisibilityOptions } from "../query/view-options.js";

export type { FollowedOptions };

/**
 * What an answer is. `"operator"` is the exact answer of one flip. `"looks"` is an answer of two or three
 * looks. `"map"` is a map of directions, by which the graphics card leaves out hidden points.
 */
export type AnswerKind = "map" | "operator" | "looks";

/** One of the questions that are asked about a view, one after another. */
export interface Stage<Options = unknown> {
  readonly kind: AnswerKind;
  readonly options: Options;
  /** The milliseconds without a move after which this is asked. */
  readonly rest: number;
}

/** How answers follow a viewpoint that moves. */
export interface FollowOptions {
  /**
   * Asked when the viewpoint has been at rest for 100 ms. These are the options of a view, as if no
   * others were given. `false`: nothing more is asked. Default: the view itself with `looks: 3`, in three
   * dimensions and if none of `radius`, `exponent`, `inversion` and `looks` is given. `thickness` and
   * `surface` then belong to these looks.
   */
  settle?: VisibilityOptions | false | undefined;
  /**
   * What is drawn until the present viewpoint is answered:
   *
   * - `"map"`, the default where the points are drawn with shaders that can be changed: the newest map of
   *   directions, by which the graphics card leaves out points in every frame. It hides only points that the
   *   answer at rest hides, too. Elsewhere, and for directions and `radius: "opposite"`, this is `"keep"`.
   * - `"keep"`, the default elsewhere: the last answer. Before the first one, all points.
   * - `"all"`: all points.
   */
  stale?: "map" | "all" | "keep" | undefined;
}

/** {@link FollowOptions}, checked and complete. */
export interface FollowSettings {
  stages: readonly Stage<VisibilityOptions>[];
  /** The questions where maps can be drawn. Undefined if no map is asked. */
  mapped: readonly Stage<VisibilityOptions>[] | undefined;
  stale: "map" | "all" | "keep";
}

export const FOLLOW_OPTIONS = ["settle", "stale"] as const;

/** A cloud with fewer points is answered within a frame, so that no map is asked. */
const MAPPED_FROM = 20_000;
/** A viewpoint that has not moved for this number of milliseconds is at rest. */
export const REST = 100;
/** With one of these options, the exact answer of the view itself is the final one. */
const FINAL_OPTIONS = ["radius", "exponent", "inversion", "looks"] as const;

/**
 * Reads the options of a view, and how its answers follow a viewpoint. `dimension` is that of the cloud. Maps are for
 * answers that come later: `isLater`.
 */
export function followSettings(
  given: Record<string, unknown>,
  { dimension = 3, isLater = true, hasShaders = false } = {},
): FollowSettings {
  const { stale = hasShaders ? "map" : "keep" } = given;
  if (stale !== "all" && stale !== "keep" && !(stale === "map" && hasShaders)) {
    throw new HprError("option", `stale must be ${hasShaders ? `"map", ` : ""}"all" or "keep", got ${describe(stale)}`);
  }
  const stages = stagesOf(given, dimension);
  const atRest = stages.at(-1)!;
  const isMapped = stale === "map" && isLater && atRest.options.radius !== "opposite";
  return { stages, mapped: isMapped ? mappedStages(atRest) : undefined, stale };
}

/** The view itself, and what is asked at rest. */
function stagesOf(given: Record<string, unknown>, dimension: number): Stage<VisibilityOptions>[] {
  const view: VisibilityOptions = pick(given, VIEW_OPTIONS);
  const { settle } = given;
  const isFinal = dimension !== 3 || FINAL_OPTIONS.some((name) => view[name] !== undefined);
  if (settle === undefined && !isFinal) {
    const looks = { ...view, looks: 3 } as VisibilityOptions;
    viewSettings({ ...looks }, dimension);
    const plain = { ...view, thickness: undefined, surface: undefined } as VisibilityOptions;
    return [stageOf(plain), stageOf(looks, REST)];
  }
  viewSettings({ ...view }, dimension);
  const isAll = settle === undefined || settle === false;
  return isAll ? [stageOf(view)] : [stageOf(view), stageOf(readSettle(settle), REST)];
}

/** The stages for a cloud with this number of points. `isMapped`: maps can be drawn for this view. */
export function stagesFor(
  { stages, mapped }: FollowSettings,
  points: number,
  isMapped = false,
): readonly Stage<VisibilityOptions>[] {
  return (isMapped && points >= MAPPED_FROM ? mapped : undefined) ?? stages;
}

/** A map belongs to the question that is asked at rest. Nothing is asked in between. */
function mappedStages(atRest: Stage<VisibilityOptions>): Stage<VisibilityOptions>[] {
  return [
    { kind: "map", options: { ...atRest.options, scores: undefined }, rest: 0 },
    { ...atRest, rest: REST },
  ];
}

function readSettle(settle: unknown): VisibilityOptions {
  return naming("settle", () => {
    const given = givenOptions(settle, VIEW_OPTIONS);
    viewSettings(given, 3);
    return given;
  });
}

function stageOf(options: VisibilityOptions, rest = 0): Stage<VisibilityOptions> {
  return { kind: options.looks === undefined ? "operator" : "looks", options, rest };
}
