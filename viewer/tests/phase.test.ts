import assert from "node:assert/strict";
import { test } from "node:test";
import type { PageCycle } from "../src/contract";
import { cycleAt, nearestCycle, percentAt, timeAt } from "../src/phase";

const cycle = (side: "r" | "l", number: number, start_s: number): PageCycle => ({
  side,
  number,
  start_s,
  end_s: start_s + 1.25,
  foot_off_percent: 60,
});
const CYCLES = [cycle("r", 1, 1), cycle("r", 2, 2.25), cycle("l", 1, 1.6)];

test("percent and time are inverse functions", () => {
  assert.equal(percentAt(cycle("r", 1, 1), 1.5), 40);
  assert.equal(timeAt(cycle("r", 1, 1), 40), 1.5);
});

test("the cycle of a side contains the time", () => {
  assert.equal(cycleAt(CYCLES, "r", 2.5)?.number, 2);
  assert.equal(cycleAt(CYCLES, "l", 1.5), null);
});

test("outside all cycles the nearest one is used", () => {
  assert.equal(nearestCycle(CYCLES, "r", 0)?.number, 1);
  assert.equal(nearestCycle(CYCLES, "r", 9)?.number, 2);
  assert.equal(nearestCycle([], "r", 9), null);
});
