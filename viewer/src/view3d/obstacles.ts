import { Group, type Mesh, MeshStandardMaterial, Raycaster, Vector3 } from "three";
import type { View } from "../contract";
import { addAll } from "./layers";
import type { Palette } from "./palette";
import { shapeMesh } from "./shape";

const LOOK = { roughness: 0.8, metalness: 0 };

/** Fixed objects of a scene; those between camera and figure are translucent. */
export class Obstacles {
  readonly group = new Group();
  private readonly solid = new MeshStandardMaterial(LOOK);
  private readonly clearing = new MeshStandardMaterial({
    ...LOOK,
    transparent: true,
    opacity: 0.16,
    depthWrite: false,
  });
  private readonly meshes: Mesh[];
  private readonly ray = new Raycaster();
  private readonly direction = new Vector3();

  constructor(view: View) {
    this.meshes = view.fixed.map((shape) => shapeMesh(shape, this.solid));
    addAll(this.group, this.meshes);
  }

  recolor(colors: Palette): void {
    this.solid.color.copy(colors.obstacle);
    this.clearing.color.copy(colors.obstacle);
  }

  /** Makes objects in front of a position translucent. */
  clear(eye: Vector3, target: Vector3): void {
    this.direction.copy(target).sub(eye);
    this.ray.far = this.direction.length();
    this.ray.set(eye, this.direction.normalize());
    for (const mesh of this.meshes) {
      mesh.material = this.ray.intersectObject(mesh).length > 0 ? this.clearing : this.solid;
    }
  }
}
