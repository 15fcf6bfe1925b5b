import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { Numbers } from "../src/numbers";

/** The block of given codes, as the program writes it. */
function encoded(codes: number[]): string {
  let last = 0;
  const differences = codes.map((code) => {
    const difference = (code - last) & 0xffff;
    last = code;
    return difference;
  });
  return deflateSync(Uint8Array.from([...differences.map((d) => d & 255), ...differences.map((d) => d >> 8)])).toString(
    "base64",
  );
}

test("codes become values and gaps", async () => {
  const numbers = await Numbers.decode(encoded([7, 0, 65535, 65534, 300]));
  const values = numbers.read({ at: 1, count: 4, low: -2, step: 0.5 });
  assert.deepEqual([...values], [-2, Number.NaN, 32765, 148]);
});

test("a series is decoded once", async () => {
  const numbers = await Numbers.decode(encoded([1, 2, 3]));
  const series = { at: 0, count: 3, low: 0, step: 1 };
  assert.equal(numbers.read(series), numbers.read(series));
});

test("a series beyond the block is an error", async () => {
  const numbers = await Numbers.decode(encoded([1, 2, 3]));
  assert.throws(() => numbers.read({ at: 2, count: 2, low: 0, step: 1 }), /has 3 numbers/);
});

test("text that is not a block is an error", async () => {
  await assert.rejects(Numbers.decode("AAAA"));
});
