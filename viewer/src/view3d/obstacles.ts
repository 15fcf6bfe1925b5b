import { Group, MeshStandardMaterial } from "three";
import type { View } from "../contract";
import { addAll } from "./layers";
import type { Palette } from "./palette";
import { shapeMesh } from "./shape";

/** What stands still in a scene. */
export class Obstacles {
  readonly group = new Group();
  private readonly material = new MeshStandardMaterial({ roughness: 0.8, metalness: 0 });

  constructor(view: View) {
    addAll(
      this.group,
      view.fixed.map((shape) => shapeMesh(shape, this.material)),
    );
  }

  recolor(colors: Palette): void {
    this.material.color.copy(colors.obstacle);
  }
}
