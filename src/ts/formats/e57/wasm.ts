/** What e57.wasm offers, which is src/e57. All functions take and return numbers. */
export interface E57Wasm {
  memory: WebAssembly.Memory;
  /** Takes the size of the file. */
  begin(size: number): void;
  /** The place for the bytes of a part of the file. */
  supply(from: number, length: number): number;
  /** The first byte that is missing. */
  missing(): number;
  text_at(): number;
  text_length(): number;
  numbers_at(): number;
  /** The number of scans, or `MISSING` or `REFUSED`, as those below. */
  open(): number;
  begin_scan(index: number): number;
  /** The number of rows; 0 at the end of the scan. */
  next_rows(): number;
}
