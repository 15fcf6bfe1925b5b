import { Quaternion, type Vector3 } from "three";
import type { ViewBody } from "../contract";
import type { SeriesReader } from "./reader";
import { sample } from "./timeline";

/** Pose of a body at any time: linear interpolation of positions, spherical linear interpolation of orientations. */
export class Motion {
  private readonly position: Float64Array[];
  private readonly rotation: Float64Array[];
  private readonly next = new Quaternion();

  constructor(body: ViewBody, numbers: SeriesReader) {
    this.position = body.position.map((series) => numbers.read(series));
    this.rotation = body.rotation.map((series) => numbers.read(series));
  }

  /** Writes the pose at a fractional frame; returns false in a gap. */
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
