import { Quaternion, Vector3 } from "three";
import type { View, ViewBody } from "../contract";
import { Motion } from "./motion";
import type { Path } from "./path";
import type { SeriesReader } from "./reader";
import { shapePoints } from "./shape";
import type { Timeline } from "./timeline";

const LOOKS = 30;
/** Time between two measurements of what the picture frames, and their largest number. */
const BETWEEN_S = 0.1;
const MOST_LOOKS = 400;
/** The picture has room for everything that happens within this time before and after [s]: more than a step, so that it does not pulsate. */
const AROUND_S = 0.8;
/** Half of the time over which a change of the picture is spread [s]. */
const GRADUAL_S = 0.4;

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
  const all = extentsOf(view, numbers, path, timeline, Math.max(1, Math.floor(timeline.frames / LOOKS)));
  return all.reduce(union);
}

/** Measures the people, or all bodies, at every so many frames. */
function extentsOf(view: View, numbers: SeriesReader, path: Path, timeline: Timeline, every: number): Extent[] {
  const bodies = framed(view).map((body) => ({
    motion: new Motion(body, numbers),
    shapes: body.shapes.map(shapePoints),
  }));
  const place = new Vector3();
  const turn = new Quaternion();
  const center = new Vector3();
  const point = new Vector3();
  const extents: Extent[] = [];
  for (let frame = 0; frame < Math.max(1, timeline.frames); frame += every) {
    const extent: Extent = { bottom: view.floor_m, top: view.floor_m + 0.3, along: 0.3, across: 0.2 };
    path.smooth(frame, center);
    for (const { motion, shapes } of bodies) {
      if (!motion.at(frame, place, turn)) continue;
      for (const { points, radius } of shapes) {
        for (const corner of points)
          grow(extent, point.copy(corner).applyQuaternion(turn).add(place).sub(center), radius, path.heading);
      }
    }
    extents.push(extent);
  }
  return extents;
}

/** The extent over time: wide while somebody lies on the floor, narrow while the same person walks. */
export class Framing {
  private readonly extents: Extent[];
  private readonly every: number;

  constructor(view: View, numbers: SeriesReader, path: Path, timeline: Timeline) {
    const fine = timeline.step > 0 ? Math.round(BETWEEN_S / timeline.step) : 1;
    this.every = Math.max(1, fine, Math.ceil(timeline.frames / MOST_LOOKS));
    const looks = (seconds: number) => Math.max(1, Math.ceil(seconds / (this.every * timeline.step || 1)));
    const measured = extentsOf(view, numbers, path, timeline, this.every);
    const widest = measured.map((_, at) => around(measured, at, looks(AROUND_S)).reduce(union));
    this.extents = widest.map((_, at) => mean(around(widest, at, looks(GRADUAL_S))));
  }

  /** The extent at a frame. */
  at(frame: number): Extent {
    const look = frame / this.every;
    const before = Math.min(Math.floor(look), this.extents.length - 1);
    const from = this.extents[before] as Extent;
    const to = this.extents[before + 1] ?? from;
    const part = Math.min(1, look - before);
    const between = (a: number, b: number) => a + (b - a) * part;
    return {
      bottom: between(from.bottom, to.bottom),
      top: between(from.top, to.top),
      along: between(from.along, to.along),
      across: between(from.across, to.across),
    };
  }
}

/** The entries at most `reach` away from one. */
function around(extents: readonly Extent[], at: number, reach: number): Extent[] {
  return extents.slice(Math.max(0, at - reach), at + reach + 1);
}

function mean(extents: readonly Extent[]): Extent {
  const of = (key: keyof Extent) => extents.reduce((sum, extent) => sum + extent[key], 0) / extents.length;
  return { bottom: of("bottom"), top: of("top"), along: of("along"), across: of("across") };
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
