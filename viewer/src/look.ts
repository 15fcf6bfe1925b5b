import type { PageSide } from "./contract";
import type { Area, Line } from "./drawing";
import { colour, STYLE, sessionColour, sideColour } from "./style";

/** Style of a line; lengths in CSS pixels. */
export interface Look {
  readonly colour: string;
  readonly width: number;
  readonly dash: readonly number[];
  readonly opacity: number;
}

/** CSS pixels per point. */
const PX_PER_PT = 96 / 72;

/** A length of style.json in CSS pixels. */
export function pixels(points: number): number {
  return points * PX_PER_PT;
}

/** Number of compared sessions and the sides shown; determines the meaning of colour and dash. */
export interface Scheme {
  readonly sessions: number;
  readonly sides: readonly PageSide[];
}

/** Style of a line. One session: colour and dash mark the side. Several: colour marks the session, dash the side, or the session too if one side is shown. */
export function lineLook(line: Line, scheme: Scheme): Look {
  const widths = STYLE.lines_pt;
  switch (line.role) {
    case "cycle":
      return { ...sideLook(line, scheme), width: pixels(widths.cycle), opacity: STYLE.cycle_opacity };
    case "mean":
    case "main":
      return { ...mainLook(line, scheme), width: pixels(widths.mean), opacity: 1 };
    case "predicted":
      return { ...mainLook(line, scheme), width: pixels(widths.mean), dash: predictedDash(), opacity: 1 };
    case "measured":
      return { colour: colour("measured"), width: pixels(widths.axis), dash: sideDash(line.side), opacity: 1 };
    case "limit":
      return { colour: colour("quiet"), width: pixels(widths.zero), dash: [2, 3], opacity: 1 };
    case "infeasible":
      return { colour: colour("infeasible"), width: pixels(widths.infeasible), dash: [], opacity: 1 };
  }
}

/** Colour and opacity of an area. */
export function areaLook(area: Area, scheme: Scheme): { readonly colour: string; readonly opacity: number } {
  if (area.kind === "band") {
    return { colour: colour("band"), opacity: STYLE.band.opacity };
  }
  return { colour: sideLook(area, scheme).colour, opacity: STYLE.uncertainty_opacity };
}

/** Colour and dash for one side of one session. */
export function sideLook(
  item: { readonly side: PageSide | null; readonly session: number },
  scheme: Scheme,
): { readonly colour: string; readonly dash: readonly number[] } {
  if (scheme.sessions === 1) {
    return { colour: sideColour(item.side), dash: sideDash(item.side) };
  }
  const own = STYLE.sessions[item.session % STYLE.sessions.length]?.dash ?? [];
  const dash = scheme.sides.length === 1 ? own.map(scaled) : sideDash(item.side);
  return { colour: sessionColour(item.session), dash };
}

/** The first main line of a side has the style of the side; others differ by dash and, without a side, by colour. */
function mainLook(line: Line, scheme: Scheme): { readonly colour: string; readonly dash: readonly number[] } {
  const own = sideLook(line, scheme);
  if (line.variant === 0) {
    return own;
  }
  const dash = (VARIANT_DASHES[(line.variant - 1) % VARIANT_DASHES.length] ?? []).map(scaled);
  const free = line.side === null && scheme.sessions === 1;
  return { colour: free ? sessionColour(line.variant - 1) : own.colour, dash };
}

/** Dashes of the second, third, ... main line of a side, in multiples of the width of a mean line. */
const VARIANT_DASHES: readonly (readonly number[])[] = [
  [5, 1.5],
  [1, 1.3],
  [5, 1.3, 1, 1.3],
];

/** Dots of curves that rest on predicted ground forces while others were measured, in multiples of the width of a mean line. */
const PREDICTED_DASH: readonly number[] = [1, 1];

/** The same in CSS pixels. */
export function predictedDash(): number[] {
  return PREDICTED_DASH.map(scaled);
}

function sideDash(side: PageSide | null): number[] {
  return side === "l" ? STYLE.left.dash.map(scaled) : [];
}

/** Converts dashes from multiples of the width of a mean line to CSS pixels. */
function scaled(length: number): number {
  return length * pixels(STYLE.lines_pt.mean);
}
