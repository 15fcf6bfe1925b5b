import type { PageCycle, PageSide } from "./contract";

/** The cycle of a side that contains a time. */
export function cycleAt(cycles: readonly PageCycle[], side: PageSide, time: number): PageCycle | null {
  return cycles.find((cycle) => cycle.side === side && cycle.start_s <= time && time <= cycle.end_s) ?? null;
}

/** The cycle of a side that contains a time, or else the nearest one. */
export function nearestCycle(cycles: readonly PageCycle[], side: PageSide, time: number): PageCycle | null {
  let nearest: PageCycle | null = null;
  let shortest = Number.POSITIVE_INFINITY;
  for (const cycle of cycles) {
    const distance = Math.max(cycle.start_s - time, time - cycle.end_s, 0);
    if (cycle.side === side && distance < shortest) {
      nearest = cycle;
      shortest = distance;
    }
  }
  return nearest;
}

/** Position of a time in a cycle [%]. */
export function percentAt(cycle: PageCycle, time: number): number {
  return (100 * (time - cycle.start_s)) / (cycle.end_s - cycle.start_s);
}

/** Time at a percentage of a cycle [s]. */
export function timeAt(cycle: PageCycle, percent: number): number {
  return cycle.start_s + (percent / 100) * (cycle.end_s - cycle.start_s);
}
