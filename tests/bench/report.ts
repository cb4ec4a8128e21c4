// Rows as a Markdown table or as JSON.
export type Row = Record<string, string | number>;

export function printTable(title: string, rows: Row[]): void {
  const [first] = rows;
  if (first === undefined) return;
  const columns = Object.keys(first);
  const line = (cells: string[]): string => `| ${cells.join(" | ")} |`;
  console.log(`\n${title}\n`);
  console.log(line(columns));
  console.log(line(columns.map((column) => (typeof first[column] === "number" ? "---:" : "---"))));
  for (const row of rows) console.log(line(columns.map((column) => format(row[column] ?? ""))));
}

function format(value: string | number): string {
  if (typeof value === "string" || Number.isInteger(value)) return value.toLocaleString("en-US");
  return value.toFixed(value < 10 ? 2 : 1);
}
