import type { Wish } from "../open/open-cloud.ts";
import { requestForAddress, requestForSample } from "../open/source.ts";
import { type Sample, sampleNamed } from "../samples/samples.ts";
import type { CloudName } from "../settings/address.ts";
import type { Wishes } from "../settings/read-address.ts";
import type { AskedView } from "../view/framing.ts";

/** A cloud that the page opens. */
export interface Source extends Wish {
  /** Its name in the address; `null` for a file from this device. */
  name: CloudName | null;
  /** Sentences that the user has to read about it. */
  notes: string[];
  /** The reason why the cloud that was asked for could not be opened, if this cloud replaces it. */
  insteadOf?: string;
}

export function fromSample(sample: Sample, view: AskedView | null = null): Source {
  return {
    request: requestForSample(sample, document.baseURI),
    sample,
    name: ["sample", sample.name],
    view,
    settings: {},
    notes: [],
  };
}

export function fromAddress(text: string, view: AskedView | null, limit: { limit?: number }): Source {
  const request = requestForAddress(text, { skipNonFinite: false, ...limit });
  return { request, sample: null, name: ["src", text], view, settings: {}, notes: [] };
}

export function fromFile(file: File, notes: string[], limit: { limit?: number }): Source {
  const request = { kind: "file", name: file.name, file, skipNonFinite: false, ...limit } as const;
  return { request, sample: null, name: null, view: null, settings: {}, notes };
}

/** The cloud that the page's address asks for. */
export function firstSource(wishes: Wishes): Source {
  const { sample, src, settings, notes } = wishes;
  const view = wishes.view && { at: wishes.view, target: wishes.target };
  const source = src === null ? fromSample(sampleNamed(sample), view) : fromAddress(src, view, limitOf(wishes));
  return { ...source, settings, notes };
}

/** The largest number of points of a file, as the address asks for it. */
export function limitOf({ points }: Wishes): { limit?: number } {
  return points === null ? {} : { limit: points };
}
