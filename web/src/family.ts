// Walks that were solved beforehand, and walks between them. This is the one place that interpolates: the page shows its curves, and `family/make.ts`
// measures with it how far they are from walks that are solved exactly.
//
// A figure walks the same if everything is scaled with the length L of its leg (Hof 1996: angles stay, speeds grow with √(gL), times with √(L/g), forces with
// the weight, moments with weight times L). So stature and mass need no walks of their own; what does not scale, such as the shoes, is part of the
// error. The walks differ in dimensionless speed V / √(gL), in step length divided by the preferred step at that speed, and in the slope of the
// ground; between them, every number is linear in each of the three.
//
// The curves are registered: their samples divide the four parts of a cycle (double support, single support, and both again for the other leg) into
// equal shares. So the forces of two walks rise and fall in the same samples, and interpolation does not blur them.

/** Samples of the parts of a cycle of the right leg: double support, single support, double support, swing. */
const PARTS = [8, 16, 8, 16] as const;
export const SAMPLES = PARTS.reduce((sum, part) => sum + part, 0);
/** Points of a curve from 0 to 100 % of the cycle. */
export const POINTS = 101;

/** A curve, and the power of the leg length [m] that it grows with. */
export interface Quantity {
  name: string;
  power: number;
}

/** A column of clinical.csv of the right side. */
const clinical = (name: string, power: number): Quantity => ({ name, power });
/** Place of a joint in the sagittal plane, without the even forward motion [m]. */
const place = (joint: string): Quantity[] => ["x", "y"].map((axis) => ({ name: `${joint}_${axis}`, power: 1 }));
const JOINTS = ["hip_flexion", "knee_flexion", "ankle_dorsiflexion"];

/** The curves of a walk. */
export const QUANTITIES: readonly Quantity[] = [
  ...JOINTS.map((joint) => clinical(joint, 0)),
  ...JOINTS.map((joint) => clinical(`${joint}_moment`, 1)),
  ...JOINTS.map((joint) => clinical(`${joint}_power`, 0.5)),
  ...["vertical", "fore_aft", "lateral"].map((axis) => clinical(`ground_force_${axis}`, 0)),
  ...["shoulder", "hip", "knee", "ankle", "ball"].flatMap(place),
  { name: "pressure_x", power: 1 },
];

/** A walk: double support as a share of the cycle, and the curves, each divided by its power of the leg length. */
export interface Walk {
  support: number;
  /** One row of samples per quantity. */
  curves: Float64Array[];
}

/** Numbers along the three directions in which walks differ. */
export interface Axes {
  /** V / √(gL). */
  speed: number[];
  /** Step length divided by the preferred one at this speed. */
  step: number[];
  /** [%] */
  slope: number[];
}

/** Difference of an interpolated walk from the exact one, by quantity, divided by the power of the leg length. */
export interface Errors {
  /** Root of the mean square over the cycle. */
  rms: number[];
  largest: number[];
}

/** Walks of one kind. The last axis changes fastest. */
export interface Grid {
  axes: Axes;
  supports: number[];
  /** Samples in steps of the quantity, 16 bits each, little-endian, base64; `null` where no walk was found. */
  walks: (string | null)[];
  /** Errors at the centre of each cell between neighbours on all axes; `null` where no walk was found. */
  errors: (Errors | null)[];
}

export interface Family {
  /** [m/s²] */
  gravity: number;
  /** Leg length divided by stature. */
  leg: number;
  /** Preferred step length, divided by the leg length, at the speeds of the level walks. */
  preferred: number[];
  /** Steps of the stored numbers by quantity. */
  steps: number[];
  /** Largest and smallest numbers by quantity. */
  ranges: [number, number][];
  /** On level ground, near normative curves. */
  level: Grid;
  /** On slopes, predicted. */
  sloped: Grid;
}

/** Values of the sliders; without a step length, it is the preferred one. */
export interface Values {
  /** [m/s] */
  speed: number;
  /** [m] */
  stepLength: number | undefined;
  /** [m] */
  height: number;
  /** [kg] */
  mass: number;
  /** [%] */
  slope: number;
}

/** A walk in between, in the units of its person. */
export interface Between {
  /** [m] */
  stepLength: number;
  cycle_s: number;
  /** [m] */
  leg: number;
  /** Shares of the cycle. */
  support: number;
  curve(name: string): Float64Array;
  /** Error of a curve, measured nearby: root of the mean square over the cycle, and largest. */
  error(name: string): { rms: number; largest: number };
}

