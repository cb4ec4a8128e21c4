import type { TimedView } from "../view/inquiry.ts";

const number = new Intl.NumberFormat("en-US");

/** An answer in words, for everybody and for screen readers. */
export function sentenceOf({ visibility }: TimedView, total: number, frozen: boolean): string {
  const points = total === 1 ? "point" : "points";
  const where = frozen ? "the frozen viewpoint" : "here";
  return `${number.format(visibility.count)} of ${number.format(total)} ${points} can be seen from ${where}.`;
}

/** The same in round numbers, to be read at a glance. */
export function captionOf({ visibility }: TimedView, total: number, frozen: boolean): string {
  const points = total === 1 ? "point" : "points";
  const seen = `can be seen from ${frozen ? "the eye" : "here"}`;
  return `${rounded(total)} ${points}. ${rounded(visibility.count)} ${seen}.`;
}

/** How the answer was found. */
export function methodOf({ visibility, question, kind, milliseconds }: TimedView, total: number): string {
  const time = milliseconds < 10 ? milliseconds.toFixed(1) : number.format(Math.round(milliseconds));
  const by = kind === "looks" ? `by ${question.method.looks} looks ` : "";
  return `${percent(visibility.count, total)} of the points, found ${by}in ${time}\u00a0ms.`;
}

/** Two digits of a large number. A small one is told exactly. */
function rounded(count: number): string {
  return number.format(count < 10_000 ? count : Number(count.toPrecision(2)));
}

/** Rounds the percentage. Only no points at all give 0 %, and only all points give 100 %. */
function percent(count: number, total: number): string {
  const share = total > 0 ? Math.round((100 * count) / total) : 0;
  if (share === 0 && count > 0) return "<\u00a01\u00a0%";
  if (share === 100 && count < total) return ">\u00a099\u00a0%";
  return `${share}\u00a0%`;
}
