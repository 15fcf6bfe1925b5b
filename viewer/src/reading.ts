import type { PageCycle, PageSide, Session } from "./contract";
import type { Drawing, Line } from "./drawing";
import { cycleAt, percentAt } from "./phase";

/** Where a side is in a drawing at a time, and its value there. */
export interface Reading {
  readonly side: PageSide | null;
  /** On the drawing's horizontal axis; nothing while the side is in no cycle. */
  readonly x: number | null;
  readonly value: number | undefined;
}

/** What a drawing says of the first session at a time: a reading for each side, or one of what has no side. */
export function readings(drawing: Drawing, session: Session, time: number): Reading[] {
  const lines = drawing.lines.filter((line) => line.session === 0);
  const sides = sidesOf(lines);
  if (drawing.axis === "cycle") {
    return sides.flatMap((side) => (side === null ? [] : [cycleReading(lines, session.cycles, side, time)]));
  }
  const frame = Math.round((time - session.time.start_s) / session.time.step_s);
  return sides.map((side) => {
    const line = lines.find((one) => one.side === side && one.role === "main");
    return { side, x: time, value: line?.y[frame] };
  });
}

function cycleReading(lines: readonly Line[], cycles: readonly PageCycle[], side: PageSide, time: number): Reading {
  const cycle = cycleAt(cycles, side, time);
  if (!cycle) {
    return { side, x: null, value: undefined };
  }
  const x = percentAt(cycle, time);
  const own = lines.find((line) => line.role === "cycle" && line.side === side && line.cycle === cycle.number);
  const mean = lines.find((line) => line.role === "mean" && line.side === side);
  return { side, x, value: (own ?? mean)?.y[Math.round(x)] };
}

/** Sides of the lines that can be read: right, left, none. */
function sidesOf(lines: readonly Line[]): (PageSide | null)[] {
  const sides: (PageSide | null)[] = ["r", "l", null];
  return sides.filter((side) => lines.some((line) => line.side === side && READABLE.includes(line.role)));
}

const READABLE = ["cycle", "mean", "main"];
