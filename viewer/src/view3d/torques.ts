import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  ConeGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  RingGeometry,
  Vector3,
} from "three";
import type { RedSpan, View, ViewTorque } from "../contract";
import type { Figure } from "./figure";
import { addAll, OVER, onLayer } from "./layers";
import { type Palette, sideColor } from "./palette";
import type { SeriesReader } from "./reader";
import { sample } from "./timeline";

/** Radii of an arc and of its tube, in heights of the figure. */
const RADIUS = 0.055;
const TUBE = 0.0048;
/** Moment of a full arc [N.m/kg], about the largest in walking, and the angle of that arc. */
const FULL = 1.6;
const FULL_ANGLE = 1.6 * Math.PI;
/** Below this nothing is drawn [N.m/kg]. */
const SMALL = 0.04;
const SEGMENTS = 72;
const SIDES = 10;

/** Signed angle of a moment's arc [rad], limited to a full arc. */
export function arcAngle(moment: number): number {
  if (!(Math.abs(moment) >= SMALL)) {
    return 0;
  }
  return Math.sign(moment) * Math.min(1, Math.abs(moment) / FULL) * FULL_ANGLE;
}

interface Arc {
  source: ViewTorque;
  values: Float64Array;
  group: Group;
  tube: Mesh<BufferGeometry, MeshLambertMaterial>;
  halo: Mesh<BufferGeometry, MeshBasicMaterial>;
  head: Mesh<ConeGeometry, MeshLambertMaterial>;
  disc: Mesh<RingGeometry, MeshBasicMaterial>;
  red: RedSpan[];
}

/** Joint moments as arcs with arrow heads around the joint axes, on a faint disc. */
export class Torques {
  readonly group = new Group();
  private readonly arcs: Arc[];
  private readonly center = new Vector3();
  private colors: Palette | null = null;

  constructor(
    view: View,
    numbers: SeriesReader,
    red: RedSpan[],
    private readonly height: number,
  ) {
    const radius = RADIUS * height;
    const tube = TUBE * height;
    const shape = { tube: arcGeometry(radius, tube), halo: arcGeometry(radius, 1.6 * tube) };
    this.arcs = view.torques.map((source) => arc(source, numbers, red, shape, radius, tube));
    addAll(
      this.group,
      this.arcs.map(({ group }) => group),
    );
    onLayer(this.group, OVER);
  }

  recolor(colors: Palette): void {
    this.colors = colors;
    for (const { halo } of this.arcs) {
      halo.material.color.copy(colors.paper);
    }
  }

  pose(frame: number, time: number, figure: Figure): void {
    for (const one of this.arcs) {
      const limb = figure.limbs[one.source.body]?.group;
      const angle = arcAngle(sample(one.values, frame));
      one.group.visible = limb?.visible === true && angle !== 0;
      if (!limb || !one.group.visible) {
        continue;
      }
      this.center
        .set(...one.source.center)
        .applyQuaternion(limb.quaternion)
        .add(limb.position);
      one.group.position.copy(this.center);
      one.group.quaternion.copy(limb.quaternion).multiply(turnOf(one.source, angle < 0));
      this.draw(one, Math.abs(angle), time);
    }
  }

  private draw(one: Arc, angle: number, time: number): void {
    const segments = Math.max(1, Math.round((angle / FULL_ANGLE) * SEGMENTS));
    const indices = segments * SIDES * 6;
    one.tube.geometry.setDrawRange(0, indices);
    one.halo.geometry.setDrawRange(0, indices);
    const end = (segments / SEGMENTS) * FULL_ANGLE;
    const radius = RADIUS * this.height;
    one.head.position.set(Math.cos(end) * radius, Math.sin(end) * radius, 0);
    one.head.rotation.set(0, 0, end);
    if (this.colors) {
      const bad = one.red.some((span) => span.from_s <= time && time <= span.to_s);
      const color = bad ? this.colors.infeasible : sideColor(this.colors, one.source.side);
      for (const { material } of [one.tube, one.head]) {
        material.color.copy(color);
        material.emissive.copy(color).multiplyScalar(0.4);
      }
      one.disc.material.color.copy(color);
    }
  }
}

const AXIS = new Vector3(0, 0, 1);
const turn = new Quaternion();

/** Rotates z to the joint's axis or its opposite, so that arcs always run counter-clockwise in their own plane. */
function turnOf(source: ViewTorque, reversed: boolean): Quaternion {
  const axis = new Vector3(...source.axis).normalize();
  return turn.setFromUnitVectors(AXIS, reversed ? axis.negate() : axis);
}

function arc(
  source: ViewTorque,
  numbers: SeriesReader,
  red: RedSpan[],
  shape: { tube: BufferGeometry; halo: BufferGeometry },
  radius: number,
  thickness: number,
): Arc {
  const group = new Group();
  const tube = new Mesh(shape.tube.clone(), new MeshLambertMaterial());
  const halo = new Mesh(shape.halo.clone(), new MeshBasicMaterial({ side: BackSide }));
  const head = new Mesh(
    new ConeGeometry(2.6 * thickness, 6 * thickness, 20).translate(0, 2 * thickness, 0),
    new MeshLambertMaterial(),
  );
  const disc = new Mesh(
    new RingGeometry(0, radius, 40),
    new MeshBasicMaterial({ transparent: true, opacity: 0.14, side: DoubleSide, depthWrite: false }),
  );
  group.add(disc, halo, tube, head);
  const own = red.filter(
    (span) => span.panel !== null && span.panel === source.panel && (span.side === null || span.side === source.side),
  );
  return { source, values: numbers.read(source.values), group, tube, halo, head, disc, red: own };
}

/** A tube along an arc around z, starting at x; its triangles are ordered along the arc, so that a draw range shortens it. */
function arcGeometry(radius: number, tube: number): BufferGeometry {
  const position: number[] = [];
  const normal: number[] = [];
  const index: number[] = [];
  for (let i = 0; i <= SEGMENTS; i += 1) {
    const along = (i / SEGMENTS) * FULL_ANGLE;
    for (let j = 0; j < SIDES; j += 1) {
      const around = (j / SIDES) * 2 * Math.PI;
      const out = Math.cos(around);
      normal.push(out * Math.cos(along), out * Math.sin(along), Math.sin(around));
      const reach = radius + tube * out;
      position.push(reach * Math.cos(along), reach * Math.sin(along), tube * Math.sin(around));
      if (i < SEGMENTS) {
        const a = i * SIDES + j;
        const b = i * SIDES + ((j + 1) % SIDES);
        index.push(a, a + SIDES, b, b, a + SIDES, b + SIDES);
      }
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(position), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normal), 3));
  geometry.setIndex(index);
  return geometry;
}
