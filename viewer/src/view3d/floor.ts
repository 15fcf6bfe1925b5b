import { Color, Group, Mesh, PlaneGeometry, ShaderMaterial, ShadowMaterial, type Vector3 } from "three";
import type { Palette } from "./palette";

/** Half the side length of the floor, and the distance at which it begins to fade [m]. */
const REACH_M = 9;

const VERTEX = `
varying vec2 place;
varying vec2 fromMiddle;
uniform vec2 middle;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  place = world.xz;
  fromMiddle = world.xz - middle;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

/** Lines of 1.5 pixels every 1 m, fainter lines every 0.25 m, fading with distance. */
const FRAGMENT = `
varying vec2 place;
varying vec2 fromMiddle;
uniform vec3 color;
uniform float reach;
float lines(vec2 at, float width) {
  vec2 change = fwidth(at);
  vec2 near = abs(fract(at - 0.5) - 0.5) / max(change, vec2(1e-6));
  vec2 line = (1.0 - clamp(near - width, 0.0, 1.0)) * clamp(1.5 - 2.0 * change, 0.0, 1.0);
  return max(line.x, line.y);
}
void main() {
  float strength = max(0.7 * lines(place, 0.4), 0.32 * lines(place * 4.0, 0.0));
  float fade = 1.0 - smoothstep(0.25, 1.0, length(fromMiddle) / reach);
  gl_FragColor = vec4(color, strength * fade);
  #include <colorspace_fragment>
}`;

/** The floor: a metre grid that receives shadows. It follows the figure, while its lines keep their place. */
export class Floor {
  readonly group = new Group();
  private readonly grid: ShaderMaterial;
  private readonly shadow = new ShadowMaterial({ transparent: true, depthWrite: false });

  constructor(private readonly height: number) {
    this.grid = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { color: { value: new Color() }, middle: { value: [0, 0] }, reach: { value: REACH_M } },
      transparent: true,
      depthWrite: false,
    });
    const plane = new PlaneGeometry(2 * REACH_M, 2 * REACH_M).rotateX(-Math.PI / 2);
    const shadows = new Mesh(plane, this.shadow);
    shadows.receiveShadow = true;
    shadows.renderOrder = -1;
    const grid = new Mesh(plane, this.grid);
    grid.renderOrder = -2;
    this.group.add(grid, shadows);
  }

  recolor(colors: Palette): void {
    (this.grid.uniforms["color"] as { value: Color }).value.copy(colors.grid);
    this.shadow.opacity = colors.dark ? 0.5 : 0.2;
  }

  follow(place: Vector3): void {
    this.group.position.set(place.x, this.height, place.z);
    (this.grid.uniforms["middle"] as { value: number[] }).value = [place.x, place.z];
  }
}
