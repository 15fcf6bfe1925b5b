import type { PageEvent, PageSide, Session } from "../contract";
import { Timeline } from "./timeline";

/** Gait timing of a session, used to find the same phase in another session. */
export interface Gait {
  timeline: Timeline;
  /** Times of the foot strikes of each foot [s], ascending. */
  strikes: Record<PageSide, number[]>;
}

/** Gait timing of a session. */
export function gaitOf(session: Session): Gait {
  return {
    timeline: new Timeline(session.time),
    strikes: { r: strikesOf(session.events, "r"), l: strikesOf(session.events, "l") },
  };
}

/**
 * Time at which another session is in the same phase of gait as the main session at `time`: foot strikes of the same foot coincide.
 * Without a whole cycle in both sessions, the same time from the start.
 */
export function matchingTime(time: number, main: Gait, other: Gait): number {
  const side = (["r", "l"] as const).find((foot) => main.strikes[foot].length > 1 && other.strikes[foot].length > 1);
  if (side === undefined) {
    return Math.min(other.timeline.start + Math.max(0, time - main.timeline.start), other.timeline.end);
  }
  const phase = phaseAt(time, main.strikes[side]);
  const strikes = other.strikes[side];
  const direct = timeAt(phase, strikes);
  if (direct >= other.timeline.start && direct <= other.timeline.end) return direct;
  const cycles = strikes.length - 1;
  return timeAt(phase - Math.floor(phase / cycles) * cycles, strikes);
}

/** Cycle number from 0, with its fraction; beyond the recording, extrapolated with the duration of the first or last cycle. */
function phaseAt(time: number, strikes: number[]): number {
  const cycle = cycleBy(strikes, (start) => start <= time);
  const [start, end] = bounds(strikes, cycle);
  return cycle + (time - start) / (end - start);
}

/** The inverse of `phaseAt`. */
function timeAt(phase: number, strikes: number[]): number {
  const cycle = Math.min(Math.max(Math.floor(phase), 0), strikes.length - 2);
  const [start, end] = bounds(strikes, cycle);
  return start + (phase - cycle) * (end - start);
}

function cycleBy(strikes: number[], begun: (start: number) => boolean): number {
  let cycle = 0;
  while (cycle < strikes.length - 2 && begun(strikes[cycle + 1] as number)) cycle += 1;
  return cycle;
}

function bounds(strikes: number[], cycle: number): [number, number] {
  return [strikes[cycle] as number, strikes[cycle + 1] as number];
}

function strikesOf(events: PageEvent[], side: PageSide): number[] {
  const times = events.filter((event) => event.strike && event.side === side).map((event) => event.time_s);
  times.sort((a, b) => a - b);
  return times.filter((time, index) => index === 0 || time > (times[index - 1] as number));
}
