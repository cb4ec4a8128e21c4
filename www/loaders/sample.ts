import type { PreparedCloud } from "../cloud/cloud.ts";
import { prepareCloud } from "../cloud/prepare.ts";
import { downloadBytes } from "./download.ts";
import { LoadProblem } from "./problem.ts";
import type { LoadRequest } from "./protocol.ts";

/** Loads the file of a sample in the page's thread: there is nothing to read, and a worker would start later than it comes. */
export async function loadSample({ name, url }: LoadRequest & { kind: "sample" }): Promise<PreparedCloud> {
  const { buffer: data } = await downloadBytes(name, url);
  // Some servers answer with a page if they do not have the file.
  if (data.byteLength % 12 !== 0) {
    throw new LoadProblem(`${name} could not be downloaded: the server sent something else.`);
  }
  return prepareCloud({ positions: new Float32Array(data), colors: null });
}
