import { Vector3 } from "three";
import type { Clock } from "../clock";
import type { Page, View } from "../contract";
import { onThemeChange, theme } from "../style";
import { type CameraKind, CameraRig } from "./camera";
import { say } from "./empty";
import { listen, touchAction } from "./gestures";
import { addAll, release } from "./layers";
import { activationKey, hasMuscles } from "./muscles";
import { FIRST_OPTIONS, type ViewOptions } from "./options";
import { palette } from "./palette";
import type { SeriesReader } from "./reader";
import { Stage } from "./stage";
import { mixtureSlider, toggleBar, togglesOf } from "./toggles";
import { World } from "./world";
import "../css/view3d.css";

export type { CameraKind } from "./camera";
export type { ViewOptions } from "./options";

/** The figure in 3-D. */
export interface View3D {
  /** Whether there is a picture; otherwise a sentence replaces it. */
  readonly drawn: boolean;
  /** Whether another session can be shown as a ghost. */
  readonly ghosts: boolean;
  /** Parts shown now; read only. */
  readonly options: Readonly<ViewOptions>;
  setCamera(kind: CameraKind): void;
  /** Shows or hides parts. */
  setOptions(options: Partial<ViewOptions>): void;
  /** The current picture without muscles, as a PNG data URL; empty if there is none. */
  still(): string;
  dispose(): void;
}

const NO_WEBGL = "This browser has no WebGL, so the figure cannot be shown in 3-D. Curves and tables work without it.";
const NO_VIEW = "No figure can be shown: the report contains no body poses.";

/** Adds a canvas to the host and keeps it at the clock's time. */
export function createView(host: HTMLElement, page: Page, numbers: SeriesReader, clock: Clock): View3D {
  const view = page.sessions[0]?.view;
  if (!view || view.bodies.length === 0) {
    return nothing(host, NO_VIEW);
  }
  try {
    return new Picture(host, page, view, numbers, clock);
  } catch (error) {
    console.error(error);
    return nothing(host, NO_WEBGL);
  }
}

class Picture implements View3D {
  readonly drawn = true;
  readonly ghosts: boolean;
  readonly options: ViewOptions = { ...FIRST_OPTIONS };
  private readonly canvas = document.createElement("canvas");
  private readonly toggles: ReturnType<typeof toggleBar>;
  private readonly mixture: HTMLElement;
  private readonly activation = activationKey();
  private readonly muscles: boolean;
  private readonly world: World;
  private readonly stage: Stage;
  private readonly rig: CameraRig;
  private readonly place = new Vector3();
  private width = 0;
  private height = 0;
  private readonly endings: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    page: Page,
    view: View,
    numbers: SeriesReader,
    private readonly clock: Clock,
  ) {
    const session = page.sessions[0] as Page["sessions"][number];
    this.world = new World(page, session, view, numbers);
    this.ghosts = this.world.ghosts.length > 0;
    this.stage = new Stage(this.canvas, this.world.height, () => this.now());
    addAll(
      this.stage.scene,
      this.world.parts.map((part) => part.group),
    );
    this.rig = new CameraRig(this.canvas, this.world.room(clock.time), this.world.path.heading);
    this.attach(session.name);
    this.toggles = toggleBar(togglesOf(view, this.ghosts), this.options, (options) => this.setOptions(options));
    this.mixture = mixtureSlider(view, (options) => this.setOptions(options));
    this.muscles = hasMuscles(view);
    host.append(this.toggles.bar, this.mixture, this.activation.key);
    this.show(this.options);
    this.recolor();
    this.world.pose(clock.time, this.place);
    this.rig.follow(this.place, this.world.room(clock.time));
    this.measure();
    this.setCamera("side");
    this.endings = this.listeners();
  }

  setCamera(kind: CameraKind): void {
    this.rig.set(kind);
    touchAction(this.canvas, this.rig);
    this.stage.invalidate();
  }

  setOptions(options: Partial<ViewOptions>): void {
    Object.assign(this.options, options);
    this.show(this.options);
    this.toggles.refresh();
    this.stage.invalidate();
  }

  still(): string {
    const hides = this.muscles && this.options.muscles;
    this.show({ ...this.options, muscles: false });
    this.stage.draw();
    const picture = this.canvas.toDataURL("image/png");
    if (hides) {
      this.show(this.options);
      this.stage.draw();
    }
    return picture;
  }

  dispose(): void {
    for (const end of this.endings) {
      end();
    }
    release(this.stage.scene);
    this.rig.controls.dispose();
    this.stage.dispose();
    this.canvas.remove();
    this.toggles.bar.remove();
    this.mixture.remove();
    this.activation.key.remove();
  }

  private show(options: ViewOptions): void {
    this.world.show(options);
    this.activation.key.hidden = !(this.muscles && options.muscles);
  }

  /** Updates everything for the next picture. */
  private now(): CameraRig {
    this.measure();
    this.world.pose(this.clock.time, this.place);
    this.rig.follow(this.place, this.world.room(this.clock.time));
    this.stage.follow(this.place);
    this.world.clear(this.rig.camera.position, this.rig.controls.target);
    return this.rig;
  }

  private attach(name: string): void {
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute(
      "aria-label",
      `Figure of ${name} in 3-D with the ground forces. Keys a, d, w, s rotate it, e and q zoom.`,
    );
    Object.assign(this.canvas.style, { display: "block", width: "100%", height: "100%" });
    this.host.append(this.canvas);
  }

  private listeners(): (() => void)[] {
    const changed = (): void => this.stage.invalidate();
    const sizes = new ResizeObserver(() => this.measure() && this.stage.draw());
    sizes.observe(this.host);
    this.canvas.addEventListener("webglcontextrestored", changed);
    return [
      () => sizes.disconnect(),
      this.clock.subscribe(changed),
      onThemeChange(() => this.recolor()),
      listen(this.canvas, this.rig, changed),
    ];
  }

  private recolor(): void {
    const colors = palette(theme() === "dark", this.ghosts);
    this.world.recolor(colors);
    this.activation.recolor(colors);
    this.stage.recolor(colors);
    this.stage.invalidate();
  }

  /** Takes the size of the host; returns whether it changed. A resized canvas is empty and must be drawn at once, or it flickers. */
  private measure(): boolean {
    const { clientWidth, clientHeight } = this.host;
    const changed = clientWidth !== this.width || clientHeight !== this.height;
    if (changed && clientWidth > 0 && clientHeight > 0) {
      [this.width, this.height] = [clientWidth, clientHeight];
      this.stage.resize(clientWidth, clientHeight);
      this.rig.resize(clientWidth, clientHeight);
    }
    return changed;
  }
}

function nothing(host: HTMLElement, sentence: string): View3D {
  const paragraph = say(host, sentence);
  return {
    drawn: false,
    ghosts: false,
    options: FIRST_OPTIONS,
    setCamera() {},
    setOptions() {},
    still: () => "",
    dispose: () => paragraph.remove(),
  };
}
