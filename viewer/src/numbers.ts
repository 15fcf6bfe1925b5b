import type { Series } from "./contract";

/** Code of a missing number. */
const NONE = 65535;

/** Reads the numbers of a page, series by series. */
export class Numbers {
  readonly #codes: Uint16Array;
  readonly #read = new Map<Series, Float64Array>();

  private constructor(codes: Uint16Array) {
    this.#codes = codes;
  }

  /** Decodes a page's block: base64 of zlib of low bytes, then high bytes, of differences of 16-bit codes. */
  static async decode(base64: string): Promise<Numbers> {
    return new Numbers(codesOf(await inflated(bytesOf(base64.trim()))));
  }

  /** Values of a series; NaN is a gap. Returns the same array every time, which must not be changed. */
  read(series: Series): Float64Array {
    const known = this.#read.get(series);
    if (known) {
      return known;
    }
    const codes = this.#codes.subarray(series.at, series.at + series.count);
    if (codes.length !== series.count) {
      throw new Error(
        `This report has ${this.#codes.length} numbers, but a curve needs ${series.at + series.count}: the file seems to be damaged.`,
      );
    }
    const values = Float64Array.from(codes, (q) => (q === NONE ? Number.NaN : series.low + series.step * q));
    this.#read.set(series, values);
    return values;
  }
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) {
    bytes[i] = text.charCodeAt(i);
  }
  return bytes;
}

async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function codesOf(planes: Uint8Array): Uint16Array {
  const count = planes.length >> 1;
  const codes = new Uint16Array(count);
  let last = 0;
  for (let i = 0; i < count; i++) {
    last = (last + (planes[i] ?? 0) + 256 * (planes[count + i] ?? 0)) & 0xffff;
    codes[i] = last;
  }
  return codes;
}
