import { Group, MeshStandardMaterial, ReplaceStencilOp } from "three";
import type { PageSide, View } from "../contract";
import { addAll } from "./layers";
import { Motion } from "./motion";
import { limbColor, type Palette } from "./palette";
import type { SeriesReader } from "./reader";
import { shapeMesh } from "./shape";

/** Stencil value of pixels that show the main figure. */
export const FIGURE_STENCIL = 1;

interface Limb {
  group: Group;
  motion: Motion;
}

/** Opacity of the bodies while muscles are shown inside them. */
const GLASS = 0.2;

/** The moving bodies. */
export class Figure {
  readonly group = new Group();
  /** Bodies in their current pose, in the order of the page. */
  readonly limbs: Limb[];
  private readonly materials: { material: MeshStandardMaterial; side: PageSide | null }[] = [];
  private colors: Palette | null = null;
  private clear = false;
  /** 1 for the motion of the results, 0 for the recorded one. */
  corrected = 1;

  constructor(view: View, numbers: SeriesReader) {
    this.limbs = view.bodies.map((body) => {
      const material = new MeshStandardMaterial({
        roughness: 0.62,
        metalness: 0,
        stencilWrite: true,
        stencilRef: FIGURE_STENCIL,
        stencilZPass: ReplaceStencilOp,
      });
      this.materials.push({ material, side: body.side });
      const group = new Group();
      addAll(
        group,
        body.shapes.map((shape) => shapeMesh(shape, material)),
      );
      return { group, motion: new Motion(body, numbers) };
    });
    for (const limb of this.limbs) {
      this.group.add(limb.group);
    }
  }

  recolor(colors: Palette): void {
    this.colors = colors;
    for (const { material, side } of this.materials) {
      material.color.copy(this.clear ? colors.neutral : limbColor(colors, side));
    }
  }

  /** Makes the bodies translucent and grey, so that muscles are visible inside them, or solid in the colours of the sides. */
  set translucent(clear: boolean) {
    this.clear = clear;
    for (const { material } of this.materials) {
      Object.assign(material, { transparent: clear, opacity: clear ? GLASS : 1, depthWrite: !clear });
      material.needsUpdate = true;
    }
    if (this.colors) {
      this.recolor(this.colors);
    }
  }

  /** Sets the pose of a frame; a body in a gap is not drawn. */
  pose(frame: number): void {
    for (const { group, motion } of this.limbs) {
      group.visible = motion.at(frame, group.position, group.quaternion, this.corrected);
    }
  }
}
