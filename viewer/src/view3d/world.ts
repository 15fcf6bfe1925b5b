import { Vector3 } from "three";
import type { Page, Session, View } from "../contract";
import { arrowScale } from "./arrow";
import { Contacts } from "./contacts";
import { type Extent, extentOf, Framing, union } from "./extent";
import { Figure } from "./figure";
import { Floor } from "./floor";
import { Forces, peakOf } from "./forces";
import { Ghost } from "./ghost";
import { hasMuscles, Muscles } from "./muscles";
import { Obstacles } from "./obstacles";
import type { ViewOptions } from "./options";
import type { Palette } from "./palette";
import { Path } from "./path";
import { type Gait, gaitOf } from "./phase";
import { Plates } from "./plates";
import type { SeriesReader } from "./reader";
import { Ruler } from "./ruler";
import { Torques } from "./torques";
import { Trail } from "./trail";

/** All visible objects at a time. */
export class World {
  readonly path: Path;
  private readonly extent: Extent;
  private readonly framing: Framing;
  readonly ghosts: Ghost[];
  private readonly gait: Gait;
  private readonly figure: Figure;
  private readonly floor: Floor;
  private readonly forces: Forces;
  private readonly torques: Torques;
  private readonly trail: Trail;
  private readonly contacts: Contacts;
  private readonly muscles: Muscles;
  private readonly obstacles: Obstacles;
  private readonly still: (Plates | Obstacles | Ruler)[];
  private readonly hips = new Vector3();

  constructor(
    page: Page,
    session: Session,
    private readonly view: View,
    numbers: SeriesReader,
  ) {
    this.gait = gaitOf(session);
    const { timeline } = this.gait;
    this.path = new Path(view, numbers, timeline);
    this.extent = extentOf(view, numbers, this.path, timeline);
    this.framing = new Framing(view, numbers, this.path, timeline);
    const height = this.height;
    const views = page.sessions.flatMap((one) => one.view ?? []);
    const weight_m = arrowScale(height, Math.max(...views.map((one) => peakOf(one, numbers))));
    this.figure = new Figure(view, numbers);
    this.floor = new Floor(view.floor_m);
    this.forces = new Forces(view, numbers, height, weight_m);
    this.torques = new Torques(view, numbers, session.feasibility?.red ?? [], height);
    this.trail = new Trail(view, numbers);
    this.contacts = new Contacts(view, height, view.floor_m);
    this.muscles = new Muscles(view, numbers, height);
    const [from, to] = [0, timeline.frames - 1].map((frame) => this.path.smooth(frame, new Vector3()));
    const ruler = new Ruler(from ?? this.hips, to ?? this.hips, this.path.heading, view.floor_m, 0.45);
    this.obstacles = new Obstacles(view);
    this.still = [new Plates(view), this.obstacles, ruler];
    this.ghosts = page.sessions.flatMap((other, index) =>
      index > 0 && other.view
        ? [new Ghost(other, other.view, numbers, this.path.heading, height, weight_m, index)]
        : [],
    );
  }

  /** All coloured objects in the scene. */
  get parts(): (Figure | Floor | Forces | Torques | Trail | Contacts | Muscles | Ghost | Plates | Obstacles | Ruler)[] {
    const { figure, floor, forces, torques, trail, contacts, muscles } = this;
    return [figure, floor, forces, torques, trail, contacts, muscles, ...this.ghosts, ...this.still];
  }

  /** Extent of the figure at a time [s], with its ghosts. */
  room(time: number): Extent {
    const own = this.framing.at(this.gait.timeline.frameAt(time));
    return this.ghosts.reduce((room, ghost) => union(room, ghost.extentOn(this.view.floor_m)), own);
  }

  /** Height of the figure [m]. */
  get height(): number {
    return this.extent.top - this.view.floor_m;
  }

  recolor(colors: Palette): void {
    for (const part of this.parts) {
      part.recolor(colors);
    }
  }

  show(options: ViewOptions): void {
    this.forces.group.visible = options.forces;
    this.torques.group.visible = options.torques;
    this.trail.group.visible = options.trail;
    this.contacts.group.visible = options.contacts;
    this.muscles.group.visible = options.muscles;
    this.figure.corrected = options.corrected;
    this.figure.translucent = options.muscles && hasMuscles(this.view);
    for (const ghost of this.ghosts) {
      ghost.show(options);
    }
  }

  /** Makes obstacles in front of the figure translucent. */
  clear(eye: Vector3, target: Vector3): void {
    this.obstacles.clear(eye, target);
  }

  /** Updates everything to a time [s]; writes the figure's position on the floor to `place`. */
  pose(time: number, place: Vector3): void {
    const frame = this.gait.timeline.frameAt(time);
    this.path.smooth(frame, place);
    this.floor.follow(place);
    this.figure.pose(frame);
    this.forces.pose(frame);
    this.torques.pose(frame, time, this.figure);
    this.trail.pose(frame);
    this.contacts.pose(frame, this.figure, this.forces);
    this.muscles.pose(frame, this.figure);
    if (this.ghosts.length > 0 && this.path.hips(frame, this.hips)) {
      for (const ghost of this.ghosts) {
        ghost.pose(time, this.gait, this.hips, this.view.floor_m);
      }
    }
  }
}
