import type { Origin, PageSide, Panel, RedSpan, Session, TimeAxis, Trace } from "./contract";
import type { Numbers } from "./numbers";
import { percentAt } from "./phase";

/** Horizontal axis: percent of the gait cycle, or time. */
export type Axis = "cycle" | "time";

/** Role of a line; determines its style. */
export type LineRole = "cycle" | "mean" | "main" | "predicted" | "measured" | "limit" | "infeasible";

/** A curve in the panel's units. */
export interface Line {
  readonly name: string;
  readonly role: LineRole;
  readonly side: PageSide | null;
  readonly session: number;
  /** Cycle number, if the line is a single cycle. */
  readonly cycle: number | null;
  /** Index among several main lines of one side over time, from 0. */
  readonly variant: number;
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly origin: Origin | null;
}

/** A filled area between two curves. */
export interface Area {
  readonly kind: "band" | "deviation";
  readonly side: PageSide | null;
  readonly session: number;
  readonly x: Float64Array;
  readonly low: Float64Array;
  readonly high: Float64Array;
}

/** A tick at the bottom of the panel. */
export interface Mark {
  readonly kind: "strike" | "foot-off";
  readonly side: PageSide;
  readonly session: number;
  readonly x: number;
}

/** A time span that is not feasible. */
export interface Shade {
  readonly from: number;
  readonly to: number;
}

/** A time in which muscles are active [% of the cycle]: usually, or in the electromyogram of a side. */
export interface ActiveTime {
  readonly from: number;
  readonly to: number;
  readonly side: PageSide | null;
}

/** Everything drawn in a panel, in the panel's units, back to front. */
export interface Drawing {
  readonly axis: Axis;
  readonly x: readonly [number, number];
  readonly y: readonly [number, number];
  readonly areas: readonly Area[];
  readonly shades: readonly Shade[];
  readonly lines: readonly Line[];
  readonly marks: readonly Mark[];
  readonly active: readonly ActiveTime[];
}

/** One session's data for a panel. */
export interface PanelSource {
  /** Index of the session in the page. */
  readonly index: number;
  readonly session: Session;
  readonly panel: Panel;
}

/** Selection of the data to draw. */
export interface DrawingChoice {
  readonly axis: Axis;
  /** Sides to show; curves without a side are always shown. */
  readonly sides: readonly PageSide[];
}

const PERCENT = Float64Array.from({ length: 101 }, (_, i) => i);
/** Margin above and below, as a fraction of the range of the data. */
const ROOM = 0.06;
/** Zero is shown if its distance is at most this fraction of the range of the data. */
const ZERO_WITHIN = 0.35;
/** Values that differ by less count as equal: in every unit used, such a difference is rounding. */
const NOISE = 1e-9;
/** A limit further away than this fraction of the range of the data is left outside the panel, so that the curves stay legible. */
const LIMIT_WITHIN = 0.6;

/** The drawing of one quantity for one or more sessions; `null` if the chosen axis has no values. */
export function drawing(sources: readonly PanelSource[], numbers: Numbers, choice: DrawingChoice): Drawing | null {
  const axis = possibleAxis(sources, choice.axis);
  if (axis === null) {
    return null;
  }
  const part = axis === "cycle" ? cyclePart : timePart;
  const parts = sources.map((source) => part(source, numbers, sources));
  const shown = <T extends { readonly side: PageSide | null }>(item: T): boolean =>
    item.side === null || choice.sides.includes(item.side);
  const lines = parts.flatMap((one) => one.lines).filter(shown);
  const areas = parts.flatMap((one) => one.areas).filter(shown);
  return {
    axis,
    x: axis === "cycle" ? [0, 100] : timeRange(sources),
    y: valueRange(lines, areas),
    areas: inOrder(areas, (area) => (area.kind === "band" ? 0 : 1)),
    shades: parts.flatMap((one) => one.shades),
    lines: inOrder(lines, (line) => ORDER.indexOf(line.role)),
    marks: parts.flatMap((one) => one.marks).filter(shown),
    active: axis === "cycle" ? activeTimes(sources).filter(shown) : [],
  };
}

/** Usual times of activity, which are the same in every session, and those of the electromyograms of a single session. */
function activeTimes(sources: readonly PanelSource[]): ActiveTime[] {
  const activities = sources.flatMap(({ panel }) => panel.activity ?? []);
  const usual = activities.map((activity) => activity.usual).find((times) => times.length > 0) ?? [];
  const recorded = sources.length === 1 ? activities.flatMap((activity) => activity.recorded) : [];
  return [{ side: null, times: usual }, ...recorded].flatMap(({ side, times }) =>
    times.map(([from, to]) => ({ from, to, side })),
  );
}

/** Back to front. */
const ORDER: readonly LineRole[] = ["limit", "cycle", "main", "predicted", "mean", "measured", "infeasible"];

