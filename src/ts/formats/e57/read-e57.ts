import { CloudBuilder } from "../builder.js";
import type { CloudFile, Reading } from "../cloud-file.js";
import type { Column } from "../column.js";
import { Contradictions } from "../contradictions.js";
import { crsOf } from "../las/crs.js";
import { FormatProblem } from "../problem.js";
import { SCAN, scanColumns } from "../stations.js";
import { E57File, type E57Scan } from "./e57-file.js";

/** E57: all scans, one after another, in the coordinates of the file. Colors are bytes. */
export async function readE57(reading: Reading): Promise<CloudFile> {
  if (!reading.e57) throw new FormatProblem("it is an E57 file, and their reader is not here");
  const found = new Contradictions(reading.damaged);
  const file = await E57File.open(await reading.e57(), reading);
  const { scans } = file;
  const total = scans.reduce((sum, { count }) => sum + count, 0);
  if (total === 0) throw new FormatProblem("it has no points");

  const names = scans.map(({ name }, i) => name || `scan ${i + 1}`);
  const columns = columnsOf(scans);
  const precision = scans.every(({ isSingle }) => isSingle) ? "float32" : "float64";
  const builder = new CloudBuilder(precision, [SCAN, ...columns], reading, total);
  for (const [number, scan] of scans.entries()) {
    const places = columns.map(({ name }) => scan.columns.findIndex((column) => column.name === name));
    const width = 3 + scan.columns.length;
    try {
      for await (const { count, numbers } of file.rows(number)) {
        for (let row = 0; row < count; row++) {
          if (!builder.takes()) continue;
          const at = row * width;
          const i = builder.put(numbers[at]!, numbers[at + 1]!, numbers[at + 2]!);
          builder.values[0]![i] = number;
          for (let k = 0; k < places.length; k++) {
            builder.values[1 + k]![i] = places[k]! < 0 ? NaN : numbers[at + 3 + places[k]!]!;
          }
        }
        reading.onProgress?.(Math.min(1, builder.rows / total));
      }
    } catch (cause) {
      if (!(cause instanceof FormatProblem)) throw cause;
      found.add(scans.length > 1 ? `${names[number]!}: ${cause.message}` : cause.message);
    }
  }
  if (builder.rows === 0) throw new FormatProblem(found.notes.join("; "));
  const crs = crsOf({ wkt: file.system });
  const cloud = builder.finish();
  // Clouds that were put together have a place, too: the origin of their coordinates.
  const areScanners = scans.some(({ isScanner }) => isScanner);
  return {
    ...cloud,
    columns: scanColumns(cloud.columns, names),
    isGrid: true,
    notes: [...found.notes, ...cloud.notes],
    up: "z",
    ...(crs && { crs }),
    unit: { name: "m", meters: 1 },
    ...(areScanners && { stations: scans.map(({ viewpoint }, i) => ({ name: names[i]!, viewpoint })) }),
  };
}

/** The columns of all scans. If a scan lacks one, its numbers are NaN there. */
function columnsOf(scans: readonly E57Scan[]): Column[] {
  const names = [...new Set(scans.flatMap(({ columns }) => columns.map(({ name }) => name)))];
  return names.map((name) => {
    const types = scans.map(({ columns }) => columns.find((column) => column.name === name)?.type);
    const [type] = types;
    return { name, type: type !== undefined && types.every((other) => other === type) ? type : "float64" };
  });
}
