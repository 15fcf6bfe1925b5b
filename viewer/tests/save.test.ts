import assert from "node:assert/strict";
import { test } from "node:test";
import type { Drawing, Line } from "../src/drawing";
import { csvText } from "../src/save";

const WORDS = { title: "Hip", unit: "deg", positive: "", negative: "", band: "" };
const line = (name: string, x: number[], y: number[], session = 0): Line => ({
  name,
  role: "mean",
  side: "r",
  session,
  cycle: null,
  variant: 0,
  x: Float64Array.from(x),
  y: Float64Array.from(y),
  origin: null,
});
const drawn = (...lines: Line[]): Drawing => ({
  axis: "time",
  x: [0, 1],
  y: [0, 1],
  areas: [],
  shades: [],
  marks: [],
  active: [],
  lines,
});

test("one column per curve, gaps are empty", () => {
  const text = csvText(drawn(line("right, mean of 3", [0, 1], [1.23456789, Number.NaN])), WORDS, ["a"]);
  assert.equal(text, 'time [s],"right, mean of 3 [deg]"\n0,1.23457\n1,\n');
});

test("curves at different instants are merged in order, and sessions are named", () => {
  const text = csvText(drawn(line("right", [0, 2], [1, 2]), line("right", [1], [5], 1)), WORDS, ["=a", 'b"c']);
  assert.equal(text, `time [s],"'=a, right [deg]","b""c, right [deg]"\n0,1,\n1,,5\n2,2,\n`);
});