export function indexOf(name: string): number {
  const index = QUANTITIES.findIndex((quantity) => quantity.name === name);
  if (index < 0) {
    throw new Error(`no quantity ${name}`);
  }
  return index;
}

/** Places of the samples in the cycle [shares of it]. */
export function sampleShares(support: number): number[] {
  const ends = [0, support, 0.5, 0.5 + support, 1] as const;
  return PARTS.flatMap((count, part) => {
    const [from, to] = [ends[part] ?? 0, ends[part + 1] ?? 1];
    return Array.from({ length: count }, (_, index) => from + ((to - from) * index) / count);
  });
}

/** Number of the sample, with a fraction, at a share of the cycle. */
function sampleAt(share: number, support: number): number {
  const ends = [0, support, 0.5, 0.5 + support, 1] as const;
  let before = 0;
  for (const [part, count] of PARTS.entries()) {
    const [from, to] = [ends[part] ?? 0, ends[part + 1] ?? 1];
    if (share < to || part === PARTS.length - 1) {
      return before + ((share - from) / (to - from)) * count;
    }
    before += count;
  }
  return before;
}

/** A curve at a share of the cycle: a cubic through the four nearest samples (Catmull and Rom). */
export function valueAt(curve: Float64Array, share: number, support: number): number {
  const at = sampleAt(share - Math.floor(share), support);
  const index = Math.floor(at);
  const u = at - index;
  const [a, b, c, d] = [-1, 0, 1, 2].map((step) => curve[(index + step + SAMPLES) % SAMPLES] ?? 0) as [
    number,
    number,
    number,
    number,
  ];
  return b + 0.5 * u * (c - a + u * (2 * a - 5 * b + 4 * c - d + u * (3 * (b - c) + d - a)));
}

/** Points of a curve from 0 to 100 % of the cycle. */
export function pointsOf(curve: Float64Array, support: number): Float64Array {
  return Float64Array.from({ length: POINTS }, (_, index) => valueAt(curve, index / (POINTS - 1), support));
}

/** Neighbours on an axis and the share of the second; none outside. */
function between(axis: readonly number[], x: number): { index: number; share: number } | undefined {
  const last = axis.length - 1;
  const slack = 1e-6 * (Math.abs(x) + 1);
  if (!(x >= (axis[0] ?? 0) - slack && x <= (axis[last] ?? 0) + slack)) {
    return undefined;
  }
  const found = axis.findIndex((value) => value >= x);
  const index = Math.max((found < 0 ? last : found) - 1, 0);
  const [from, to] = [axis[index] ?? 0, axis[Math.min(index + 1, last)] ?? 0];
  return { index, share: to > from ? Math.min(Math.max((x - from) / (to - from), 0), 1) : 0 };
}

/** Linear between the values of a table. */
function linear(axis: readonly number[], values: readonly number[], x: number): number | undefined {
  const found = between(axis, x);
  if (!found) {
    return undefined;
  }
  const { index, share } = found;
  return (1 - share) * (values[index] ?? 0) + share * (values[Math.min(index + 1, values.length - 1)] ?? 0);
}

function axesOf({ axes: { speed, step, slope } }: Grid): readonly (readonly number[])[] {
  return [speed, step, slope];
}

/**
 * The errors near a point: those of its cell and of the cells with the next lower and higher speeds, whose persons differ. The root mean square is that
 * of all, the largest error the largest of them; none if the error of the cell itself is not known.
 */
function errorsAt(grid: Grid, point: readonly number[]): Errors | undefined {
  const axes = axesOf(grid);
  const cells = axes.map((axis) => Math.max(axis.length - 1, 1));
  const own = axes.map((axis, direction) => between(axis, point[direction] ?? 0)?.index ?? 0);
  const at = (faster: number): Errors | undefined => {
    const speed = (own[0] ?? 0) + faster;
    const isCell = speed >= 0 && speed < (cells[0] ?? 0);
    const cell = (speed * (cells[1] ?? 1) + (own[1] ?? 0)) * (cells[2] ?? 1) + (own[2] ?? 0);
    return (isCell && grid.errors[cell]) || undefined;
  };
  const near = [-1, 0, 1].map(at).filter((errors) => errors !== undefined);
  const of = (kind: keyof Errors, row: number): number[] => near.map((errors) => errors[kind][row] ?? 0);
  return (
    at(0) && {
      rms: QUANTITIES.map((_, row) => Math.hypot(...of("rms", row)) / Math.sqrt(near.length)),
      largest: QUANTITIES.map((_, row) => Math.max(...of("largest", row))),
    }
  );
}

