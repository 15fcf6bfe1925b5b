import type { Color } from "three";
import {
  BackSide,
  type BufferGeometry,
  ConeGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { addAll } from "./layers";

const UP = new Vector3(0, 1, 0);
/** Length and radius of the head and width of the halo, in radii of the shaft. */
const HEAD_LENGTH = 6.5;
const HEAD_RADIUS = 2.7;
const HALO = 0.55;
/** Largest share of an arrow that its head may take. */
const HEAD_PART = 0.45;

/** Length of a dash and of the gap after it, in radii of the shaft, and the largest number of dashes. */
const DASH = 6.5;
const GAP = 3;
const MOST_DASHES = 40;

/** Length of the arrow of one body weight, in heights of the figure: it ends near the navel. */
const WEIGHT_HEIGHTS = 0.55;
/** The longest arrow, in heights of the figure: the scale shrinks for larger peaks. */
const LONGEST_HEIGHTS = 0.95;

/** Length of an arrow per body weight [m], if the largest force is `peak` body weights. */
export function arrowScale(height_m: number, peak: number): number {
  return height_m * Math.min(WEIGHT_HEIGHTS, peak > 0 ? LONGEST_HEIGHTS / peak : WEIGHT_HEIGHTS);
}

/** Divides an arrow of a given length into shaft and head [m]; short arrows shrink as a whole. */
export function arrowParts(length: number, radius: number): { shaft: number; head: number; headRadius: number } {
  const head = Math.min(HEAD_LENGTH * radius, HEAD_PART * length);
  return { shaft: length - head, head, headRadius: (HEAD_RADIUS / HEAD_LENGTH) * head };
}

/** Number of dashes in a shaft, and the unit of length [m] with which dashes and gaps fill it. */
export function dashParts(length: number, radius: number): { count: number; unit: number } {
  const usual = (length / radius + GAP) / (DASH + GAP);
  const count = Math.min(MOST_DASHES, Math.max(1, Math.round(usual)));
  return { count, unit: length / (count * (DASH + GAP) - GAP) };
}

/** An arrow with a solid or dashed shaft and a halo in the background colour, which separates it from objects behind it. */
export class Arrow {
  readonly group = new Group();
  private readonly material = new MeshLambertMaterial();
  private readonly halo = new MeshBasicMaterial({ side: BackSide });
  private readonly shafts: Mesh[];
  private readonly heads: Mesh[];
  private readonly turn = new Quaternion();
  private readonly unit = new Vector3();

  constructor(
    private readonly radius: number,
    private readonly dashed = false,
  ) {
    const shaft = new CylinderGeometry(1, 1, 1, 20).translate(0, 0.5, 0);
    const head = new ConeGeometry(1, 1, 28).translate(0, 0.5, 0);
    this.shafts = [new Mesh(dashed ? dashes() : shaft, this.material), new Mesh(shaft, this.halo)];
    this.heads = [new Mesh(head, this.material), new Mesh(head, this.halo)];
    addAll(this.group, [...this.shafts, ...this.heads]);
  }

  recolor(color: Color, halo: Color): void {
    this.material.color.copy(color);
    this.material.emissive.copy(color).multiplyScalar(0.5);
    this.halo.color.copy(halo);
  }

  /** Draws the arrow from a point along a vector, both in metres; hides it if the vector is very short or NaN. */
  set(point: Vector3, vector: Vector3): void {
    const length = vector.length();
    this.group.visible = Number.isFinite(point.x + point.y + point.z + length) && length > this.radius;
    if (!this.group.visible) return;
    const { shaft, head, headRadius } = arrowParts(length, this.radius);
    this.group.position.copy(point);
    this.group.quaternion.copy(this.turn.setFromUnitVectors(UP, this.unit.copy(vector).divideScalar(length)));
    const edge = HALO * this.radius;
    this.setShaft(shaft);
    this.shafts[1]?.scale.set(this.radius + edge, shaft, this.radius + edge);
    this.heads[0]?.scale.set(headRadius, head, headRadius);
    this.heads[1]?.scale.set(headRadius + 1.6 * edge, head + 2.4 * edge, headRadius + 1.6 * edge);
    this.heads[0]?.position.set(0, shaft, 0);
    this.heads[1]?.position.set(0, shaft - 0.7 * edge, 0);
  }

  private setShaft(length: number): void {
    const [shaft] = this.shafts;
    if (!this.dashed) {
      shaft?.scale.set(this.radius, length, this.radius);
      return;
    }
    const { count, unit } = dashParts(length, this.radius);
    shaft?.scale.set(this.radius, unit, this.radius);
    const corners = shaft?.geometry.index?.count ?? 0;
    shaft?.geometry.setDrawRange(0, (corners / MOST_DASHES) * count);
  }
}

/** Geometry of the dashes, of radius 1, from the lowest upwards. */
function dashes(): BufferGeometry {
  const one = new CylinderGeometry(1, 1, DASH, 14).translate(0, DASH / 2, 0);
  return mergeGeometries(Array.from({ length: MOST_DASHES }, (_, i) => one.clone().translate(0, i * (DASH + GAP), 0)));
}
