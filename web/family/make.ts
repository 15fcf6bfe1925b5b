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

/** The walk with these words; none if the command found none, which is printed. */
async function found(words: readonly string[]): Promise<Solved | undefined> {
  const walk = await solve(words);
  if (typeof walk !== "string") {
    return walk;
  }
  process.stderr.write(`${words.join(" ")}: ${walk.split("\n")[0]}\n`);
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
  words: string[];
  /** Leg length [m]. */
  leg: number;
  /** [m/s²] */
  gravity: number;
}

/** Words of the walk of a body at a point; `preferred` is the preferred step divided by the leg length. */
function wordsAt([speed, step, slope]: Point, { words, leg, gravity }: Body, preferred: number): string[] {
  const pace = ["--speed", `${speed * Math.sqrt(gravity * leg)}`];
  const length = step === 1 ? [] : ["--step-length", `${step * preferred * leg}`];
  return [...words, ...pace, ...length, ...(slope === 0 ? [] : ["--slope", `${slope}`])];
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
  const usual = await found([]);
  if (!usual) {
    throw new Error("no walk without options");
  }
  const body = { words: [], leg: usual.leg, gravity: usual.gravity };
  const walks = await all(speeds, (speed) => found(wordsAt([speed, 1, 0], body, 1)));
  const steps = walks.map((walk) => (walk ? walk.stepLength / walk.leg : Number.NaN));
  return { body, legPerStature: usual.leg / usual.height, steps };
}

/** Solves the walks of a grid. */
async function solveGrid(axes: Axes, body: Body, preferred: (point: Point) => number): Promise<(Walk | undefined)[]> {
  const hasSlopes = axes.slope.length > 1;
  return all(points(axes), async (point) => {
    const words = wordsAt(point, body, preferred(point));
    // Between slopes, level ground is predicted as well.
    const walk = await found(hasSlopes && point[2] === 0 ? [...words, "--mode", "predict"] : words);
    return walk && sampled(walk);
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
      const words = ["--mass", `${mass}`, "--height", `${height}`];
      const person = { words, leg: table.leg(height), gravity: body.gravity };
      const between = table.interpolate(grid, point);
      const exact = between && (await found(wordsAt(point, person, preferred(point))));
      return between && exact ? errorsOf(between, exact) : null;
    });
  }
  return family;
}

writeFileSync(process.argv[2] ?? "walks.json", `${JSON.stringify(await make())}\n`);