interface Part {
  readonly lines: Line[];
  readonly areas: Area[];
  readonly marks: Mark[];
  readonly shades: Shade[];
}

function possibleAxis(sources: readonly PanelSource[], wanted: Axis): Axis | null {
  const cycle = sources.some(({ panel }) => panel.cycles.length + panel.means.length > 0);
  const time = sources.some(({ panel }) => panel.traces.length > 0);
  if (wanted === "cycle") {
    return cycle ? "cycle" : time ? "time" : null;
  }
  return time ? "time" : null;
}

/** Whether there is anything to draw on either axis. */
export function hasValues(sources: readonly PanelSource[]): boolean {
  return possibleAxis(sources, "cycle") !== null;
}

function cyclePart(source: PanelSource, numbers: Numbers, all: readonly PanelSource[]): Part {
  const { panel, index } = source;
  const lines: Line[] = [];
  const marks: Mark[] = [];
  // With several sessions only means are drawn, to keep the sessions distinguishable; without means, the cycles.
  if (all.length === 1 || panel.means.length === 0) {
    lines.push(...cycleLines(source, numbers));
  }
  if (all.length === 1) {
    lines.push(...measuredLines(source, numbers));
  }
  for (const mean of panel.means) {
    const name = `${sideName(mean.side)}, mean of ${mean.cycles}`;
    const y = numbers.read(mean.values);
    lines.push({
      name,
      role: "mean",
      side: mean.side,
      session: index,
      cycle: null,
      variant: 0,
      x: PERCENT,
      y,
      origin: null,
    });
    if (mean.foot_off_percent !== null) {
      marks.push({ kind: "foot-off", side: mean.side, session: index, x: mean.foot_off_percent });
    }
  }
  return { lines, areas: index === firstWithBand(all) ? bandOf(panel, numbers) : [], marks, shades: [] };
}

/** Means of what was measured next to a computed curve. */
function measuredLines({ panel, index }: PanelSource, numbers: Numbers): Line[] {
  return (panel.activity?.measured ?? []).map((mean) => ({
    name: `${sideName(mean.side)}, electromyogram, mean of ${mean.cycles}`,
    role: "measured",
    side: mean.side,
    session: index,
    cycle: null,
    variant: 0,
    x: PERCENT,
    y: numbers.read(mean.values),
    origin: null,
  }));
}

function cycleLines(source: PanelSource, numbers: Numbers): Line[] {
  const { panel, session, index } = source;
  return panel.cycles.flatMap((curve) => {
    const y = numbers.read(curve.values);
    const name = `${sideName(curve.side)}, cycle ${curve.number}`;
    const common = { side: curve.side, session: index, cycle: curve.number, variant: 0, x: PERCENT };
    const line: Line = { name, role: "cycle", y, origin: curve.origin, ...common };
    const cycle = session.cycles.find((one) => one.side === curve.side && one.number === curve.number);
    const inside = (i: number): boolean =>
      cycle !== undefined &&
      panel.red.some(
        (span) =>
          (span.side ?? curve.side) === curve.side &&
          percentAt(cycle, span.from_s) <= i + 0.5 &&
          i - 0.5 <= percentAt(cycle, span.to_s),
      );
    const red = partOf(y, inside);
    return red
      ? [line, { name: `${name}, not feasible`, role: "infeasible", y: red, origin: null, ...common }]
      : [line];
  });
}

function bandOf(panel: Panel, numbers: Numbers): Area[] {
  if (!panel.band) {
    return [];
  }
  const mean = numbers.read(panel.band.mean);
  const x = Float64Array.from(mean, (_, i) => (100 * i) / Math.max(mean.length - 1, 1));
  return [{ kind: "band", side: null, session: 0, x, ...around(mean, numbers.read(panel.band.sd)) }];
}

function firstWithBand(all: readonly PanelSource[]): number {
  return all.find(({ panel }) => panel.band !== null)?.index ?? -1;
}

function timePart(source: PanelSource, numbers: Numbers, all: readonly PanelSource[]): Part {
  const { panel, session, index } = source;
  const shift = timeShift(source, all);
  const x = instants(session.time, shift);
  const lines: Line[] = [];
  const areas: Area[] = [];
  for (const trace of panel.traces) {
    const y = numbers.read(trace.values);
    const main = panel.traces.filter((one) => one.role === "main" && one.side === trace.side);
    const variant = Math.max(main.indexOf(trace), 0);
    const common = { side: trace.side, session: index, cycle: null, variant, x };
    lines.push(...sourced(trace, y, shift, common));
    if (trace.sd) {
      areas.push({ kind: "deviation", side: trace.side, session: index, x, ...around(y, numbers.read(trace.sd)) });
    }
    const red = trace.role === "main" ? partOf(y, (i) => isRed(panel.red, trace.side, (x[i] ?? 0) - shift)) : null;
    if (red) {
      lines.push({ name: `${trace.name}, not feasible`, role: "infeasible", y: red, origin: null, ...common });
    }
  }
  const marks = session.events.map((event) => ({
    kind: event.strike ? ("strike" as const) : ("foot-off" as const),
    side: event.side,
    session: index,
    x: event.time_s + shift,
  }));
  const shades = panel.red.map((span) => ({ from: span.from_s + shift, to: span.to_s + shift }));
  return { lines, areas, marks: all.length === 1 ? marks : [], shades: index === 0 ? shades : [] };
}

