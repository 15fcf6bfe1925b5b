import uPlot from "uplot";
import type { ActiveTime, Area, Axis, Drawing, Line } from "./drawing";
import { roundValues, shown } from "./format";
import { areaLook, lineLook, pixels, type Scheme, sideLook } from "./look";
import { colour, STYLE } from "./style";

/** Size of the axes [CSS px]. */
export const ROOM = { left: 32, bottom: 17, top: 5, right: 13 } as const;
/** Height of the bars of activity at the upper edge [CSS px]. */
const BAR = 4;
/** Height of the ticks for foot strikes and foot offs [CSS px]. */
export const MARK = 9;

/** Values at the axes of a drawing. */
export function ticksOf(drawing: Drawing): { readonly x: number[]; readonly y: number[] } {
  const [from, to] = drawing.x;
  const x = drawing.axis === "cycle" ? [0, 20, 40, 60, 80, 100] : roundValues(from, to, 5);
  return { x, y: roundValues(drawing.y[0], drawing.y[1], 5) };
}

/** Labels of the horizontal axis; the last one has the unit. */
export function xWords(ticks: readonly number[], axis: Axis): string[] {
  return ticks.map((tick, i) =>
    i === ticks.length - 1 ? (axis === "cycle" ? `${tick}%` : `${tick} s`) : String(tick),
  );
}

/** Labels of the vertical axis, all with the same number of decimal places. */
export function yWords(ticks: readonly number[]): string[] {
  const largest = Math.max(...ticks.map(Math.abs));
  if (largest < 1e-3 || largest >= 1e6) {
    return ticks.map((tick) => (tick === 0 ? "0" : tick.toExponential(0).replaceAll("-", "−")));
  }
  const digits = Math.max(0, ...ticks.map((tick) => (String(tick).split(".")[1] ?? "").length));
  return ticks.map((tick) => shown(tick, digits));
}

/** Draws into a host of the given size. */
export function plot(host: HTMLElement, drawing: Drawing, scheme: Scheme, width: number, height: number): uPlot {
  const ticks = ticksOf(drawing);
  // On high-resolution screens uPlot scales whole pixels only.
  const font = `${Math.round(pixels(STYLE.font.tick_pt))}px ${STYLE.font.family}`;
  const axis = { font, stroke: () => colour("quiet"), ticks: { show: false } };
  const grid = { width: pixels(STYLE.lines_pt.grid), stroke: () => colour("grid") };
  const options: uPlot.Options = {
    width,
    height,
    padding: [ROOM.top, ROOM.right, 0, 0],
    legend: { show: false },
    cursor: { show: false },
    focus: { alpha: 1 },
    scales: {
      x: { time: false, range: [drawing.x[0], drawing.x[1]] },
      y: { range: [drawing.y[0], drawing.y[1]] },
    },
    axes: [
      { ...axis, grid, size: ROOM.bottom, gap: 3, splits: () => ticks.x, values: () => xWords(ticks.x, drawing.axis) },
      { ...axis, grid, size: ROOM.left, gap: 4, splits: () => ticks.y, values: () => yWords(ticks.y) },
    ],
    series: [{}, ...drawing.lines.map((line) => seriesOf(line, scheme))],
    hooks: {
      drawClear: [(chart) => drawBehind(chart, drawing, scheme)],
      draw: [(chart) => drawFrame(chart, drawing, scheme)],
    },
  };
  return onPlainCanvas(() => new uPlot(options, dataOf(drawing.lines), host));
}

/**
 * Makes the processor draw on the canvases that are created meanwhile. A plot is drawn once and does not change; preparing the graphics
 * card for it takes longer, and without a card half a second.
 */
function onPlainCanvas<T>(make: () => T): T {
  const { prototype } = HTMLCanvasElement;
  const original = prototype.getContext;
  prototype.getContext = function (this: HTMLCanvasElement, kind: string, settings?: object) {
    return original.call(this, kind, { ...settings, willReadFrequently: true });
  } as typeof original;
  try {
    return make();
  } finally {
    prototype.getContext = original;
  }
}

function seriesOf(line: Line, scheme: Scheme): uPlot.Series {
  const look = lineLook(line, scheme);
  return {
    stroke: () => lineLook(line, scheme).colour,
    width: look.width,
    dash: [...look.dash],
    alpha: look.opacity,
    points: { show: false },
    spanGaps: false,
  };
}

/** Lines that share their abscissa unchanged; lines with different abscissas joined. */
function dataOf(lines: readonly Line[]): uPlot.AlignedData {
  const tables: [Float64Array, ...(number | null)[][]][] = [];
  for (const line of lines) {
    const table = tables.find(([x]) => sameValues(x, line.x));
    const values = Array.from(line.y, (value) => (Number.isFinite(value) ? value : null));
    if (table) {
      table.push(values);
    } else {
      tables.push([line.x, values]);
    }
  }
  const [first] = tables;
  if (!first) {
    return [[]];
  }
  return tables.length === 1 ? first : inLineOrder(lines, uPlot.join(tables), tables);
}

