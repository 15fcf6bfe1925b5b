import type { LiveCurve, LiveFrame, LivePanel } from "../contract";
import { element } from "../element";
import { digitsFor, roundValues, shown } from "../format";
import { pixels } from "../look";
import { colour, onThemeChange, STYLE, sideColour } from "../style";

/** Seconds that are shown. */
export const SPAN_S = 6;
/** Room for the numbers of the axis [CSS px]. */
const LEFT = 44;
const BOTTOM = 18;
const TOP = 6;
/** A panel without changes still has this range, in units of its values. */
const LEAST_RANGE = 1;
/** A longer pause between frames is a gap [s]. */
const GAP_S = 0.2;

interface Point {
  readonly time: number;
  readonly values: readonly number[];
}

/** Curves of the last seconds of one quantity. */
export class CurvePanel {
  readonly element: HTMLElement;
  private readonly canvas = document.createElement("canvas");
  private readonly now = element("span", { class: "live-now" });
  private points: Point[] = [];
  private asked = false;

  constructor(private readonly panel: LivePanel) {
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${panel.title} of the last ${SPAN_S} s`);
    const title = element("h2", {}, panel.title, element("small", {}, ` ${panel.unit}`));
    this.element = element("section", { class: "live-panel" }, title, this.now, this.canvas);
    new ResizeObserver(() => this.ask()).observe(this.canvas);
    onThemeChange(() => this.ask());
  }

  /** The newest value of each curve. */
  get newest(): readonly number[] {
    const last = this.points[this.points.length - 1];
    return this.panel.curves.map(({ column }) => last?.values[column] ?? Number.NaN);
  }

  /** Adds a frame; earlier frames are dropped when the sender begins again. */
  add({ time_s, values }: LiveFrame): void {
    const last = this.points[this.points.length - 1];
    if (last && time_s <= last.time) {
      this.points = [];
    }
    this.points.push({ time: time_s, values });
    const first = this.points.findIndex(({ time }) => time >= time_s - SPAN_S);
    if (first > 0) {
      this.points.splice(0, first);
    }
    this.ask();
  }

  /** Draws once with the next picture, however many frames come before it. */
  private ask(): void {
    if (!this.asked) {
      this.asked = true;
      requestAnimationFrame(() => {
        this.asked = false;
        this.draw();
      });
    }
  }

  private draw(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const pen = this.canvas.getContext("2d");
    if (!pen || width === 0) return;
    [this.canvas.width, this.canvas.height] = [width * devicePixelRatio, height * devicePixelRatio];
    pen.scale(devicePixelRatio, devicePixelRatio);
    const [low, high] = this.range();
    const end = this.points[this.points.length - 1]?.time ?? 0;
    const x = (time: number): number => LEFT + ((time - end + SPAN_S) / SPAN_S) * (width - LEFT - 4);
    const y = (value: number): number => TOP + ((high - value) / (high - low)) * (height - TOP - BOTTOM);
    axes(pen, [low, high], width, height, y);
    for (const curve of this.panel.curves) {
      this.area(pen, curve, x, y);
    }
    for (const curve of this.panel.curves) {
      this.line(pen, curve, x, y);
    }
    const digits = digitsFor(low, high);
    const words = this.panel.curves.map(
      ({ side }, place) => `${side === "r" ? "right" : "left"} ${shown(this.newest[place], digits)}`,
    );
    this.now.textContent = words.join(", ");
  }

  /** Lowest and highest value with their deviations. */
  private range(): [number, number] {
    let [low, high] = [0, 0];
    for (const { values } of this.points) {
      for (const { column, sd } of this.panel.curves) {
        const value = values[column] ?? 0;
        const deviation = sd === null ? 0 : (values[sd] ?? 0);
        [low, high] = [Math.min(low, value - deviation), Math.max(high, value + deviation)];
      }
    }
    return [low, Math.max(high, low + LEAST_RANGE)];
  }

  private area(pen: CanvasRenderingContext2D, { side, column, sd }: LiveCurve, x: Scale, y: Scale): void {
    if (sd === null) return;
    const edge = (sign: number, { values }: Point): number => y((values[column] ?? 0) + sign * (values[sd] ?? 0));
    pen.globalAlpha = STYLE.uncertainty_opacity;
    pen.fillStyle = sideColour(side);
    for (const run of this.runs()) {
      pen.beginPath();
      for (const point of run) {
        pen.lineTo(x(point.time), edge(1, point));
      }
      for (const point of [...run].reverse()) {
        pen.lineTo(x(point.time), edge(-1, point));
      }
      pen.fill();
    }
    pen.globalAlpha = 1;
  }

  private line(pen: CanvasRenderingContext2D, { side, column }: LiveCurve, x: Scale, y: Scale): void {
    const width = pixels(STYLE.lines_pt.mean);
    pen.strokeStyle = sideColour(side);
    pen.lineWidth = width;
    pen.setLineDash(side === "l" ? STYLE.left.dash.map((length) => length * width) : []);
    for (const run of this.runs()) {
      pen.beginPath();
      for (const { time, values } of run) {
        pen.lineTo(x(time), y(values[column] ?? 0));
      }
      pen.stroke();
    }
    pen.setLineDash([]);
  }

  /** Points between gaps. */
  private runs(): Point[][] {
    const runs: Point[][] = [];
    let before = Number.NEGATIVE_INFINITY;
    for (const point of this.points) {
      if (point.time - before > GAP_S) {
        runs.push([]);
      }
      runs[runs.length - 1]?.push(point);
      before = point.time;
    }
    return runs;
  }
}

type Scale = (value: number) => number;

/** Numbers and grid of both axes. */
function axes(
  pen: CanvasRenderingContext2D,
  [low, high]: readonly [number, number],
  width: number,
  height: number,
  y: Scale,
): void {
  pen.font = `${Math.round(pixels(STYLE.font.tick_pt))}px ${STYLE.font.family}`;
  pen.fillStyle = colour("quiet");
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  for (const value of roundValues(low, high, 4)) {
    pen.strokeStyle = colour(value === 0 ? "quiet" : "grid");
    pen.lineWidth = pixels(value === 0 ? STYLE.lines_pt.zero : STYLE.lines_pt.grid);
    pen.beginPath();
    pen.moveTo(LEFT, y(value));
    pen.lineTo(width - 4, y(value));
    pen.stroke();
    pen.fillText(String(value).replace("-", "−"), LEFT - 5, y(value));
  }
  pen.textBaseline = "bottom";
  pen.fillText("now", width - 4, height);
  pen.textAlign = "left";
  pen.fillText(`−${SPAN_S} s`, LEFT, height);
}
