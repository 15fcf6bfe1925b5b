import type { PageCycle, PageSide, Session } from "./contract";
import type { Drawing, Line } from "./drawing";
import { cycleAt, percentAt } from "./phase";

/** Position and value of a side in a drawing at a time. */
export interface Reading {
  readonly side: PageSide | null;
  readonly variant: number;
  /** Position on the horizontal axis; `null` while the side is in no cycle. */
  readonly x: number | null;
  readonly value: number | undefined;
}

/** Values of the first session at a time: one reading per side; over time, one per main line. */
export function readings(drawing: Drawing, session: Session, time: number): Reading[] {
  const lines = drawing.lines.filter((line) => line.session === 0);
  if (drawing.axis === "cycle") {
    const sides = (["r", "l"] as const).filter((side) => lines.some((line) => line.side === side));
    return sides.map((side) => cycleReading(lines, session.cycles, side, time));
  }
  const frame = Math.round((time - session.time.start_s) / session.time.step_s);
  const main = lines.filter((line) => line.role === "main");
  return main.map(({ side, variant, y }) => {
    const predicted = lines.find((one) => one.role === "predicted" && one.side === side && one.variant === variant);
    const value = Number.isFinite(y[frame] ?? Number.NaN) ? y[frame] : (predicted?.y[frame] ?? y[frame]);
    return { side, variant, x: time, value };
  });
}

function cycleReading(lines: readonly Line[], cycles: readonly PageCycle[], side: PageSide, time: number): Reading {
  const cycle = cycleAt(cycles, side, time);
  if (!cycle) {
    return { side, variant: 0, x: null, value: undefined };
  }
  const x = percentAt(cycle, time);
  const own = lines.find((line) => line.role === "cycle" && line.side === side && line.cycle === cycle.number);
  const mean = lines.find((line) => line.role === "mean" && line.side === side);
  return { side, variant: 0, x, value: (own ?? mean)?.y[Math.round(x)] };
}
