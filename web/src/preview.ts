// The walk while a slider moves: interpolated curves with their error, and the figure that walks.

import { arrow } from "./arrow";
import { type Between, POINTS, QUANTITIES, type Values, type Walks } from "./family";

/** A panel: a curve of the family and its words. */
interface Panel {
  name: string;
  title: string;
  unit: string;
  digits: number;
}

const JOINTS = [
  ["hip_flexion", "Hip flexion", "Hip"],
  ["knee_flexion", "Knee flexion", "Knee"],
  ["ankle_dorsiflexion", "Ankle dorsiflexion", "Ankle"],
] as const;

const PANELS: Panel[] = [
  ...JOINTS.map(([name, title]) => ({ name, title, unit: "°", digits: 1 })),
  ...JOINTS.map(([name, , title]) => ({ name: `${name}_moment`, title: `${title} moment`, unit: "N.m/kg", digits: 2 })),
  ...JOINTS.map(([name, , title]) => ({ name: `${name}_power`, title: `${title} power`, unit: "W/kg", digits: 2 })),
  { name: "ground_force_vertical", title: "Vertical ground force", unit: "BW", digits: 2 },
  { name: "ground_force_fore_aft", title: "Forward ground force", unit: "BW", digits: 2 },
  { name: "ground_force_lateral", title: "Sideways ground force", unit: "BW", digits: 2 },
];

/** Width and height of the drawing of a panel; it is stretched to its place. */
const [WIDTH, HEIGHT] = [200, 80];
/** Length of an arrow for one body weight [m]. */
const ARROW_M = 0.5;
/** Smaller forces have no arrow [body weights]. */
const LIGHT = 0.02;
/** Distance of the marks on the ground [m]. */
const MARK_M = 0.5;
/** Half the width of the picture of the figure [m]. */
const HALF_M = 0.8;
/** The figure stands still at this share of the cycle where motion is not wanted. */
const STILL = 0.12;

const SVG = "http://www.w3.org/2000/svg";

function drawn<K extends keyof SVGElementTagNameMap>(
  parent: Element,
  tag: K,
  attributes: Record<string, string | number>,
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, String(value));
  }
  parent.append(element);
  return element;
}

function written(parent: Element, tag: string, className: string, text = ""): HTMLElement {
  const element = document.createElement(tag);
  element.className = className;
  element.textContent = text;
  parent.append(element);
  return element;
}

/** Changes a text only if it differs: the page is laid out anew after a change. */
function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}

const pathOf = (points: readonly (readonly [number, number])[]): string =>
  points.map(([x, y], index) => `${index === 0 ? "M" : "L"}${x.toFixed(2)} ${y.toFixed(2)}`).join("");

/** One curve over the gait cycle. */
class Chart {
  private readonly drawing: SVGSVGElement;
  private readonly zero: SVGElement;
  private readonly off: SVGElement;
  private readonly band: SVGElement;
  private readonly line: SVGElement;
  private readonly high: HTMLElement;
  private readonly low: HTMLElement;
  private readonly error: HTMLElement;

