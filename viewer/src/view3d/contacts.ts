import { Group, Mesh, MeshBasicMaterial, SphereGeometry, Vector3 } from "three";
import type { View, ViewContact } from "../contract";
import type { Figure } from "./figure";
import type { Forces } from "./forces";
import { addAll, OVER, onLayer } from "./layers";
import { type Palette, sideColor } from "./palette";

/** Radius of a point, in heights of the figure. */
const RADIUS = 0.007;
/** Largest height at which a point of the sole touches the floor [m]. */
const NEAR_M = 0.02;

interface Point {
  source: ViewContact;
  mesh: Mesh<SphereGeometry, MeshBasicMaterial>;
}

/** Sole points, shown while their foot is loaded and they touch the floor. */
export class Contacts {
  readonly group = new Group();
  private readonly points: Point[];
  private readonly place = new Vector3();

  constructor(
    view: View,
    height: number,
    private readonly floor: number,
  ) {
    const sphere = new SphereGeometry(height * RADIUS, 16, 12);
    this.points = view.contacts.map((source) => ({ source, mesh: new Mesh(sphere, new MeshBasicMaterial()) }));
    addAll(
      this.group,
      this.points.map(({ mesh }) => mesh),
    );
    onLayer(this.group, OVER);
  }

  recolor(colors: Palette): void {
    for (const { source, mesh } of this.points) {
      mesh.material.color.copy(sideColor(colors, source.side)).lerp(colors.paper, 0.25);
    }
  }

  pose(frame: number, figure: Figure, forces: Forces): void {
    for (const { source, mesh } of this.points) {
      const limb = figure.limbs[source.body]?.group;
      mesh.visible = limb?.visible === true && forces.loaded(source.side, frame) !== false;
      if (!limb || !mesh.visible) {
        continue;
      }
      this.place
        .set(...source.place)
        .applyQuaternion(limb.quaternion)
        .add(limb.position);
      mesh.position.copy(this.place);
      mesh.visible = this.place.y < this.floor + NEAR_M;
    }
  }
}
