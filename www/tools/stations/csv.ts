import { columnsOf } from "../csv.ts";
import type { Viewpoint } from "../../settings/settings.ts";
import { LONGEST_NAME, type Station } from "./station.ts";

/**
 * Reads stations from lines of name, x, y and z, or of x, y and z. The first line may hold names of columns; then they
 * say the order. Throws an error whose message is for the user.
 */
export function readStations(text: string): Station[] {
  const rows = columnsOf(text);
  const head = rows[0]?.words.map((word) => word.toLowerCase());
  const named = head && ["x", "y", "z"].every((axis) => head.includes(axis));
  const width = rows[named ? 1 : 0]?.words.length ?? 0;
  const axes = named ? ["x", "y", "z"].map((axis) => head.indexOf(axis)) : width >= 4 ? [1, 2, 3] : [0, 1, 2];
  const title = named ? head.findIndex((word) => /^(name|id|station|point|label)$/.test(word)) : width >= 4 ? 0 : -1;
  const stations = rows.slice(named ? 1 : 0).map(({ words, line }, i): Station => {
    const at = axes.map((column) => (words[column] ? Number(words[column]) : NaN));
    if (!at.every(Number.isFinite)) {
      throw new Error(`Line ${line} is not a name and three numbers x, y, z: “${words.join(", ").slice(0, 40)}”.`);
    }
    return { name: words[title]?.slice(0, LONGEST_NAME) || `S${i + 1}`, at: at as Viewpoint };
  });
  if (stations.length === 0) throw new Error("The file has no lines of name, x, y, z.");
  return stations;
}
