// Tables as Markdown.
export type Row = Record<string, string | number>;

export interface Table {
  title: string;
  /** Explains the columns. Empty if an earlier table has explained them. */
  note: string;
  rows: Row[];
}

/** Returns an empty text for a table without rows. A missing cell stays empty. */
export function markdown({ title, note, rows }: Table): string {
  if (rows.length === 0) return "";
  const columns = [...new Set(rows.flatMap((row) => Object.keys(row)))];
  const line = (cells: string[]): string => `| ${cells.join(" | ")} |`;
  const isNumber = (column: string): boolean => rows.some((row) => typeof row[column] === "number");
  return [
    `## ${title}`,
    "",
    ...(note === "" ? [] : [note, ""]),
    line(columns),
    line(columns.map((column) => (isNumber(column) ? "---:" : "---"))),
    ...rows.map((row) => line(columns.map((column) => format(row[column] ?? "")))),
    "",
  ].join("\n");
}

function format(value: string | number): string {
  if (typeof value === "string") return value;
  if (Number.isInteger(value)) return value.toLocaleString("en-US");
  return value.toFixed(value < 10 ? 2 : 1);
}

export function median(values: number[]): number {
  const sorted = values.toSorted((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)] ?? NaN;
}
