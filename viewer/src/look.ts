import type { PageSide } from "./contract";
import type { Area, Line } from "./drawing";
import { colour, STYLE, sessionColour, sideColour } from "./style";

/** How a line is drawn; lengths in CSS pixels. */
export interface Look {
  readonly colour: string;
  readonly width: number;
  readonly dash: readonly number[];
  readonly opacity: number;
}

/** CSS pixels in a point. */
const PX_PER_PT = 96 / 72;

/** A length of style.json in CSS pixels. */
export function pixels(points: number): number {
  return points * PX_PER_PT;
}

/** How many sessions are compared and which sides are shown: decides on what colour and dash stand for. */
export interface Scheme {
  readonly sessions: number;
  readonly sides: readonly PageSide[];
}

/** Looks of a line. One session: colour and dash say the side. Several: colour says the session, dash the side or, of one side, the session. */
export function lineLook(line: Line, scheme: Scheme): Look {
  const widths = STYLE.lines_pt;
  switch (line.role) {
    case "cycle":
      return { ...sideLook(line, scheme), width: pixels(widths.cycle), opacity: STYLE.cycle_opacity };
    case "mean":
    case "main":
      return { ...mainLook(line, scheme), width: pixels(widths.mean), opacity: 1 };
    case "measured":
      return { colour: colour("measured"), width: pixels(widths.axis), dash: sideDash(line.side), opacity: 1 };
    case "limit":
      return { colour: colour("quiet"), width: pixels(widths.zero), dash: [2, 3], opacity: 1 };
    case "infeasible":
      return { colour: colour("infeasible"), width: pixels(widths.infeasible), dash: [], opacity: 1 };
  }
}

/** Colour and opacity of a surface. */
export function areaLook(area: Area, scheme: Scheme): { readonly colour: string; readonly opacity: number } {
  if (area.kind === "band") {
    return { colour: colour("band"), opacity: STYLE.band.opacity };
  }
  return { colour: sideLook(area, scheme).colour, opacity: STYLE.uncertainty_opacity };
}

/** Colour and dash of what belongs to a side of a session. */
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

/** Looks of the first main line of a side are those of the side; others differ by dash and, without a side, by colour. */
function mainLook(line: Line, scheme: Scheme): { readonly colour: string; readonly dash: readonly number[] } {
  const own = sideLook(line, scheme);
  if (line.variant === 0) {
    return own;
  }
  const dash = (VARIANT_DASHES[(line.variant - 1) % VARIANT_DASHES.length] ?? []).map(scaled);
  const free = line.side === null && scheme.sessions === 1;
  return { colour: free ? sessionColour(line.variant - 1) : own.colour, dash };
}

/** Dashes of the second, third, ... main line of a side, in widths of a mean's line. */
const VARIANT_DASHES: readonly (readonly number[])[] = [
  [5, 1.5],
  [1, 1.3],
  [5, 1.3, 1, 1.3],
];

function sideDash(side: PageSide | null): number[] {
  return side === "l" ? STYLE.left.dash.map(scaled) : [];
}

/** Dashes are given in widths of a mean's line. */
function scaled(length: number): number {
  return length * pixels(STYLE.lines_pt.mean);
}
