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
      return { ...sideLook(line, scheme), width: pixels(widths.mean), opacity: 1 };
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

function sideDash(side: PageSide | null): number[] {
  return side === "l" ? STYLE.left.dash.map(scaled) : [];
}

/** Dashes are given in widths of a mean's line. */
function scaled(length: number): number {
  return length * pixels(STYLE.lines_pt.mean);
}
