/** What the address of the page asks for. Anything that cannot be used is named in `notes`, in plain words. */
export interface Params {
  sample: string;
  src: string | null;
  /** `null`: the automatic radius. */
  exponent: number | null;
  /** In the file's own coordinates. */
  view: [number, number, number] | null;
  notes: string[];
}

/** The end of the slider. */
const MOST_EXPONENT = 6;

export function readParams(search: string, samples: readonly string[]): Params {
  const query = new URLSearchParams(search);
  const notes: string[] = [];

  let sample = query.get("sample") ?? samples[0]!;
  if (!samples.includes(sample)) {
    notes.push(`There is no sample called “${sample}”, so this is the ${samples[0]}.`);
    sample = samples[0]!;
  }

  const exponent = query.has("exponent") ? parseNumber(query.get("exponent")!) : null;
  const exponentFits = exponent === null || (exponent >= 0 && exponent <= MOST_EXPONENT);
  if (!exponentFits) {
    notes.push(`The exponent in the address is not a number from 0 to ${MOST_EXPONENT}, so the automatic one is used.`);
  }

  const view = query.has("view") ? query.get("view")!.split(",").map(parseNumber) : null;
  const viewFits = view === null || (view.length === 3 && view.every(Number.isFinite));
  if (!viewFits) {
    notes.push("The view in the address is not three numbers x,y,z, so the usual view is used.");
  }

  const src = query.get("src");
  if (src === "") notes.push(`The address names no file after “src=”, so this is the ${sample}.`);

  return {
    sample,
    src: src === "" ? null : src,
    exponent: exponentFits ? exponent : null,
    view: viewFits ? (view as [number, number, number] | null) : null,
    notes,
  };
}

/** Like Number, but an empty text is no number. */
function parseNumber(text: string): number {
  return text.trim() === "" ? NaN : Number(text);
}
