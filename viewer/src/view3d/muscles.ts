import {
  Color,
  CylinderGeometry,
  Group,
  InstancedMesh,
  Matrix4,
  MeshLambertMaterial,
  Quaternion,
  Vector3,
} from "three";
import type { View, ViewMuscle, ViewPathPoint } from "../contract";
import { element } from "../element";
import type { Figure } from "./figure";
import type { Palette } from "./palette";
import type { SeriesReader } from "./reader";
import { sample } from "./timeline";

/** Radius of a muscle at rest and of a fully active one, in heights of the figure. */
const THIN = 0.002;
const THICK = 0.0065;
const UP = new Vector3(0, 1, 0);

/** Whether a view has muscles. */
export function hasMuscles(view: View): boolean {
  return (view.muscles ?? []).length > 0;
}

/** Radius of a muscle with an activation from 0 to 1, in heights of the figure; a missing activation is rest. */
export function thickness(activation: number): number {
  return THIN + (THICK - THIN) * part(activation);
}

/** Writes the colour of an activation from 0 to 1; a missing activation is rest. */
export function activationColor(colors: Pick<Palette, "rest" | "active">, activation: number, into: Color): Color {
  return into.copy(colors.rest).lerp(colors.active, part(activation));
}

function part(activation: number): number {
  return Number.isFinite(activation) ? Math.min(1, Math.max(0, activation)) : 0;
}

interface Muscle {
  readonly source: ViewMuscle;
  readonly activation: Float64Array;
}

/** Muscles as straight lines through the points of their paths, coloured by activation and thicker while active. */
export class Muscles {
  readonly group = new Group();
  private readonly muscles: Muscle[];
  private readonly lines: InstancedMesh;
  private colors: Palette | null = null;
  private readonly ends = [new Vector3(), new Vector3()] as const;
  private readonly turn = new Quaternion();
  private readonly size = new Vector3();
  private readonly along = new Vector3();
  private readonly matrix = new Matrix4();
  private readonly color = new Color();

  constructor(
    view: View,
    numbers: SeriesReader,
    private readonly height: number,
  ) {
    this.muscles = (view.muscles ?? []).map((source) => ({ source, activation: numbers.read(source.activation) }));
    const count = this.muscles.reduce((sum, { source }) => sum + Math.max(0, source.points.length - 1), 0);
    const line = new CylinderGeometry(1, 1, 1, 8).translate(0, 0.5, 0);
    this.lines = new InstancedMesh(line, new MeshLambertMaterial(), count);
    this.lines.frustumCulled = false;
    this.group.add(this.lines);
  }

  recolor(colors: Palette): void {
    this.colors = colors;
  }

  pose(frame: number, figure: Figure): void {
    if (!this.group.visible || !this.colors || this.lines.count === 0) {
      return;
    }
    let index = 0;
    for (const { source, activation } of this.muscles) {
      const now = sample(activation, frame);
      const radius = this.height * thickness(now);
      activationColor(this.colors, now, this.color);
      for (const [i, to] of source.points.entries()) {
        const from = source.points[i - 1];
        if (from) {
          this.lines.setMatrixAt(index, this.between(from, to, figure, radius));
          this.lines.setColorAt(index, this.color);
          index += 1;
        }
      }
    }
    this.lines.instanceMatrix.needsUpdate = true;
    if (this.lines.instanceColor) {
      this.lines.instanceColor.needsUpdate = true;
    }
  }

  /** Place of a line between two points; of no size if a body is in a gap. */
  private between(from: ViewPathPoint, to: ViewPathPoint, figure: Figure, radius: number): Matrix4 {
    const [start, end] = this.ends;
    const visible = placeOf(from, figure, start) && placeOf(to, figure, end);
    const length = this.along.copy(end).sub(start).length();
    if (!visible || !(length > 0)) {
      return this.matrix.makeScale(0, 0, 0);
    }
    this.turn.setFromUnitVectors(UP, this.along.divideScalar(length));
    return this.matrix.compose(start, this.turn, this.size.set(radius, length, radius));
  }
}

/** Writes a point of a path in the world; returns false if its body is not drawn now. */
function placeOf({ body, place }: ViewPathPoint, figure: Figure, into: Vector3): boolean {
  const limb = figure.limbs[body]?.group;
  if (!limb) {
    return false;
  }
  into
    .set(...place)
    .applyQuaternion(limb.quaternion)
    .add(limb.position);
  return limb.visible;
}

/** Legend of the colours of activation; call `recolor` when the theme changes. */
export function activationKey(): { readonly key: HTMLElement; recolor(colors: Palette): void } {
  const bar = element("span", { class: "activation-bar" });
  const key = element("div", { class: "activation-key", hidden: "" }, "activation 0", bar, "1");
  const recolor = ({ rest, active }: Palette): void => {
    bar.style.background = `linear-gradient(90deg, ${rest.getStyle()}, ${active.getStyle()})`;
  };
  return { key, recolor };
}
