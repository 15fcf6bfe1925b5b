import { BufferAttribute, BufferGeometry, Group, Mesh, MeshBasicMaterial, SphereGeometry } from "three";
import type { View, ViewForce } from "../contract";
import { OVER, onLayer } from "./layers";
import { type Palette, sideColor } from "./palette";
import type { SeriesReader } from "./reader";

/** Radii of the line and of the current point [m]. */
const LINE_M = 0.006;
const POINT_M = 0.013;
/** Corners in a cross-section of the line. */
const SIDES = 6;
/** Longest distance between two frames of one trail [m]. */
const JUMP_M = 0.15;

/** First frame of the contact that contains a frame: all frames from there have a point; -1 outside contacts. */
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

/** A position in the world [m]. */
export type Place = [x: number, y: number, z: number];

/** Corners of horizontal rings around points, `SIDES` per ring, and the opacity of each ring: 0.08 at the oldest point, 1 at the last. */
export function rings(points: Place[], radius: number): { corners: Place[]; strength: number[] } {
  const corners: Place[] = [];
  const strength: number[] = [];
  for (const [index, [px, py, pz]] of points.entries()) {
    const before = points[Math.max(0, index - 1)] ?? [px, py, pz];
    const after = points[Math.min(points.length - 1, index + 1)] ?? [px, py, pz];
    const [x, z] = [after[0] - before[0], after[2] - before[2]];
    const length = Math.hypot(x, z) || 1;
    for (let side = 0; side < SIDES; side += 1) {
      const angle = (2 * Math.PI * side) / SIDES;
      const across = radius * Math.cos(angle);
      corners.push([px - (z / length) * across, py + radius * Math.sin(angle), pz + (x / length) * across]);
    }
    strength.push(0.08 + (0.92 * (index + 1)) / points.length);
  }
  return { corners, strength };
}

interface Track {
  source: ViewForce;
  /** Point of application of the force: x, y, z [m]. */
  place: [Float64Array, Float64Array, Float64Array];
  line: Mesh<BufferGeometry, MeshBasicMaterial>;
  point: Mesh<SphereGeometry, MeshBasicMaterial>;
}

/** Trails of the centres of pressure of the current contacts. */
export class Trail {
  readonly group = new Group();
  private readonly tracks: Track[];

  constructor(view: View, numbers: SeriesReader) {
    this.tracks = view.forces.filter(leavesTrail).map((source) => track(source, numbers));
    for (const { line, point } of this.tracks) {
      this.group.add(line, point);
    }
    onLayer(this.group, OVER);
  }

  recolor(colors: Palette): void {
    for (const { source, line, point } of this.tracks) {
      line.material.color.copy(sideColor(colors, source.side));
      point.material.color.copy(sideColor(colors, source.side));
    }
  }

  pose(frame: number): void {
    for (const one of this.tracks) {
      const points = trailPoints(one.place, Math.floor(frame));
      one.line.visible = points.length > 1;
      one.point.visible = points.length > 0;
      const last = points[points.length - 1];
      if (last) {
        one.point.position.set(...last);
      }
      if (points.length > 1) {
        fill(one.line.geometry, points);
      }
    }
  }
}

/** Whether a force leaves a trail: forces on feet only. */
export function leavesTrail(force: ViewForce): boolean {
  return force.role === "main" && force.side !== null;
}

/** Points of the contact up to a frame, from the last jump. */
export function trailPoints([x, y, z]: Track["place"], frame: number): Place[] {
  const start = contactStart(x, frame);
  const points: Place[] = [];
  for (let index = start; start >= 0 && index <= frame; index += 1) {
    const point: Place = [x[index] ?? Number.NaN, y[index] ?? Number.NaN, z[index] ?? Number.NaN];
    const last = points[points.length - 1];
    if (last && Math.hypot(point[0] - last[0], point[2] - last[2]) > JUMP_M) {
      points.length = 0;
    }
    points.push(point);
  }
  return points;
}

function track(source: ViewForce, numbers: SeriesReader): Track {
  const line = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ transparent: true, vertexColors: true }));
  line.frustumCulled = false;
  const point = new Mesh(new SphereGeometry(POINT_M, 20, 14), new MeshBasicMaterial());
  const place = source.point.map((series) => numbers.read(series)) as Track["place"];
  return { source, place, line, point };
}

function fill(geometry: BufferGeometry, points: Place[]): void {
  const { corners, strength } = rings(points, LINE_M);
  const position = room(geometry, points.length);
  const color = geometry.getAttribute("color") as BufferAttribute;
  for (const [index, corner] of corners.entries()) {
    position.setXYZ(index, ...corner);
    color.setXYZW(index, 1, 1, 1, strength[Math.floor(index / SIDES)] ?? 0);
  }
  position.needsUpdate = true;
  color.needsUpdate = true;
  geometry.setDrawRange(0, 6 * SIDES * (points.length - 1));
}

/** Buffer for the corners of a given number of rings. */
function room(geometry: BufferGeometry, count: number): BufferAttribute {
  const known = geometry.getAttribute("position") as BufferAttribute | undefined;
  if (known && known.count >= count * SIDES) {
    return known;
  }
  const most = Math.max(64, 2 * count);
  const position = new BufferAttribute(new Float32Array(3 * SIDES * most), 3);
  const index: number[] = [];
  for (let ring = 0; ring + 1 < most; ring += 1) {
    for (let side = 0; side < SIDES; side += 1) {
      const a = ring * SIDES + side;
      const b = ring * SIDES + ((side + 1) % SIDES);
      index.push(a, b, a + SIDES, b, b + SIDES, a + SIDES);
    }
  }
  geometry.dispose();
  geometry.setAttribute("position", position);
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(4 * SIDES * most), 4));
  geometry.setIndex(index);
  return position;
}
