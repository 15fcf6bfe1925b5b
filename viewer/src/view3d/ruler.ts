import { CanvasTexture, Group, Sprite, SpriteMaterial, type Vector3 } from "three";
import type { Palette } from "./palette";

/** Largest number of marks; longer paths get fewer marks per metre. */
const MARKS = 24;
/** Text height of a mark [m]. */
const TEXT_M = 0.085;
const PIXELS = 64;

/** Whole metres to mark between two positions: every 1, 2, 5, 10, ... m, with at most `most` marks. */
export function marks(from: number, to: number, most: number): number[] {
  const steps = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  const step = steps.find((one) => (to - from) / one < most) ?? 5000;
  const first = Math.ceil(from / step);
  const count = Math.min(most, Math.max(0, Math.floor(to / step) - first + 1));
  return Array.from({ length: count }, (_, index) => (first + index) * step);
}

/** Metre numbers along the path. */
export class Ruler {
  readonly group = new Group();
  private readonly labels: { text: string; sprite: Sprite }[] = [];

  /** `from`, `to`: ends of the path on the floor; `aside`: distance of the numbers from the path [m]. */
  constructor(from: Vector3, to: Vector3, heading: Vector3, floor: number, aside: number) {
    const axis = Math.abs(heading.x) >= Math.abs(heading.z) ? "x" : "z";
    const other = axis === "x" ? "z" : "x";
    const across = axis === "x" ? heading.x : -heading.z;
    const [low, high] = [Math.min(from[axis], to[axis]) - 1.2, Math.max(from[axis], to[axis]) + 1.2];
    for (const metre of marks(low, high, MARKS)) {
      const sprite = new Sprite(new SpriteMaterial({ transparent: true, depthWrite: false }));
      sprite.position[axis] = metre;
      sprite.position[other] = (from[other] + to[other]) / 2 + Math.sign(across || 1) * aside;
      sprite.position.y = floor;
      sprite.center.set(0.5, 1.05);
      sprite.renderOrder = 1;
      this.labels.push({ text: `${metre} m`, sprite });
      this.group.add(sprite);
    }
  }

  recolor(colors: Palette): void {
    for (const { text, sprite } of this.labels) {
      const canvas = written(text, `#${colors.text.getHexString()}`);
      sprite.material.map?.dispose();
      sprite.material.map = new CanvasTexture(canvas);
      sprite.material.needsUpdate = true;
      sprite.scale.set((TEXT_M * canvas.width) / canvas.height, TEXT_M, 1);
    }
  }
}

function written(text: string, color: string): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = PIXELS * 3;
  canvas.height = PIXELS;
  const pen = canvas.getContext("2d");
  if (pen) {
    pen.font = `${PIXELS * 0.72}px Arial, Helvetica, "Liberation Sans", sans-serif`;
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.fillStyle = color;
    pen.fillText(text, canvas.width / 2, canvas.height / 2);
  }
  return canvas;
}
