// Plays a simulated walk, seen from the side, and takes pushes: by dragging, or by buttons.

import { arrow } from "./arrow";
import { type Moving, type Run, valueAt } from "./walker";

const SVG = "http://www.w3.org/2000/svg";
/** Height and width of the picture, and its part below the ground [m]. */
const [HIGH_M, WIDE_M, BELOW_M] = [2.1, 4, 0.15];
/** Distance of the marks on the ground [m]. */
const MARK_M = 0.5;
/** Length of the arrow of a force [m/N], and the smallest force that has one [N]. */
const [METRES_PER_NEWTON, LIGHT_N] = [1e-3, 20];
/** A drag over this distance is a ball that is 1 m/s faster than the walker [m]. */
const DRAG_M = 0.12;
/** Shorter drags are none [m/s]. */
const LEAST = 0.5;

function drawn(parent: Element, tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(SVG, tag) as SVGElement;
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, String(value));
  }
  parent.append(element);
  return element;
}

/** A number at the last instant before a time: forces jump, and their place with them. */
function at({ times }: Run, values: readonly number[] | undefined, time: number): number {
  const last = times.length - 1;
  const index = Math.floor(Math.min(Math.max((time * last) / (times[last] ?? 1), 0), last) + 1e-9);
  return values?.[index] ?? 0;
}

/** The picture of a walk. */
export class Stage {
  private readonly drawing: SVGSVGElement;
  private readonly marks: SVGElement;
  private readonly people: SVGElement;
  private readonly forces: SVGElement[];
  private readonly arrow: SVGElement;
  private run: Run | undefined;
  private shapes: [Moving, SVGElement][] = [];
  private time = 0;
  /** The walk is not known after this time [s]. */
  private known = 0;
  private playing = false;
  private drawnAt = 0;
  private seenFrom = 0;

  /** `push` is called with how much faster than the walker the ball is [m/s]; `moved` whenever time or playing changes. */
  constructor(
    parent: HTMLElement,
    private readonly push: (faster: number) => void,
    private readonly moved: () => void,
  ) {
    this.drawing = drawn(parent, "svg", {
      class: "scene",
      viewBox: `0 ${BELOW_M - HIGH_M} ${WIDE_M} ${HIGH_M}`,
      role: "img",
      "aria-label": "The walker from the right side, with the ground forces; drag forwards or backwards to push",
    }) as SVGSVGElement;
    drawn(this.drawing, "line", { class: "floor", x1: -WIDE_M, x2: 2 * WIDE_M, y1: 0, y2: 0 });
    this.marks = drawn(this.drawing, "path", { class: "floor" });
    this.people = drawn(this.drawing, "g", {});
    this.forces = ["trunk", "r", "l"].map((kind) => drawn(this.drawing, "path", { class: `force ${kind}` }));
    this.arrow = drawn(this.drawing, "path", { class: "drag" });
    this.takeDrags();
  }

  get now(): number {
    return this.time;
  }

  get isPlaying(): boolean {
    return this.playing;
  }

  get isOver(): boolean {
    return this.run !== undefined && this.time >= this.end;
  }

  private get end(): number {
    return this.run?.times.at(-1) ?? 0;
  }

  /** Shows another walk, which is the same as the one before until now. */
  show(run: Run): void {
    this.run = run;
    this.known = this.end;
    const order = (side: Moving["side"]): number => (side === "l" ? 0 : side === "r" ? 2 : 1);
    const bodies = [...run.bodies].sort((a, b) => order(a.side) - order(b.side));
    this.people.replaceChildren();
    this.shapes = bodies.map((body) => {
      const kind = body.name.includes("/") ? (body.side ?? "trunk") : "ball";
      const group = drawn(this.people, "g", { class: kind });
      for (const { from, to, radius } of body.capsules.filter(({ sphere }) => kind === "ball" || !sphere)) {
        const ends = { x1: from[0], y1: -from[1], x2: to[0] + 1e-6, y2: -to[1] };
        drawn(group, "line", { ...ends, "stroke-width": 2 * radius });
      }
      return [body, group];
    });
    this.draw();
  }

