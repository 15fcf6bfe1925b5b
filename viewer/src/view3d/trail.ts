import { BufferAttribute, BufferGeometry, CircleGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial } from "three";
import type { View, ViewForce } from "../contract";
import { type Palette, sideColor } from "./palette";
import type { SeriesReader } from "./reader";

/** Above the floor [m], so that the floor does not shine through. */
const LIFT_M = 0.004;
/** Breadth of the ribbon [m] and radius of the present point. */
const BREADTH_M = 0.014;
const POINT_M = 0.016;
/** Longest jump between two frames that is still one trail [m]. */
const JUMP_M = 0.15;

/** First frame of the contact that a frame is in: all from there on have a point; -1 out of contact. */
export function contactStart(x: Float64Array, frame: number): number {
  if (!Number.isFinite(x[frame] ?? Number.NaN)) {
    return -1;
  }
  let first = frame;
  while (first > 0 && Number.isFinite(x[first - 1] ?? Number.NaN)) {
    first -= 1;
  }
  return first;
}

/** Corners and strengths of a ribbon along points on the floor; the strength grows from 0.1 at the oldest point to 1. */
export function ribbon(
  points: [number, number][],
  breadth: number,
): { corners: [number, number][]; strength: number[] } {
  const corners: [number, number][] = [];
  const strength: number[] = [];
  points.forEach((point, index) => {
    const before = points[Math.max(0, index - 1)] ?? point;
    const after = points[Math.min(points.length - 1, index + 1)] ?? point;
    const along = [after[0] - before[0], after[1] - before[1]] as const;
    const length = Math.hypot(...along) || 1;
    const across = [(-along[1] / length) * (breadth / 2), (along[0] / length) * (breadth / 2)] as const;
    corners.push([point[0] + across[0], point[1] + across[1]], [point[0] - across[0], point[1] - across[1]]);
    const part = 0.1 + (0.9 * (index + 1)) / points.length;
    strength.push(part, part);
  });
  return { corners, strength };
}

interface Track {
  source: ViewForce;
  x: Float64Array;
  z: Float64Array;
  ribbon: Mesh<BufferGeometry, MeshBasicMaterial>;
  point: Mesh<CircleGeometry, MeshBasicMaterial>;
}

/** Where the centres of pressure of the present contacts have been. */
export class Trail {
  readonly group = new Group();
  private readonly tracks: Track[];

  constructor(
    view: View,
    numbers: SeriesReader,
    private readonly floor: number,
  ) {
    this.tracks = view.forces
      .filter((force) => force.role === "main")
      .map((source) => track(source, numbers.read(source.point[0]), numbers.read(source.point[2])));
    for (const { ribbon, point } of this.tracks) {
      this.group.add(ribbon, point);
    }
  }

  recolor(colors: Palette): void {
    for (const { source, ribbon, point } of this.tracks) {
      ribbon.material.color.copy(sideColor(colors, source.side));
      point.material.color.copy(sideColor(colors, source.side));
    }
  }

  pose(frame: number): void {
    for (const one of this.tracks) {
      const points = trailPoints(one.x, one.z, Math.floor(frame));
      one.ribbon.visible = points.length > 1;
      one.point.visible = points.length > 0;
      const last = points[points.length - 1];
      if (last) {
        one.point.position.set(last[0], this.floor + LIFT_M * 1.5, last[1]);
      }
      if (points.length > 1) {
        fill(one.ribbon.geometry, points, this.floor + LIFT_M);
      }
    }
  }
}

/** Points of the contact up to a frame, after the last jump. */
export function trailPoints(x: Float64Array, z: Float64Array, frame: number): [number, number][] {
  const start = contactStart(x, frame);
  const points: [number, number][] = [];
  for (let index = start; start >= 0 && index <= frame; index += 1) {
    const point: [number, number] = [x[index] ?? Number.NaN, z[index] ?? Number.NaN];
    const last = points[points.length - 1];
    if (last && Math.hypot(point[0] - last[0], point[1] - last[1]) > JUMP_M) {
      points.length = 0;
    }
    points.push(point);
  }
  return points;
}

function track(source: ViewForce, x: Float64Array, z: Float64Array): Track {
  const look = { transparent: true, depthWrite: false, side: DoubleSide };
  const mesh = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ ...look, vertexColors: true }));
  mesh.frustumCulled = false;
  const point = new Mesh(new CircleGeometry(POINT_M, 28).rotateX(-Math.PI / 2), new MeshBasicMaterial(look));
  return { source, x, z, ribbon: mesh, point };
}

function fill(geometry: BufferGeometry, points: [number, number][], height: number): void {
  const { corners, strength } = ribbon(points, BREADTH_M);
  const count = corners.length;
  let position = geometry.getAttribute("position") as BufferAttribute | undefined;
  if (!position || position.count < count) {
    geometry.dispose();
    position = new BufferAttribute(new Float32Array(6 * count), 3);
    geometry.setAttribute("position", position);
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(8 * count), 4));
    geometry.setIndex(
      Array.from({ length: Math.max(0, count - 1) }, (_, i) => [
        2 * i,
        2 * i + 1,
        2 * i + 2,
        2 * i + 1,
        2 * i + 3,
        2 * i + 2,
      ]).flat(),
    );
  }
  const color = geometry.getAttribute("color") as BufferAttribute;
  corners.forEach(([x, z], index) => {
    position.setXYZ(index, x, height, z);
    color.setXYZW(index, 1, 1, 1, strength[index] ?? 0);
  });
  position.needsUpdate = true;
  color.needsUpdate = true;
  geometry.setDrawRange(0, 6 * (count / 2 - 1));
}
