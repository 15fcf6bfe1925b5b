import { Quaternion, Vector3 } from "three";
import type { View } from "../contract";
import { Motion } from "./motion";
import type { SeriesReader } from "./reader";
import { sample, type Timeline } from "./timeline";

/** Half of the smoothing window of the path [s]: about the duration of a step, so that the camera does not sway. */
const HALF_WINDOW_S = 0.6;
/** Shortest travel that defines a walking direction [m]. */
const TRAVEL_M = 0.5;

/** Path of the figure over the floor: the path of its pelvis. */
export class Path {
  /** Horizontal unit vector of the walking direction. */
  readonly heading: Vector3;
  private readonly root: Motion | null;
  private readonly thighs: Motion[];
  private readonly smoothX: Float64Array;
  private readonly smoothZ: Float64Array;
  private readonly turn = new Quaternion();

  constructor(view: View, numbers: SeriesReader, timeline: Timeline) {
    const body = view.bodies[rootOf(view)];
    this.root = body ? new Motion(body, numbers) : null;
    const thighs = view.bodies.filter(({ name }) => /femur|thigh|upleg/i.test(name));
    const leading = thighs.length === 2 ? thighs : body ? [body] : [];
    this.thighs = leading.map((one) => new Motion(one, numbers));
    const half = timeline.step > 0 ? Math.round(HALF_WINDOW_S / timeline.step) : 0;
    const series = body ? [numbers.read(body.position[0]), numbers.read(body.position[2])] : [];
    // A single instant may be that of a stream: its numbers change, so they are not copied.
    const [x, z] = timeline.frames > 1 ? series.map((values) => smoothed(filled(values), half)) : series;
    this.smoothX = x ?? new Float64Array(1);
    this.smoothZ = z ?? new Float64Array(1);
    this.heading = this.direction(timeline);
  }

  /** Smoothed position on the floor at a frame, height 0. */
  smooth(frame: number, into: Vector3): Vector3 {
    return into.set(sample(this.smoothX, frame), 0, sample(this.smoothZ, frame));
  }

  /** Midpoint of the hips at a frame, the same point in every model; without thighs, the origin of the pelvis. False in a gap. */
  hips(frame: number, into: Vector3): boolean {
    const sum = new Vector3();
    const all = this.thighs.every((thigh) => {
      const there = thigh.at(frame, into, this.turn);
      sum.add(into);
      return there;
    });
    into.copy(sum).divideScalar(this.thighs.length);
    return all && this.thighs.length > 0;
  }

  private direction(timeline: Timeline): Vector3 {
    const last = Math.max(0, timeline.frames - 1);
    const travel = this.smooth(last, new Vector3()).sub(this.smooth(0, new Vector3()));
    if (travel.length() > TRAVEL_M) return travel.normalize();
    return this.facing(timeline.frames);
  }

  /** Mean direction of the pelvis' forward axis, for walking on the spot. */
  private facing(frames: number): Vector3 {
    const sum = new Vector3();
    const place = new Vector3();
    for (let frame = 0; frame < frames; frame += Math.max(1, Math.floor(frames / 50))) {
      if (this.root?.at(frame, place, this.turn)) sum.add(new Vector3(1, 0, 0).applyQuaternion(this.turn));
    }
    sum.y = 0;
    return sum.length() > 1e-3 ? sum.normalize() : new Vector3(1, 0, 0);
  }
}

/** Index of the body that defines the path: the pelvis, or else the first body. */
export function rootOf(view: View): number {
  const pelvis = view.bodies.findIndex((body) => /pelvis|hips/i.test(body.name));
  return Math.max(0, pelvis);
}

/** Fills gaps by linear interpolation and extends the ends as constants. */
export function filled(values: Float64Array): Float64Array {
  const out = Float64Array.from(values);
  let last = -1;
  for (let index = 0; index < out.length; index += 1) {
    const value = out[index] as number;
    if (!Number.isFinite(value)) continue;
    const from = last < 0 ? value : (out[last] as number);
    for (let gap = last + 1; gap < index; gap += 1) {
      out[gap] = from + ((value - from) * (gap - last)) / (index - last);
    }
    last = index;
  }
  return out.fill(last < 0 ? 0 : (out[last] as number), last + 1);
}

/** Moving average over `half` frames on each side, fewer near the ends. */
export function smoothed(values: Float64Array, half: number): Float64Array {
  const sums = new Float64Array(values.length + 1);
  values.forEach((value, index) => {
    sums[index + 1] = (sums[index] as number) + value;
  });
  return values.map((_, index) => {
    const reach = Math.min(half, index, values.length - 1 - index);
    return ((sums[index + reach + 1] as number) - (sums[index - reach] as number)) / (2 * reach + 1);
  });
}
