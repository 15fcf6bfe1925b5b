import assert from "node:assert/strict";
import { test } from "node:test";
import { digitsFor, roundValues, shortCitation, shown } from "../src/format";

test("the decimal places of values depend on the range of the panel", () => {
  assert.equal(shown(-12.345, digitsFor(-60, 10)), "−12.3");
  assert.equal(shown(0.1234, digitsFor(-0.2, 0.2)), "0.123");
  assert.equal(shown(-0.001, 1), "0.0");
  assert.equal(shown(Number.NaN, 1), "–");
});

test("axis values are round and within the range", () => {
  assert.deepEqual(roundValues(-7, 52, 4), [0, 20, 40]);
  assert.deepEqual(roundValues(-0.21, 0.23, 4), [-0.2, 0, 0.2]);
  assert.deepEqual(roundValues(0.25, 4.44, 5), [1, 2, 3, 4]);
});

test("a short citation is author and year", () => {
  assert.equal(shortCitation("Schwartz et al. 2008, J Biomech 41:1639; 83 children"), "Schwartz et al. 2008");
  assert.equal(shortCitation("Winter (1991) Waterloo"), "Winter 1991");
  assert.equal(
    shortCitation("Mean ± 1 SD of typically developing children (Schwartz et al. 2008, n = 82) at V* = 0.43."),
    "Schwartz et al. 2008",
  );
  assert.equal(shortCitation("Example and Sample 2018 (doi:10.0/0), 24 adults"), "Example and Sample 2018");
  assert.equal(shortCitation("Own laboratory, 12 people"), "Own laboratory");
});