/** A trace as one line, or as two: where the load behind it was measured, and where it was predicted. */
function sourced(
  trace: Trace,
  y: Float64Array,
  shift: number,
  common: Omit<Line, "name" | "role" | "y" | "origin">,
): Line[] {
  const { name, role, origin, predicted } = trace;
  const isPredicted = (i: number): boolean => {
    const time = (common.x[i] ?? Number.NaN) - shift;
    return predicted.some(([from, to]) => from - NOISE <= time && time <= to + NOISE);
  };
  // The predicted part reaches to its measured neighbours, so that the curve has no gaps.
  const part = partOf(y, (i) => isPredicted(i - 1) || isPredicted(i) || isPredicted(i + 1));
  if (part === null || role !== "main") {
    return [{ name, role, y, origin, ...common }];
  }
  const rest = y.map((value, i) => (isPredicted(i) ? Number.NaN : value));
  return [
    { name, role, y: rest, origin, ...common },
    { name: `${name}, predicted`, role: "predicted", y: part, origin, ...common },
  ];
}

function isRed(spans: readonly RedSpan[], side: PageSide | null, time: number): boolean {
  return spans.some(
    (span) => (span.side === null || side === null || span.side === side) && span.from_s <= time && time <= span.to_s,
  );
}

/** Shifts times so that all sessions start together. */
function timeShift(source: PanelSource, all: readonly PanelSource[]): number {
  const first = all[0] ?? source;
  return first.session.time.start_s - source.session.time.start_s;
}

function timeRange(sources: readonly PanelSource[]): [number, number] {
  const start = sources[0]?.session.time.start_s ?? 0;
  const lengths = sources.map(({ session }) => session.time.step_s * Math.max(session.time.frames - 1, 1));
  return [start, start + Math.max(...lengths)];
}

function instants(axis: TimeAxis, shift: number): Float64Array {
  return Float64Array.from({ length: axis.frames }, (_, i) => axis.start_s + shift + i * axis.step_s);
}

function around(mean: Float64Array, sd: Float64Array): { low: Float64Array; high: Float64Array } {
  return { low: mean.map((m, i) => m - (sd[i] ?? Number.NaN)), high: mean.map((m, i) => m + (sd[i] ?? Number.NaN)) };
}

/** Keeps the selected values and leaves gaps elsewhere; `null` if no value is selected. */
function partOf(values: Float64Array, inside: (i: number) => boolean): Float64Array | null {
  const part = values.map((value, i) => (inside(i) ? value : Number.NaN));
  return part.some(Number.isFinite) ? part : null;
}

/** A range that contains all values with a margin, and zero if it is near. */
export function valueRange(lines: readonly Line[], areas: readonly Area[]): [number, number] {
  const main = lines.filter((line) => line.role !== "limit").map((line) => line.y);
  let [low, high] = extent([...main, ...areas.flatMap((area) => [area.low, area.high])]);
  for (const limit of lines.filter((line) => line.role === "limit")) {
    const [a, b] = extent([limit.y]);
    const room = LIMIT_WITHIN * (high - low);
    low = a >= low - room ? Math.min(low, a) : low;
    high = b <= high + room ? Math.max(high, b) : high;
  }
  if (!(low <= high)) {
    return [-1, 1];
  }
  if (high - low < NOISE) {
    return Math.abs(low) < NOISE ? [-1, 1] : [low - Math.abs(low) / 2, low + Math.abs(low) / 2];
  }
  const span = high - low;
  low = low > 0 && low <= ZERO_WITHIN * span ? 0 : low;
  high = high < 0 && high >= -ZERO_WITHIN * span ? 0 : high;
  return [low === 0 ? 0 : low - ROOM * span, high === 0 ? 0 : high + ROOM * span];
}

function extent(series: readonly Float64Array[]): [number, number] {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (const values of series) {
    for (const value of values) {
      if (Number.isFinite(value)) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
  }
  return [low, high];
}

function inOrder<T>(items: readonly T[], rank: (item: T) => number): T[] {
  return [...items].sort((a, b) => rank(a) - rank(b));
}

/** Name of a side. */
export function sideName(side: PageSide): string {
  return side === "r" ? "right" : "left";
}