  /** From this time on the walk will be another one: playing waits there. */
  waitAt(time: number): void {
    this.known = Math.min(this.known, time);
  }

  /** Plays from the beginning, or goes on. */
  play(fromStart = false): void {
    this.time = fromStart || this.isOver ? 0 : this.time;
    this.playing = true;
    this.drawnAt = performance.now();
    requestAnimationFrame((now) => this.step(now));
    this.moved();
  }

  pause(): void {
    this.playing = false;
    this.moved();
  }

  private step(now: number): void {
    if (!this.playing || !this.run) {
      return;
    }
    this.time = Math.min(this.time + Math.max(now - this.drawnAt, 0) / 1000, this.known);
    this.drawnAt = now;
    this.draw();
    if (this.isOver) {
      this.pause();
      return;
    }
    this.moved();
    requestAnimationFrame((next) => this.step(next));
  }

  private draw(): void {
    const { run } = this;
    if (!run) {
      return;
    }
    const pelvis = run.bodies.find(({ name }) => name.endsWith("/pelvis"));
    this.seenFrom = (pelvis ? valueAt(run, pelvis.x, this.time) : 0) - 0.5 * WIDE_M;
    for (const [body, group] of this.shapes) {
      const [x, y, angle] = [body.x, body.y, body.angle].map((of) => valueAt(run, of, this.time)) as [
        number,
        number,
        number,
      ];
      const turned = (-angle * 180) / Math.PI;
      group.setAttribute("transform", `translate(${x - this.seenFrom} ${-y}) rotate(${turned})`);
    }
    for (const [index, path] of this.forces.entries()) {
      const force = run.ground[index];
      const [x, y, forward, up] = [force?.x, force?.y, force?.forward, force?.up].map((of) => at(run, of, this.time));
      const isShown = Math.hypot(forward ?? 0, up ?? 0) > LIGHT_N;
      const from = [(x ?? 0) - this.seenFrom, -(y ?? 0)] as const;
      const by = [METRES_PER_NEWTON * (forward ?? 0), -METRES_PER_NEWTON * (up ?? 0)] as const;
      path.setAttribute("d", isShown ? arrow(from, by) : "");
    }
    const first = Math.ceil(this.seenFrom / MARK_M) * MARK_M - this.seenFrom - MARK_M;
    const marks = Array.from({ length: WIDE_M / MARK_M + 2 }, (_, index) => first + index * MARK_M);
    this.marks.setAttribute("d", marks.map((mark) => `M${mark} 0l-0.04 0.06`).join(""));
  }

  private takeDrags(): void {
    let start: DOMPoint | undefined;
    const at = (event: PointerEvent): DOMPoint =>
      new DOMPoint(event.clientX, event.clientY).matrixTransform(this.drawing.getScreenCTM()?.inverse());
    const fasterAt = (event: PointerEvent): number => (start ? (at(event).x - start.x) / DRAG_M : 0);
    this.drawing.addEventListener("pointerdown", (event) => {
      start = at(event);
      this.drawing.setPointerCapture(event.pointerId);
    });
    this.drawing.addEventListener("pointermove", (event) => {
      if (start) {
        const to = at(event).x;
        const wing = 0.06 * Math.sign(to - start.x);
        const tip = `M${to - wing} ${start.y - 0.05}L${to} ${start.y}L${to - wing} ${start.y + 0.05}`;
        this.arrow.setAttribute("d", `M${start.x} ${start.y}L${to} ${start.y}${tip}`);
      }
    });
    const end = (event: PointerEvent): void => {
      const faster = fasterAt(event);
      start = undefined;
      this.arrow.setAttribute("d", "");
      if (event.type === "pointerup" && Math.abs(faster) >= LEAST) {
        this.push(faster);
      }
    };
    this.drawing.addEventListener("pointerup", end);
    this.drawing.addEventListener("pointercancel", end);
  }
}
