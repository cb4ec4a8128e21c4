/** A line of a table: its words, and its number in the file. */
export interface TableLine {
  words: string[];
  line: number;
}

/** Splits a table at semicolons, tabs, commas or spaces, whichever its first line has. Skips empty lines and comments. */
export function columnsOf(text: string): TableLine[] {
  const lines = text.replace(/^\ufeff/, "").split(/\r\n|\r|\n/);
  const rows = lines.map((content, i) => ({ content: content.trim(), line: i + 1 }));
  const filled = rows.filter(({ content }) => content !== "" && !content.startsWith("#"));
  const separator = [/;/, /\t/, /,/].find((sign) => sign.test(filled[0]?.content ?? "")) ?? /\s+/;
  return filled.map(({ content, line }) => ({
    words: content.split(separator).map((word) => word.trim().replace(/^"(.*)"$/, "$1")),
    line,
  }));
}

/** A word of a CSV file, in quotes if it needs them. A leading sign, also after blanks, would be a formula in a spreadsheet. */
export function csvWord(word: string): string {
  const safe = /^\s*[=+@\-\uff1d\uff0b\uff20\uff0d]|^[\t\r\n]/.test(word) ? `'${word}` : word;
  return /[",;\t\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}
