// Solves the family of walks of the page and writes it to a file: `cargo xtask web --family`. AMBULO names the program that solves them.

import { writeFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import {
  type Axes,
  type Errors,
  encode,
  type Family,
  type Grid,
  pointsOf,
  QUANTITIES,
  type Walk,
  Walks,
} from "../src/family";
import type { FigureArgs, WalkArgs } from "../src/request";
import { solve } from "./command";
import { type Solved, sampled, scaledPoints } from "./solved";

/** Dimensionless speeds, steps as shares of the preferred one, slopes [%]. 0.429 is free walking. */
const LEVEL: Axes = { speed: [0.18, 0.24, 0.3, 0.36, 0.429, 0.5, 0.57, 0.64], step: [0.82, 0.91, 1, 1.1], slope: [0] };
const SLOPED: Axes = { speed: [0.22, 0.36, 0.5], step: [0.9, 1, 1.1], slope: [-15, -7.5, 0, 7.5, 15] };
/** Persons of the measured walks, in turn: mass [kg] and stature [m]. */
const PERSONS = [
  [75, 1.75],
  [50, 1.5],
  [110, 1.9],
  [60, 1.95],
  [100, 1.55],
] as const;
/** Numbers of 16 bits reach so far. */
const LARGEST = 32_767;

type Point = readonly [speed: number, step: number, slope: number];

/** A walk that is solved; none if the command found none, which is printed. */
async function found(walk: WalkArgs): Promise<Solved | undefined> {
  const solved = await solve(walk);
  if (typeof solved !== "string") {
    return solved;
  }
  process.stderr.write(`${JSON.stringify(walk)}: ${solved.split("\n")[0]}\n`);
  return undefined;
}

/** Works on all items, as many at a time as there are processors. */
async function all<T, R>(items: readonly T[], work: (item: T, index: number) => Promise<R>): Promise<R[]> {
  const results: R[] = [];
  let next = 0;
  const one = async (): Promise<void> => {
    while (next < items.length) {
      const index = next++;
      results[index] = await work(items[index] as T, index);
    }
  };
  await Promise.all(Array.from({ length: availableParallelism() }, one));
  return results;
}

const points = ({ speed, step, slope }: Axes): Point[] =>
  speed.flatMap((v) => step.flatMap((s) => slope.map((angle): Point => [v, s, angle])));

/** Centres of the cells. */
function centres(axes: Axes): Point[] {
  const middles = (axis: number[]): number[] =>
    axis.length === 1 ? axis : axis.slice(1).map((to, index) => 0.5 * (to + (axis[index] ?? to)));
  return points({ speed: middles(axes.speed), step: middles(axes.step), slope: middles(axes.slope) });
}

/** A body, as the command knows it. */
interface Body {
  figure: FigureArgs;
  /** Leg length [m]. */
  leg: number;
  /** [m/s²] */
  gravity: number;
}

/** The walk of a body at a point; `preferred` is the preferred step divided by the leg length. */
function walkAt([speed, step, slope]: Point, { figure, leg, gravity }: Body, preferred: number): WalkArgs {
  const gait = { speed: speed * Math.sqrt(gravity * leg), step_length: step === 1 ? null : step * preferred * leg };
  return { figure, gait, conditions: { slope: slope === 0 ? null : slope } };
}

/** Steps of the stored numbers by quantity, and the range of the numbers. */
function stepsOf(walks: readonly Walk[]): Pick<Family, "steps" | "ranges"> {
  const ranges = QUANTITIES.map((_, row): [number, number] => {
    const values = walks.flatMap(({ curves }) => [...(curves[row] ?? [])]);
    return [Math.min(...values), Math.max(...values)];
  });
  const short = (value: number): number => Number(value.toPrecision(4));
  return {
    // Larger than needed, so that rounding the step does not overflow.
    steps: ranges.map(([low, high]) => short((1.001 * Math.max(-low, high)) / LARGEST)),
    ranges: ranges.map(([low, high]) => [short(low), short(high)]),
  };
}

/** The error of an interpolated walk. */
function errorsOf(walk: Walk, solved: Solved): Errors {
  const short = (value: number): number => Number(value.toPrecision(3));
  const differences = QUANTITIES.map((quantity, row) => {
    const exact = scaledPoints(quantity, solved);
    const found = pointsOf(walk.curves[row] as Float64Array, walk.support);
    return found.map((value, index) => value - (exact[index] ?? Number.NaN));
  });
  return {
    rms: differences.map((row) => short(Math.sqrt(row.reduce((sum, x) => sum + x * x, 0) / row.length))),
    largest: differences.map((row) => short(Math.max(...row.map(Math.abs)))),
  };
}

/** The usual body and the steps that it prefers at some speeds, divided by its leg length. */
async function prefers(speeds: readonly number[]): Promise<{ body: Body; legPerStature: number; steps: number[] }> {
  const usual = await found({});
  if (!usual) {
    throw new Error("no walk without options");
  }
  const body = { figure: {}, leg: usual.leg, gravity: usual.gravity };
  const walks = await all(speeds, (speed) => found(walkAt([speed, 1, 0], body, 1)));
  const steps = walks.map((walk) => (walk ? walk.stepLength / walk.leg : Number.NaN));
  return { body, legPerStature: usual.leg / usual.height, steps };
}

/** Solves the walks of a grid. */
async function solveGrid(axes: Axes, body: Body, preferred: (point: Point) => number): Promise<(Walk | undefined)[]> {
  const hasSlopes = axes.slope.length > 1;
  return all(points(axes), async (point) => {
    const walk = walkAt(point, body, preferred(point));
    // Between slopes, level ground is predicted as well.
    const solved = await found(hasSlopes && point[2] === 0 ? { ...walk, mode: "predict" } : walk);
    return solved && sampled(solved);
  });
}

async function make(): Promise<Family> {
  const { body, legPerStature, steps } = await prefers(LEVEL.speed);
  const empty = (axes: Axes): Grid => ({ axes, supports: [], walks: [], errors: [] });
  const family: Family = {
    gravity: body.gravity,
    leg: legPerStature,
    preferred: steps.map((step) => Number(step.toFixed(6))),
    steps: [],
    ranges: [],
    level: empty(LEVEL),
    sloped: empty(SLOPED),
  };
  const table = new Walks(family);
  const preferred = ([speed]: Point): number => {
    const step = table.preferredStep(speed * Math.sqrt(body.gravity * body.leg), body.leg / legPerStature);
    return (step ?? Number.NaN) / body.leg;
  };
  const solved: [Grid, (Walk | undefined)[]][] = [];
  for (const grid of [family.level, family.sloped]) {
    solved.push([grid, await solveGrid(grid.axes, body, preferred)]);
  }
  const every = solved.flatMap(([, walks]) => walks.filter((walk) => walk !== undefined));
  Object.assign(family, stepsOf(every));
  for (const [grid, walks] of solved) {
    grid.walks = walks.map((walk) => (walk ? encode(walk.curves, family.steps) : null));
    grid.supports = walks.map((walk) => Number((walk?.support ?? 0).toFixed(6)));
    grid.errors = await all(centres(grid.axes), async (point, number) => {
      const [mass, height] = PERSONS[number % PERSONS.length] ?? PERSONS[0];
      const person = { figure: { mass, height }, leg: table.leg(height), gravity: body.gravity };
      const between = table.interpolate(grid, point);
      const exact = between && (await found(walkAt(point, person, preferred(point))));
      return between && exact ? errorsOf(between, exact) : null;
    });
  }
  return family;
}

writeFileSync(process.argv[2] ?? "walks.json", `${JSON.stringify(await make())}\n`);
