import type { TimeAxis } from "../contract";

/** The uniform frames of a session, and interpolation between them. */
export class Timeline {
  readonly start: number;
  readonly step: number;
  readonly frames: number;

  constructor(axis: TimeAxis) {
    this.start = axis.start_s;
    this.step = axis.step_s;
    this.frames = axis.frames;
  }

  /** Time of the last frame [s]. */
  get end(): number {
    return this.start + this.step * Math.max(0, this.frames - 1);
  }

  /** Fractional frame at a time [s], limited to the recording. */
  frameAt(time: number): number {
    const frame = this.step > 0 ? (time - this.start) / this.step : 0;
    return Math.min(Math.max(frame, 0), Math.max(0, this.frames - 1));
  }
}

/** Linear interpolation between two frames; NaN next to a gap. */
export function sample(values: Float64Array, frame: number): number {
  const before = Math.floor(frame);
  const part = frame - before;
  const first = values[before] ?? Number.NaN;
  if (part < 1e-6) return first;
  const second = values[before + 1] ?? Number.NaN;
  return first + (second - first) * part;
}
