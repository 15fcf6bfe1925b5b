import { Color, Group, type Mesh, NotEqualStencilFunc, ShaderMaterial, Vector3 } from "three";
import type { Session, View } from "../contract";
import { type Extent, extentOf } from "./extent";
import { FIGURE_STENCIL, Figure } from "./figure";
import { Forces } from "./forces";
import type { ViewOptions } from "./options";
import type { Palette } from "./palette";
import { Path } from "./path";
import { type Gait, gaitOf, matchingTime } from "./phase";
import type { SeriesReader } from "./reader";

const VERTEX = `
varying vec3 outward;
varying vec3 towards;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  outward = normalMatrix * normal;
  towards = -seen.xyz;
  gl_Position = projectionMatrix * seen;
}`;

/** Material that is clear in the middle and coloured at the edges. */
const FRAGMENT = `
varying vec3 outward;
varying vec3 towards;
uniform vec3 color;
void main() {
  float facing = abs(dot(normalize(outward), normalize(towards)));
  gl_FragColor = vec4(color, mix(0.85, 0.1, pow(facing, 0.7)));
  #include <colorspace_fragment>
}`;

const UP = new Vector3(0, 1, 0);

/** Translucent figure of another session, at the same phase of gait and with its hips at the hips of the main figure. */
export class Ghost {
  readonly group = new Group();
  private readonly extent: Extent;
  private readonly figure: Figure;
  private readonly forces: Forces;
  private readonly gait: Gait;
  private readonly path: Path;
  private readonly turn: number;
  private readonly material = glass();
  private readonly own = new Vector3();
  private readonly wanted = new Vector3();

  constructor(
    session: Session,
    private readonly view: View,
    numbers: SeriesReader,
    heading: Vector3,
    height: number,
    weight_m: number,
    private readonly index: number,
  ) {
    this.figure = new Figure(view, numbers);
    this.gait = gaitOf(session);
    this.path = new Path(view, numbers, this.gait.timeline);
    this.extent = extentOf(view, numbers, this.path, this.gait.timeline);
    this.turn = angleOf(heading) - angleOf(this.path.heading);
    this.figure.group.traverse((part) => {
      if ((part as Mesh).isMesh) {
        (part as Mesh).material = this.material;
        part.castShadow = false;
        part.renderOrder = 2;
      }
    });
    this.forces = new Forces(view, numbers, height, weight_m, true);
    this.group.add(this.figure.group, this.forces.group);
  }

  /** Its extent above a floor of this height [m]. */
  extentOn(floor: number): Extent {
    const lift = floor - this.view.floor_m;
    return { ...this.extent, bottom: this.extent.bottom + lift, top: this.extent.top + lift };
  }

  recolor(colors: Palette): void {
    const own = colors.sessions[this.index % colors.sessions.length] ?? colors.text;
    (this.material.uniforms["color"] as { value: Color }).value.copy(own);
    this.forces.recolor(colors, own);
  }

  show(options: ViewOptions): void {
    this.group.visible = options.ghost;
    this.forces.group.visible = options.forces;
  }

  /** `hips`: position of the main figure's hips; `floor`: height of its floor [m]. */
  pose(time: number, main: Gait, hips: Vector3, floor: number): void {
    const frame = this.gait.timeline.frameAt(matchingTime(time, main, this.gait));
    this.figure.pose(frame);
    this.forces.pose(frame);
    this.figure.group.visible = this.path.hips(frame, this.own);
    this.group.quaternion.setFromAxisAngle(UP, this.turn);
    this.wanted.copy(this.own).applyQuaternion(this.group.quaternion);
    this.group.position.set(hips.x - this.wanted.x, floor - this.view.floor_m, hips.z - this.wanted.z);
  }
}

/** Angle about the vertical from x to a direction [rad]. */
function angleOf(direction: Vector3): number {
  return Math.atan2(-direction.z, direction.x);
}

/** Makes an object translucent, and hides it in front of the main figure. */
function glass(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { color: { value: new Color() } },
    transparent: true,
    stencilWrite: true,
    stencilRef: FIGURE_STENCIL,
    stencilFunc: NotEqualStencilFunc,
  });
}
