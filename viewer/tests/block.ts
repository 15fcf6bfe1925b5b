import { deflateSync } from "node:zlib";
import type { Series } from "../src/contract";

const HIGHEST = 65534;
const NONE = 65535;

/** Writes numbers as the program does (crates/ambulo-report/src/page/block.rs). */
export class Block {
  readonly #codes: number[] = [];

  add(values: readonly number[]): Series {
    const finite = values.filter(Number.isFinite);
    const low = finite.length > 0 ? Math.min(...finite) : 0;
    const high = finite.length > 0 ? Math.max(...finite) : 0;
    const step = (high - low) / HIGHEST;
    const at = this.#codes.length;
    const code = (x: number): number => (!Number.isFinite(x) ? NONE : step > 0 ? Math.round((x - low) / step) : 0);
    this.#codes.push(...values.map(code));
    return { at, count: values.length, low, step };
  }

  encode(): string {
    let last = 0;
    const differences = this.#codes.map((code) => {
      const difference = (code - last) & 0xffff;
      last = code;
      return difference;
    });
    const planes = [...differences.map((d) => d & 255), ...differences.map((d) => d >> 8)];
    return deflateSync(Uint8Array.from(planes)).toString("base64");
  }
}
