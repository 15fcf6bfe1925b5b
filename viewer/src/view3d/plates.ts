import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineLoop,
  Mesh,
  MeshStandardMaterial,
  Vector3,
} from "three";
import type { View, ViewPlate } from "../contract";
import type { Palette } from "./palette";

/** Height above the floor [m]. */
const LIFT_M = 0.002;

/** Force plates as rectangles on the floor. */
export class Plates {
  readonly group = new Group();
  private readonly pane = new MeshStandardMaterial({
    transparent: true,
    opacity: 0.4,
    roughness: 0.9,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: -1,
  });
  private readonly edge = new LineBasicMaterial();

  constructor(view: View) {
    for (const plate of view.plates) {
      const corners = plate.corners.map((corner) => new Vector3(...corner).add(new Vector3(0, LIFT_M, 0)));
      const mesh = new Mesh(paneGeometry(plate), this.pane);
      mesh.position.y = LIFT_M;
      mesh.receiveShadow = true;
      this.group.add(mesh, new LineLoop(new BufferGeometry().setFromPoints(corners), this.edge));
    }
  }

  recolor(colors: Palette): void {
    this.pane.color.copy(colors.plate);
    this.edge.color.copy(colors.plate);
  }
}

function paneGeometry(plate: ViewPlate): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(plate.corners.flat()), 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  geometry.computeVertexNormals();
  return geometry;
}
