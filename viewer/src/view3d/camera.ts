import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Extent } from "./extent";

/** Viewpoint of the camera. */
export type CameraKind = "side" | "front" | "free";

/** Vertical opening angle of the camera [rad]: narrow, so that near and far legs look alike. */
const OPENING = (24 * Math.PI) / 180;
/** Margin around the figure. */
const MARGIN = 1.06;
/** Margin below the floor for the metre numbers, in heights of the figure. */
const BELOW = 0.09;
/** Direction to the camera [rad]: azimuth from straight ahead towards the figure's right, and elevation. */
const DIRECTIONS: Record<CameraKind, { turn: number; rise: number }> = {
  side: { turn: Math.PI / 2, rise: 0.1 },
  front: { turn: 0, rise: 0.1 },
  free: { turn: 0.9, rise: 0.26 },
};

/** Distance at which a box of a given half height and half width fills the picture [m]. */
export function fittingDistance(halfHeight: number, halfWidth: number, depth: number, aspect: number): number {
  const slope = Math.tan(OPENING / 2);
  return MARGIN * Math.max(halfHeight / slope, halfWidth / (slope * aspect)) + depth;
}

/** Unit vector from the figure to the camera; `heading` is the walking direction. */
export function directionOf(kind: CameraKind, heading: Vector3): Vector3 {
  const { turn, rise } = DIRECTIONS[kind];
  const right = new Vector3(-heading.z, 0, heading.x);
  return heading
    .clone()
    .multiplyScalar(Math.cos(turn))
    .addScaledVector(right, Math.sin(turn))
    .multiplyScalar(Math.cos(rise))
    .add(new Vector3(0, Math.sin(rise), 0));
}

/** Camera with controls; it follows the figure and keeps the reader's rotation. */
export class CameraRig {
  readonly camera = new PerspectiveCamera((OPENING * 180) / Math.PI, 1, 0.1, 80);
  readonly controls: OrbitControls;
  kind: CameraKind = "side";
  private readonly place = new Vector3();
  private touched = false;

  constructor(
    canvas: HTMLCanvasElement,
    private extent: Extent,
    private readonly heading: Vector3,
  ) {
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = Math.PI * 0.52;
    this.controls.minDistance = 0.5;
    this.controls.maxDistance = 40;
    this.controls.enableDamping = false;
    this.controls.zoomSpeed = 0.8;
    this.controls.addEventListener("start", () => {
      this.touched = true;
    });
  }

  /** Moves to a viewpoint around the figure's current position. */
  set(kind: CameraKind): void {
    this.kind = kind;
    this.touched = false;
    this.fit();
  }

  /** Follows the figure to a position on the floor, and, until the reader turns or zooms, frames its extent there. */
  follow(place: Vector3, extent: Extent): void {
    this.extent = extent;
    const step = place.clone().sub(this.place);
    this.place.copy(place);
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
    if (!this.touched) {
      this.fit();
    }
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    if (!this.touched) {
      this.fit();
    }
  }

  /** Rotates around the figure by angles [rad]. */
  turn(around: number, up: number): void {
    this.touched = true;
    const arm = this.camera.position.clone().sub(this.controls.target);
    const length = arm.length();
    const azimuth = Math.atan2(arm.x, arm.z) + around;
    const rise = Math.min(1.5, Math.max(-0.05, Math.asin(arm.y / length) + up));
    arm
      .set(Math.sin(azimuth) * Math.cos(rise), Math.sin(rise), Math.cos(azimuth) * Math.cos(rise))
      .multiplyScalar(length);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
  }

  /** Zooms in by a factor. */
  zoom(factor: number): void {
    this.touched = true;
    const arm = this.camera.position.clone().sub(this.controls.target).divideScalar(factor);
    arm.clampLength(this.controls.minDistance, this.controls.maxDistance);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
  }

  private fit(): void {
    const { top, along, across } = this.extent;
    const bottom = this.extent.bottom - BELOW * (top - this.extent.bottom);
    const towards = directionOf(this.kind, this.heading);
    const wide = this.kind === "side" ? along : this.kind === "front" ? across : Math.max(along, across);
    const deep = this.kind === "side" ? across : along;
    const distance = fittingDistance((top - bottom) / 2, wide, 0.5 * deep, this.camera.aspect);
    this.controls.target.copy(this.place);
    this.controls.target.y = (top + bottom) / 2;
    this.camera.position.copy(this.controls.target).addScaledVector(towards, distance);
    this.controls.update();
  }
}
