import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { solve } from "../../family/command";
import { sampled, scaledPoints } from "../../family/solved";
import {
  type Errors,
  encode,
  type Family,
  type Grid,
  pointsOf,
  QUANTITIES,
  SAMPLES,
  sampleShares,
  valueAt,
  type Walk,
  Walks,
} from "../../src/family";

// The tests are compiled to viewer/out/tests.
const FAMILY: Family = JSON.parse(
  readFileSync(fileURLToPath(new URL("../../../web/family/walks.json", import.meta.url)), "utf8"),
);
const STEPS = QUANTITIES.map(() => 2e-4);
const NO_ERROR = { rms: QUANTITIES.map(() => 0), largest: QUANTITIES.map(() => 0) };

/** A walk whose curves are a wave with this height. */
function wave(height: number, support = 0.12): Walk {
  const curve = Float64Array.from(sampleShares(support), (share) => height * Math.sin(2 * Math.PI * share));
  return { support, curves: QUANTITIES.map(() => curve) };
}

/** Two speeds, two steps; the heights of their waves are 1, 2, 3 and 4. */
function small(): Family {
  const walks = [1, 2, 3, 4].map((height) => wave(height));
  const grid: Grid = {
    axes: { speed: [0.4, 0.5], step: [0.9, 1], slope: [0] },
    walks: walks.map(({ curves }) => encode(curves, STEPS)),
    supports: walks.map(({ support }) => support),
    errors: [NO_ERROR],
  };
  const ranges = QUANTITIES.map((): [number, number] => [-4, 4]);
  return { gravity: 9.81, leg: 0.5, preferred: [0.7, 0.8], steps: STEPS, ranges, level: grid, sloped: grid };
}

test("a sampled curve has its values between the samples", () => {
  const { curves, support } = wave(1);
  const curve = curves[0] as Float64Array;
  assert.equal(curve.length, SAMPLES);
  for (let share = -0.5; share < 1.5; share += 0.013) {
    // Samples are at most h = 1/42 of a wave apart, so half a chord would be wrong by (2πh)²/8 = 0.003; where the distance of the samples changes, the
    // cubic is no better.
    const off = Math.abs(valueAt(curve, share, support) - Math.sin(2 * Math.PI * share));
    assert.ok(off < 4e-3, `${off} at ${share}`);
  }
});

test("walks of the table are themselves, others linear between them, and there is none outside", () => {
  const walks = new Walks(small());
  const height = (speed: number, step: number): number | undefined => {
    const walk = walks.interpolate(walks.family.level, [speed, step, 0]);
    const highest = (of: Walk): number => Math.max(...(of.curves[0] as Float64Array));
    return walk && Math.round((1e3 * highest(walk)) / highest(wave(1))) / 1e3;
  };
  assert.deepEqual([height(0.4, 0.9), height(0.4, 1), height(0.5, 0.9), height(0.5, 1)], [1, 2, 3, 4]);
  assert.equal(height(0.45, 0.9), 2);
  assert.equal(height(0.45, 0.95), 2.5);
  assert.equal(height(0.39, 1), undefined);
  assert.equal(height(0.45, 1.01), undefined);
});

test("the stated error is that of the cell and of its neighbours in speed", () => {
  const family = small();
  const errors = (rms: number, largest: number): Errors => ({
    rms: QUANTITIES.map(() => rms),
    largest: QUANTITIES.map(() => largest),
  });
  const grid = family.level;
  grid.axes.speed = [0.3, 0.4, 0.5, 0.6, 0.7];
  const [walk = null] = grid.walks;
  grid.walks = Array.from({ length: 10 }, () => walk);
  grid.supports = grid.walks.map(() => 0.12);
  grid.errors = [errors(1, 9), errors(3, 4), null, errors(100, 100)];
  family.preferred = [0.7, 0.7, 0.7, 0.7, 0.7];
  const stated = (speed: number): unknown =>
    new Walks(family)
      .at({ speed: speed * Math.sqrt(9.81 * 0.5), height: 1, mass: 70, stepLength: undefined, slope: 0 })
      ?.error("knee_flexion");
  assert.deepEqual(stated(0.45), { rms: Math.sqrt(5), largest: 9 });
  assert.equal(stated(0.55), undefined);
  assert.deepEqual(stated(0.65), { rms: 100, largest: 100 });
});

test("a figure that is four times as large walks the same at twice the speed", () => {
  const walks = new Walks(small());
  const [one, four] = [1, 4].map((height) => {
    const speed = 0.45 * Math.sqrt(9.81 * 0.5 * height);
    return walks.at({ speed, height, mass: 70, stepLength: undefined, slope: 0 });
  });
  assert.ok(one && four);
  assert.ok(Math.abs(one.stepLength - 0.75 * 0.5) < 1e-9 && Math.abs(four.stepLength - 4 * one.stepLength) < 1e-9);
  assert.ok(Math.abs(four.cycle_s - 2 * one.cycle_s) < 1e-9);
  const ratio = (name: string): number => (four.curve(name)[25] ?? 0) / (one.curve(name)[25] ?? 1);
  const found = ["knee_flexion", "knee_flexion_moment", "knee_flexion_power", "ground_force_vertical"].map(ratio);
  assert.ok(
    [1, 4, 2, 1].every((expected, index) => Math.abs((found[index] ?? 0) - expected) < 1e-9),
    `${found}`,
  );
});

test("the family has the walks that the command solves", async (context) => {
  if (!process.env["AMBULO"]) {
    context.skip("AMBULO does not name the command");
    return;
  }
  const speed = 0.36;
  assert.ok(FAMILY.level.axes.speed.includes(speed) && FAMILY.level.axes.step.includes(1));
  const solved = await solve({ gait: { speed: speed * Math.sqrt(FAMILY.gravity * FAMILY.leg * 1.75) } });
  assert.ok(typeof solved !== "string", String(solved));
  const stored = new Walks(FAMILY).interpolate(FAMILY.level, [speed, 1, 0]) as Walk;
  const exact = sampled(solved);
  QUANTITIES.forEach((quantity, row) => {
    const [found, expected] = [stored, exact].map(({ curves }) => curves[row] as Float64Array) as [
      Float64Array,
      Float64Array,
    ];
    const off = Math.max(...found.map((value, index) => Math.abs(value - (expected[index] ?? Number.NaN))));
    // Rounded to steps; another computer's sine moves the end of the solver by 1e-6.
    const limit = 0.5 * (FAMILY.steps[row] ?? 0) + 1e-4;
    assert.ok(off <= limit, `${quantity.name} differs by ${off}; solve the family anew: cargo xtask web --family`);
    const other = pointsOf(found, 1.2 * stored.support);
    const exactPoints = scaledPoints(quantity, solved);
    assert.ok(
      other.some((value, index) => Math.abs(value - (exactPoints[index] ?? 0)) > limit),
      "no difference is seen",
    );
  });
});