/** The samples of a stored walk in the steps of their quantities. */
function decode(text: string): Int16Array {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Int16Array.from({ length: bytes.length / 2 }, (_, index) => view.getInt16(2 * index, true));
}

/** A walk as it is stored. */
export function encode(curves: readonly Float64Array[], steps: readonly number[]): string {
  const bytes = new DataView(new ArrayBuffer(2 * SAMPLES * curves.length));
  curves.forEach((curve, row) => {
    curve.forEach((value, index) => {
      bytes.setInt16(2 * (row * SAMPLES + index), Math.round(value / (steps[row] ?? 1)), true);
    });
  });
  return btoa(Array.from(new Uint8Array(bytes.buffer), (byte) => String.fromCharCode(byte)).join(""));
}

/** The walks of a family, decoded when they are first needed. */
export class Walks {
  private readonly decoded = new Map<string, Int16Array>();

  constructor(readonly family: Family) {}

  /** The leg length of a stature [m]. */
  leg(height: number): number {
    return this.family.leg * height;
  }

  /** The dimensionless speed of a speed and a stature. */
  dimensionless(speed: number, height: number): number {
    return speed / Math.sqrt(this.family.gravity * this.leg(height));
  }

  /** The preferred step length [m]. */
  preferredStep(speed: number, height: number): number | undefined {
    const step = linear(this.family.level.axes.speed, this.family.preferred, this.dimensionless(speed, height));
    return step === undefined ? undefined : step * this.leg(height);
  }

  /** The walk with these values; none outside the family. */
  at(values: Values): Between | undefined {
    const { speed, height, slope } = values;
    const leg = this.leg(height);
    const preferred = this.preferredStep(speed, height);
    if (preferred === undefined) {
      return undefined;
    }
    const stepLength = values.stepLength ?? preferred;
    const grid = slope === 0 ? this.family.level : this.family.sloped;
    const point = [this.dimensionless(speed, height), stepLength / preferred, slope] as const;
    const walk = this.interpolate(grid, point);
    const errors = errorsAt(grid, point);
    if (!walk || !errors) {
      return undefined;
    }
    const scale = (index: number): number => leg ** (QUANTITIES[index]?.power ?? 0);
    return {
      stepLength,
      cycle_s: (2 * stepLength) / speed,
      leg,
      support: walk.support,
      curve: (name) => {
        const index = indexOf(name);
        const points = pointsOf(walk.curves[index] as Float64Array, walk.support);
        return points.map((value) => value * scale(index));
      },
      error: (name) => {
        const index = indexOf(name);
        return { rms: (errors.rms[index] ?? 0) * scale(index), largest: (errors.largest[index] ?? 0) * scale(index) };
      },
    };
  }

  /** The walk at a point of speed, step and slope. */
  interpolate(grid: Grid, point: readonly [number, number, number]): Walk | undefined {
    const axes = axesOf(grid);
    const curves = QUANTITIES.map(() => new Float64Array(SAMPLES));
    let support = 0;
    const found = axes.map((axis, direction) => between(axis, point[direction] ?? 0));
    for (let corner = 0; corner < 8; corner++) {
      let [weight, node] = [1, 0];
      for (const [direction, place] of found.entries()) {
        if (!place) {
          return undefined;
        }
        const upper = (corner >> direction) & 1;
        weight *= upper === 1 ? place.share : 1 - place.share;
        node = node * (axes[direction]?.length ?? 1) + place.index + upper;
      }
      if (weight === 0) {
        continue;
      }
      const text = grid.walks[node];
      if (!text) {
        return undefined;
      }
      support += weight * (grid.supports[node] ?? 0);
      this.add(curves, text, weight);
    }
    return { support, curves };
  }

  private add(curves: Float64Array[], text: string, weight: number): void {
    const numbers = this.decoded.get(text) ?? decode(text);
    this.decoded.set(text, numbers);
    curves.forEach((curve, row) => {
      const factor = weight * (this.family.steps[row] ?? 1);
      for (let index = 0; index < SAMPLES; index++) {
        curve[index] = (curve[index] ?? 0) + factor * (numbers[row * SAMPLES + index] ?? 0);
      }
    });
  }
}
