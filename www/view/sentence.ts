import type { TimedView } from "../ask/inquiry.ts";

const number = new Intl.NumberFormat("en-US");

/** An answer in words, for everybody and for screen readers. */
export function sentenceOf(
  { visibility, question, kind, quick, milliseconds }: TimedView,
  total: number,
  frozen: boolean,
): string {
  const one = visibility.count === 1;
  const where = frozen
    ? `${one ? "was" : "were"} visible from the frozen viewpoint`
    : `${one ? "is" : "are"} visible from here`;
  const time = milliseconds < 10 ? milliseconds.toFixed(1) : number.format(Math.round(milliseconds));
  const share = percent(visibility.count, total);
  const standIn = quick ? ", with the automatic radius while moving" : "";
  const most = kind === "draft" ? "At most " : "";
  const by = kind === "looks" ? `by ${question.method.looks} looks ` : "";
  return `${most}${number.format(visibility.count)} of ${number.format(total)} ${total === 1 ? "point" : "points"} (${share}) ${where}, found ${by}in ${time}\u00a0ms${standIn}.`;
}

/** Rounds the percentage. Only no points at all give 0 %, and only all points give 100 %. */
function percent(count: number, total: number): string {
  const share = total > 0 ? Math.round((100 * count) / total) : 0;
  if (share === 0 && count > 0) return "<\u00a01\u00a0%";
  if (share === 100 && count < total) return ">\u00a099\u00a0%";
  return `${share}\u00a0%`;
}