  /** `range` is that of all walks of the family, for a leg of 1 m. */
  constructor(
    parent: Element,
    private readonly panel: Panel,
    private readonly range: readonly [number, number],
    private readonly power: number,
  ) {
    const figure = written(parent, "figure", "");
    const caption = written(figure, "figcaption", "", `${panel.title} `);
    written(caption, "span", "", panel.unit);
    const frame = written(figure, "div", "chart");
    this.high = written(frame, "span", "high");
    this.low = written(frame, "span", "low");
    this.drawing = drawn(frame, "svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: "none", role: "img" });
    this.zero = drawn(this.drawing, "line", { class: "zero", x1: 0, x2: WIDTH });
    this.off = drawn(this.drawing, "line", { class: "off", y1: 0, y2: HEIGHT });
    this.band = drawn(this.drawing, "path", { class: "band" });
    this.line = drawn(this.drawing, "path", { class: "curve" });
    this.error = written(figure, "p", "error");
  }

  show(walk: Between): void {
    const { name, title, unit, digits } = this.panel;
    const scale = walk.leg ** this.power;
    const margin = 0.05 * (this.range[1] - this.range[0]);
    const [low, high] = [scale * (this.range[0] - margin), scale * (this.range[1] + margin)];
    const across = (index: number): number => (WIDTH * index) / (POINTS - 1);
    const up = (value: number): number => (HEIGHT * (high - value)) / (high - low);
    const curve = walk.curve(name);
    const { rms, largest } = walk.error(name);
    const moved = (by: number): [number, number][] => Array.from(curve, (value, i) => [across(i), up(value + by)]);
    this.line.setAttribute("d", pathOf(moved(0)));
    this.band.setAttribute("d", `${pathOf([...moved(rms), ...moved(-rms).reverse()])}Z`);
    this.zero.setAttribute("transform", `translate(0 ${up(0)})`);
    this.off.setAttribute("transform", `translate(${WIDTH * (0.5 + walk.support)} 0)`);
    const word = (value: number): string => value.toFixed(digits);
    say(this.high, (scale * this.range[1]).toFixed(1));
    say(this.low, (scale * this.range[0]).toFixed(1));
    say(this.error, `± ${word(rms)}, at most ${word(largest)}`);
    const [least, most] = [Math.min(...curve), Math.max(...curve)];
    this.drawing.setAttribute("aria-label", `${title}: from ${word(least)} to ${word(most)} ${unit}`);
  }
}

type Place = readonly [x: number, y: number];

/** Half the width of the body at joints, as shares of the leg: the figure is a picture, not a part of the model. */
const WIDTHS: Record<string, number> = { hip: 0.095, knee: 0.06, ankle: 0.038, ball: 0.022 };
const TRUNK = { hip: 0.13, shoulder: 0.14, neck: 0.05 };

/** The outline of a part of the body between two joints with half widths there: two circles and their tangents. */
function limb(from: Place, to: Place, wide: number, narrow: number): string {
  const [x, y] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(x, y) || 1;
  const [u, v] = [-y / length, x / length];
  const at = ([a, b]: Place, by: number): string => `${(a + by * u).toFixed(3)} ${(b + by * v).toFixed(3)}`;
  const round = (radius: number): string => `A${radius} ${radius} 0 0 0`;
  return `M${at(from, wide)}L${at(to, narrow)}${round(narrow)} ${at(to, -narrow)}L${at(from, -wide)}${round(wide)} ${at(from, wide)}Z`;
}

/** The figure in the sagittal plane. */
class Figure {
  private readonly drawing: SVGSVGElement;
  private readonly tilted: SVGElement;
  private readonly marks: SVGElement;
  private readonly parts: Record<"left" | "trunk" | "right", SVGElement>;
  private readonly head: SVGElement;
  private readonly arrows: Record<"left" | "right", SVGElement>;
  private curves = new Map<string, Float64Array>();
  /** [m] */
  private leg = 1;

  constructor(parent: Element) {
    this.drawing = drawn(parent, "svg", { class: "figure", role: "img" });
    this.drawing.setAttribute("aria-label", "The figure walks, seen from its right side, with the ground forces");
    this.tilted = drawn(this.drawing, "g", {});
    drawn(this.tilted, "line", { class: "ground", x1: -2 * HALF_M, x2: 2 * HALF_M, y1: 0, y2: 0 });
    this.marks = drawn(this.tilted, "path", { class: "ground" });
    const part = (name: string): SVGElement => drawn(this.tilted, "path", { class: name });
    this.parts = { left: part("left"), trunk: part("trunk"), right: part("right") };
    this.head = drawn(this.tilted, "ellipse", { class: "trunk" });
    this.arrows = { left: part("left arrow"), right: part("right arrow") };
  }

  take(walk: Between, slope: number): void {
    const names = QUANTITIES.map(({ name }) => name).filter((name) => /_[xy]$|^ground_force/.test(name));
    this.curves = new Map(names.map((name) => [name, walk.curve(name)]));
    this.leg = walk.leg;
    const top = 2.15 * walk.leg;
    const half = HALF_M;
    this.drawing.setAttribute("viewBox", `${-half} ${-top} ${2 * half} ${top + 0.3}`);
    // Places are those along and across the ground.
    this.tilted.setAttribute("transform", `rotate(${(-Math.atan(slope / 100) * 180) / Math.PI})`);
  }

  private value(name: string, share: number): number {
    const curve = this.curves.get(name) ?? new Float64Array(POINTS);
    const at = (share - Math.floor(share)) * (POINTS - 1);
    const index = Math.min(Math.floor(at), POINTS - 2);
    const [a, b] = [curve[index] ?? 0, curve[index + 1] ?? 0];
    return a + (at - index) * (b - a);
  }

  private place(joint: string, share: number): Place {
    return [this.value(`${joint}_x`, share), -this.value(`${joint}_y`, share)];
  }