/** `join` orders the lines by table; this restores the order of the series. */
function inLineOrder(
  lines: readonly Line[],
  joined: uPlot.AlignedData,
  tables: readonly (readonly [Float64Array, ...unknown[]])[],
): uPlot.AlignedData {
  const grouped = tables.flatMap(([x]) => lines.filter((line) => sameValues(x, line.x)));
  return [joined[0], ...lines.map((line) => joined[1 + grouped.indexOf(line)] ?? [])];
}

function sameValues(a: Float64Array, b: Float64Array): boolean {
  return a === b || (a.length === b.length && a[0] === b[0] && a[a.length - 1] === b[b.length - 1]);
}

function drawBehind(chart: uPlot, drawing: Drawing, scheme: Scheme): void {
  const { ctx } = chart;
  const { left, top, width, height } = chart.bbox;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  for (const area of drawing.areas) {
    const look = areaLook(area, scheme);
    ctx.globalAlpha = look.opacity;
    ctx.fillStyle = look.colour;
    for (const [from, to] of runs(area)) {
      fillRun(chart, area, from, to);
    }
  }
  ctx.globalAlpha = 0.12;
  ctx.fillStyle = colour("infeasible");
  for (const shade of drawing.shades) {
    const from = chart.valToPos(shade.from, "x", true);
    ctx.fillRect(from, top, Math.max(chart.valToPos(shade.to, "x", true) - from, 1), height);
  }
  ctx.restore();
}

function fillRun(chart: uPlot, area: Area, from: number, to: number): void {
  const { ctx } = chart;
  const x = (i: number): number => chart.valToPos(area.x[i] ?? 0, "x", true);
  ctx.beginPath();
  for (let i = from; i < to; i++) {
    ctx.lineTo(x(i), chart.valToPos(area.high[i] ?? 0, "y", true));
  }
  for (let i = to - 1; i >= from; i--) {
    ctx.lineTo(x(i), chart.valToPos(area.low[i] ?? 0, "y", true));
  }
  ctx.closePath();
  ctx.fill();
}

/** Index ranges without gaps, from (included) to (not included). */
export function runs(area: { readonly low: Float64Array; readonly high: Float64Array }): [number, number][] {
  const found: [number, number][] = [];
  let from = -1;
  for (let i = 0; i <= area.low.length; i++) {
    const inside = Number.isFinite(area.low[i] ?? Number.NaN) && Number.isFinite(area.high[i] ?? Number.NaN);
    if (inside && from < 0) {
      from = i;
    } else if (!inside && from >= 0) {
      found.push([from, i]);
      from = -1;
    }
  }
  return found;
}

/** Colour of a bar of activity, its height, and its distance from the upper edge [CSS px]: usual times, right, left. */
export function barLook({ side }: ActiveTime): { readonly fill: string; readonly high: number; readonly down: number } {
  const row = side === null ? 0 : side === "r" ? 1 : 2;
  return { fill: colour((["quiet", "right", "left"] as const)[row] ?? "quiet"), high: BAR, down: row * (BAR + 1) };
}

/** Draws the zero line, the axes, the bars of activity and the ticks for foot strikes and foot offs. */
function drawFrame(chart: uPlot, drawing: Drawing, scheme: Scheme): void {
  const { ctx } = chart;
  const { left, top, width, height } = chart.bbox;
  const ratio = devicePixelRatio;
  ctx.save();
  ctx.globalAlpha = 1;
  ctx.setLineDash([]);
  ctx.strokeStyle = colour("quiet");
  ctx.lineWidth = pixels(STYLE.lines_pt.zero) * ratio;
  if (drawing.y[0] < 0 && drawing.y[1] > 0) {
    strokeLine(ctx, left, chart.valToPos(0, "y", true), left + width, chart.valToPos(0, "y", true));
  }
  ctx.lineWidth = pixels(STYLE.lines_pt.axis) * ratio;
  strokeLine(ctx, left, top, left, top + height);
  strokeLine(ctx, left, top + height, left + width, top + height);
  ctx.lineWidth = pixels(STYLE.lines_pt.tick) * ratio;
  for (const time of drawing.active) {
    const { fill, high, down } = barLook(time);
    const x = chart.valToPos(time.from, "x", true);
    ctx.fillStyle = fill;
    ctx.fillRect(x, top + down * ratio, chart.valToPos(time.to, "x", true) - x, high * ratio);
  }
  for (const mark of drawing.marks) {
    const look = sideLook(mark, scheme);
    const x = chart.valToPos(mark.x, "x", true);
    const long = (mark.kind === "strike" ? 0.5 : 1) * MARK * ratio;
    ctx.strokeStyle = look.colour;
    ctx.setLineDash(mark.side === "l" ? [2.5 * ratio, 1.5 * ratio] : []);
    strokeLine(ctx, x, top + height, x, top + height - long);
  }
  ctx.restore();
}

function strokeLine(ctx: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
  ctx.beginPath();
  ctx.moveTo(x1, y1);
  ctx.lineTo(x2, y2);
  ctx.stroke();
}
