import { Quaternion, Vector3 } from "three";
import type { View, ViewBody } from "../contract";
import { Motion } from "./motion";
import type { Path } from "./path";
import type { SeriesReader } from "./reader";
import { shapePoints } from "./shape";
import type { Timeline } from "./timeline";

const LOOKS = 30;

/** Space that the figure takes around its smoothed path [m]. */
export interface Extent {
  bottom: number;
  top: number;
  /** Largest reach forwards and backwards. */
  along: number;
  /** Largest reach sideways. */
  across: number;
}

const PELVIS = /pelvis|hips/i;

/** The bodies that the picture frames: those of people, or all if there is no person. A scene's thing far away enters the picture as it comes near. */
export function framed(view: View): ViewBody[] {
  const owner = (name: string) => name.slice(0, name.lastIndexOf("/") + 1);
  const people = new Set(view.bodies.filter(({ name }) => PELVIS.test(name)).map(({ name }) => owner(name)));
  return people.size > 0 ? view.bodies.filter(({ name }) => people.has(owner(name))) : view.bodies;
}

/** Measures the people, or all bodies, at about thirty instants. */
export function extentOf(view: View, numbers: SeriesReader, path: Path, timeline: Timeline): Extent {
  const extent: Extent = { bottom: view.floor_m, top: view.floor_m + 0.3, along: 0.3, across: 0.2 };
  const bodies = framed(view).map((body) => ({
    motion: new Motion(body, numbers),
    shapes: body.shapes.map(shapePoints),
  }));
  const place = new Vector3();
  const turn = new Quaternion();
  const center = new Vector3();
  const point = new Vector3();
  for (let frame = 0; frame < timeline.frames; frame += Math.max(1, Math.floor(timeline.frames / LOOKS))) {
    path.smooth(frame, center);
    for (const { motion, shapes } of bodies) {
      if (!motion.at(frame, place, turn)) continue;
      for (const { points, radius } of shapes) {
        for (const corner of points)
          grow(extent, point.copy(corner).applyQuaternion(turn).add(place).sub(center), radius, path.heading);
      }
    }
  }
  return extent;
}

/** The smallest extent that contains both. */
export function union(a: Extent, b: Extent): Extent {
  return {
    bottom: Math.min(a.bottom, b.bottom),
    top: Math.max(a.top, b.top),
    along: Math.max(a.along, b.along),
    across: Math.max(a.across, b.across),
  };
}

function grow(extent: Extent, point: Vector3, radius: number, heading: Vector3): void {
  extent.top = Math.max(extent.top, point.y + radius);
  extent.bottom = Math.min(extent.bottom, point.y - radius);
  extent.along = Math.max(extent.along, Math.abs(point.x * heading.x + point.z * heading.z) + radius);
  extent.across = Math.max(extent.across, Math.abs(point.z * heading.x - point.x * heading.z) + radius);
}