  /** Draws the figure at a share of the cycle, after it has walked a distance [m]. */
  draw(share: number, walked: number): void {
    const middle = (joint: string): Place => {
      const [a, b] = [this.place(joint, share), this.place(joint, share + 0.5)];
      return [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    };
    for (const [side, at] of [
      ["right", share],
      ["left", share + 0.5],
    ] as const) {
      const joints = Object.entries(WIDTHS).map(([joint, width]) => [this.place(joint, at), width * this.leg] as const);
      const limbs = joints.slice(1).map(([to, narrow], index) => {
        const [from, wide] = joints[index] ?? [to, narrow];
        return limb(from, to, wide, narrow);
      });
      this.parts[side].setAttribute("d", limbs.join(""));
      this.arrows[side].setAttribute("d", this.arrow(at));
    }
    const [hip, shoulder] = [middle("hip"), middle("shoulder")];
    const [x, y] = [shoulder[0] - hip[0], shoulder[1] - hip[1]];
    const along = (share: number): Place => [shoulder[0] + share * x, shoulder[1] + share * y];
    const [wide, narrow, neck] = [TRUNK.hip, TRUNK.shoulder, TRUNK.neck].map((share) => share * this.leg) as [
      number,
      number,
      number,
    ];
    const trunk = limb(hip, shoulder, wide, narrow) + limb(shoulder, along(0.4), neck, neck);
    this.parts.trunk.setAttribute("d", trunk);
    const tilt = (Math.atan2(x, -y) * 180) / Math.PI;
    this.head.setAttribute("transform", `translate(${along(0.5).join(" ")}) rotate(${tilt})`);
    this.head.setAttribute("rx", String(0.17 * Math.hypot(x, y)));
    this.head.setAttribute("ry", String(0.23 * Math.hypot(x, y)));
    const first = -(walked % MARK_M) - 4 * MARK_M;
    const marks = Array.from({ length: 9 }, (_, index) => first + index * MARK_M);
    this.marks.setAttribute("d", marks.map((mark) => `M${mark} 0l-0.05 0.08`).join(""));
  }

  private arrow(share: number): string {
    const [forward, up] = [this.value("ground_force_fore_aft", share), this.value("ground_force_vertical", share)];
    if (up < LIGHT) {
      return "";
    }
    return arrow([this.value("pressure_x", share), 0], [ARROW_M * forward, -ARROW_M * up]);
  }
}

/** The preview of a walk. */
export class Preview {
  private readonly note: HTMLElement;
  private readonly drawings: HTMLElement;
  private readonly charts: Chart[];
  private readonly figure: Figure;
  private walk: Between | undefined;
  private speed = 0;
  private share = STILL;
  private walked = 0;
  private drawnAt = 0;

  constructor(
    private readonly element: HTMLElement,
    private readonly walks: Walks,
  ) {
    // It scrolls where it is taller than the screen.
    element.tabIndex = 0;
    this.drawings = written(element, "div", "drawings");
    this.note = written(element, "p", "note");
    this.figure = new Figure(this.drawings);
    const charts = written(this.drawings, "div", "charts");
    this.charts = PANELS.map((panel) => {
      const row = QUANTITIES.findIndex(({ name }) => name === panel.name);
      return new Chart(charts, panel, walks.family.ranges[row] ?? [0, 1], QUANTITIES[row]?.power ?? 0);
    });
  }

  /** Shows the walk with these values and returns it; hides the preview and returns none if no walks near it were solved beforehand. */
  show(values: Values): Between | undefined {
    const walk = this.walks.at(values);
    const begins = this.element.hidden || !this.walk;
    this.walk = walk;
    this.speed = values.speed;
    this.element.hidden = !walk;
    const source = `between walks that were solved beforehand${values.slope === 0 ? "" : " (predicted, on a slope)"}`;
    say(
      this.note,
      `Preview, interpolated ${source}, without arms. Right leg over its cycle; the left leg does the same half a cycle later. ±: difference from exact walks, measured nearby (root mean square, and largest). BW: body weights.`,
    );
    if (walk) {
      for (const chart of this.charts) {
        chart.show(walk);
      }
      this.figure.take(walk, values.slope);
      this.figure.draw(this.share, this.walked);
      if (begins && !matchMedia("(prefers-reduced-motion: reduce)").matches) {
        this.drawnAt = performance.now();
        requestAnimationFrame((now) => this.step(now));
      }
    }
    return walk;
  }

  private step(now: number): void {
    if (this.element.hidden || !this.walk) {
      return;
    }
    const passed = Math.max(now - this.drawnAt, 0) / 1000;
    this.drawnAt = now;
    this.share = (this.share + passed / this.walk.cycle_s) % 1;
    this.walked += passed * this.speed;
    this.figure.draw(this.share, this.walked);
    requestAnimationFrame((next) => this.step(next));
  }
}
