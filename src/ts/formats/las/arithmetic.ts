// The arithmetic decoder of LAZ, for the table of its chunks, which laz-perf keeps to itself (LASzip, Isenburg 2013).

const LEAST_LENGTH = 2 ** 24;

/** Symbols from 0, each as likely as it was so far. */
class Model {
  readonly counts: Uint32Array;
  readonly shares: Uint32Array;
  #total = 0;
  #cycle: number;
  #left = 0;

  constructor(symbols: number) {
    this.counts = new Uint32Array(symbols).fill(1);
    this.shares = new Uint32Array(symbols);
    this.#cycle = symbols;
    this.#update();
    this.#left = this.#cycle = (symbols + 6) >> 1;
  }

  count(symbol: number): void {
    this.counts[symbol]! += 1;
    if (--this.#left === 0) this.#update();
  }

  #update(): void {
    const { counts, shares } = this;
    if ((this.#total += this.#cycle) > 2 ** 15) {
      this.#total = 0;
      for (let i = 0; i < counts.length; i++) this.#total += counts[i] = (counts[i]! + 1) >> 1;
    }
    const scale = Math.floor(2 ** 31 / this.#total);
    for (let i = 0, sum = 0; i < counts.length; sum += counts[i++]!) shares[i] = (scale * sum) >>> 16;
    this.#left = this.#cycle = Math.min((5 * this.#cycle) >> 2, (counts.length + 6) << 3);
  }
}

/** One of two symbols. */
class BitModel {
  share = 2 ** 12;
  #zeros = 1;
  #total = 2;
  #cycle = 4;
  #left = 4;

  count(bit: number): void {
    if (bit === 0) this.#zeros++;
    if (--this.#left > 0) return;
    if ((this.#total += this.#cycle) > 2 ** 13) {
      this.#total = (this.#total + 1) >> 1;
      this.#zeros = (this.#zeros + 1) >> 1;
      if (this.#zeros === this.#total) this.#total++;
    }
    this.share = (this.#zeros * Math.floor(2 ** 31 / this.#total)) >>> 18;
    this.#left = this.#cycle = Math.min((5 * this.#cycle) >> 2, 64);
  }
}

class Decoder {
  readonly #bytes: Uint8Array;
  #at = 0;
  #value = 0;
  #length = 2 ** 32 - 1;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
    for (let i = 0; i < 4; i++) this.#shift();
  }

  get isBeyondEnd(): boolean {
    return this.#at > this.#bytes.length + 4;
  }

  symbol(model: Model): number {
    let [symbol, low, high, end] = [0, 0, this.#length, model.shares.length];
    this.#length >>>= 15;
    for (let middle = end >> 1; middle !== symbol; middle = (symbol + end) >> 1) {
      const border = this.#length * model.shares[middle]!;
      if (border > this.#value) [end, high] = [middle, border];
      else [symbol, low] = [middle, border];
    }
    this.#value -= low;
    this.#length = high - low;
    this.#renew();
    model.count(symbol);
    return symbol;
  }

  bit(model: BitModel): number {
    const border = model.share * (this.#length >>> 13);
    const bit = this.#value >= border ? 1 : 0;
    if (bit === 0) this.#length = border;
    else [this.#value, this.#length] = [this.#value - border, this.#length - border];
    this.#renew();
    model.count(bit);
    return bit;
  }

  bits(count: number): number {
    if (count > 19) {
      const low = this.bits(16);
      return low + 2 ** 16 * this.bits(count - 16);
    }
    this.#length >>>= count;
    const bits = Math.floor(this.#value / this.#length);
    this.#value -= this.#length * bits;
    this.#renew();
    return bits;
  }

  #renew(): void {
    for (; this.#length < LEAST_LENGTH && this.#length > 0; this.#length *= 256) this.#shift();
  }

  #shift(): void {
    this.#value = ((this.#value * 256) % 2 ** 32) + (this.#bytes[this.#at++] ?? 0);
  }
}

/** Decodes rows of unsigned numbers, each as its difference from the one above. Undefined if the bytes do not suffice. */
export function decodeDifferences(bytes: Uint8Array, rows: number, width: number): Uint32Array[] | undefined {
  const decoder = new Decoder(bytes);
  const columns = Array.from({ length: width }, () => ({ bits: new Model(33), values: new Uint32Array(rows) }));
  const small = new BitModel();
  const models = Array.from({ length: 31 }, (_, i) => new Model(2 ** Math.min(i + 1, 8)));
  const difference = (bits: number) => {
    if (bits === 0) return decoder.bit(small);
    if (bits === 32) return -(2 ** 31);
    const high = decoder.symbol(models[bits - 1]!);
    const found = bits > 8 ? high * 2 ** (bits - 8) + decoder.bits(bits - 8) : high;
    return found + (found >= 2 ** (bits - 1) ? 1 : 1 - 2 ** bits);
  };
  for (let row = 0; row < rows; row++) {
    for (const { bits, values } of columns) {
      values[row] = (row > 0 ? values[row - 1]! : 0) + difference(decoder.symbol(bits));
    }
    if (decoder.isBeyondEnd) return undefined;
  }
  return columns.map(({ values }) => values);
}
