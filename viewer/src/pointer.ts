import type uPlot from "uplot";
import type { Context } from "./context";
import type { PageSide } from "./contract";
import type { Drawing } from "./drawing";
import { nearestCycle, timeAt } from "./phase";

/** Lets the pointer set the clock: by hovering while playback is paused, by pressing and dragging always. */
export function followPointer(chart: uPlot, drawing: Drawing, context: Context): void {
  const { over } = chart;
  const seek = (event: PointerEvent): void => {
    const box = over.getBoundingClientRect();
    const time = timeUnder(chart, drawing, context, event.clientX - box.left, event.clientY - box.top);
    if (time !== null) {
      context.clock.seek(time);
    }
  };
  over.addEventListener("pointerdown", (event) => {
    context.clock.pause();
    over.setPointerCapture(event.pointerId);
    seek(event);
  });
  over.addEventListener("pointermove", (event) => {
    const hovers = event.pointerType === "mouse" && !context.clock.playing;
    if (hovers || event.buttons > 0) {
      seek(event);
    }
  });
}

/** Time at a position in a plot; over the gait cycle, a time in the cycle of the nearest curve. */
function timeUnder(chart: uPlot, drawing: Drawing, context: Context, left: number, top: number): number | null {
  const x = Math.min(Math.max(chart.posToVal(left, "x"), drawing.x[0]), drawing.x[1]);
  if (drawing.axis === "time") {
    return x;
  }
  const nearest = nearestLine(chart, drawing, Math.round(x), top);
  if (!nearest) {
    return null;
  }
  const { cycles } = context.first;
  const own = cycles.find((cycle) => cycle.side === nearest.side && cycle.number === nearest.cycle);
  const cycle = own ?? nearestCycle(cycles, nearest.side, context.clock.time);
  return cycle ? timeAt(cycle, x) : null;
}

/** The first session's curve nearest to a height at a percentage; a mean belongs to no particular cycle. */
function nearestLine(
  chart: uPlot,
  drawing: Drawing,
  percent: number,
  top: number,
): { readonly side: PageSide; readonly cycle: number | null } | null {
  let nearest: { side: PageSide; cycle: number | null } | null = null;
  let shortest = Number.POSITIVE_INFINITY;
  for (const line of drawing.lines) {
    const value = line.y[percent];
    const fits = line.session === 0 && line.side !== null && value !== undefined && Number.isFinite(value);
    const distance = fits ? Math.abs(chart.valToPos(value, "y") - top) : Number.POSITIVE_INFINITY;
    if (distance < shortest && line.side !== null) {
      nearest = { side: line.side, cycle: line.cycle };
      shortest = distance;
    }
  }
  return nearest;
}
