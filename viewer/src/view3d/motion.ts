import { Quaternion, Vector3 } from "three";
import type { ViewBody, ViewPath } from "../contract";
import type { SeriesReader } from "./reader";
import { sample } from "./timeline";

/** Pose of a body at any time, of the motion of the results or between the recorded motion and this one. */
export class Motion {
  private readonly path: Path;
  private readonly recorded: Path | null;
  private readonly place = new Vector3();
  private readonly turn = new Quaternion();

  constructor(body: ViewBody, numbers: SeriesReader) {
    this.path = new Path(body, numbers);
    this.recorded = body.recorded ? new Path(body.recorded, numbers) : null;
  }

  /**
   * Writes the pose at a fractional frame; returns false in a gap. `corrected`: 1 for the motion of the results, 0 for the recorded one,
   * if they differ.
   */
  at(frame: number, position: Vector3, rotation: Quaternion, corrected = 1): boolean {
    const known = this.path.at(frame, position, rotation);
    if (!this.recorded || corrected >= 1) return known;
    if (!this.recorded.at(frame, this.place, this.turn)) return false;
    position.lerp(this.place, 1 - corrected);
    rotation.slerp(this.turn, 1 - corrected);
    return known;
  }
}

/** Linear interpolation of positions, spherical linear interpolation of orientations. */
class Path {
  private readonly position: Float64Array[];
  private readonly rotation: Float64Array[];
  private readonly next = new Quaternion();

  constructor(path: ViewPath, numbers: SeriesReader) {
    this.position = path.position.map((series) => numbers.read(series));
    this.rotation = path.rotation.map((series) => numbers.read(series));
  }

  at(frame: number, position: Vector3, rotation: Quaternion): boolean {
    const [x, y, z] = this.position as [Float64Array, Float64Array, Float64Array];
    position.set(sample(x, frame), sample(y, frame), sample(z, frame));
    const before = Math.floor(frame);
    const part = frame - before;
    this.read(before, rotation);
    if (part > 1e-6) rotation.slerp(this.read(before + 1, this.next), part);
    return Number.isFinite(position.x + position.y + position.z + rotation.x + rotation.y + rotation.z + rotation.w);
  }

  private read(frame: number, into: Quaternion): Quaternion {
    const [x, y, z, w] = this.rotation.map((values) => values[frame] ?? Number.NaN) as [number, number, number, number];
    return into.set(x, y, z, w).normalize();
  }
}
