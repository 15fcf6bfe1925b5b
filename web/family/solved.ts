// A walk that the command has solved, read from its result folder.

import { POINTS, QUANTITIES, type Quantity, sampleShares, type Walk } from "../src/family";

/** Files of a result folder by name. */
export type Results = ReadonlyMap<string, Uint8Array>;
/** Outputs of the command that are read here. */
export const KEPT = ["clinical", "events", "reactions", "grf"];
/** Where the place of each joint is read. */
const PLACES: Record<string, string> = {
  shoulder: "arm_flex_r_on_humerus_r",
  hip: "hip_flexion_r_on_femur_r",
  knee: "knee_angle_r_on_tibia_r",
  ankle: "ankle_angle_r_on_calcn_r",
  ball: "mtp_angle_r_on_toes_r",
};

/** What is read of `summary.json`. */
interface Summary {
  height_m: number;
  gravity_m_s2: number;
  walk: { speed_asked_m_s: number; step_length_m: number; leg_length_m: number };
}

/** A solved walk. */
export interface Solved {
  /** [m] */
  stepLength: number;
  /** [m] */
  leg: number;
  /** [m] */
  height: number;
  /** [m/s²] */
  gravity: number;
  /** Double support as a share of the cycle. */
  support: number;
  /** A curve at a share of the cycle of the right leg. */
  value(name: string, share: number): number;
}

type Columns = Map<string, Float64Array>;

function text(results: Results, name: string): string {
  const bytes = results.get(name);
  if (!bytes) {
    throw new Error(`${name} was not written`);
  }
  return new TextDecoder().decode(bytes);
}

/** The columns of a table whose rows begin after the line of names. */
function columns(lines: string[], separator: string): Columns {
  const names = (lines[0] ?? "").split(separator);
  const rows = lines.slice(1).filter((line) => line !== "");
  const cells = rows.map((line) => line.split(separator));
  return new Map(names.map((name, index) => [name, Float64Array.from(cells, (row) => Number(row[index]))]));
}

/** The columns of an OpenSim storage file. */
function storage(content: string): Columns {
  const lines = content.split("\n");
  return columns(lines.slice(lines.indexOf("endheader") + 1), "\t");
}

function column(of: Columns, name: string): Float64Array {
  const found = of.get(name);
  if (!found) {
    throw new Error(`no column ${name}`);
  }
  return found;
}

/** Times of an event of a side. */
function timesOf(events: string, side: string, event: string): number[] {
  const rows = events.split("\n").map((line) => line.split(","));
  return rows.filter((row) => row[0] === side && row[1] === event).map((row) => Number(row[2]));
}

/** Reads a result folder. */
export function readSolved(results: Results): Solved {
  const summary: Summary = JSON.parse(text(results, "summary.json"));
  const [clinical, reactions, grf] = [
    columns(text(results, "clinical.csv").split("\n"), ","),
    storage(text(results, "reactions.sto")),
    storage(text(results, "grf.mot")),
  ];
  const events = text(results, "events.csv");
  const [start = 0, end = 0] = timesOf(events, "r", "strike");
  const off = timesOf(events, "l", "off").find((time) => time > start) ?? Number.NaN;
  const time = column(clinical, "time");
  const step = (time[1] ?? 0) - (time[0] ?? 0);
  const { speed_asked_m_s: speed, leg_length_m: leg } = summary.walk;
  const at = (values: Float64Array, t: number): number => {
    const place = (t - (time[0] ?? 0)) / step;
    const index = Math.min(Math.floor(place), values.length - 2);
    const [a, b] = [values[index] ?? Number.NaN, values[index + 1] ?? Number.NaN];
    return a + (place - index) * (b - a);
  };
  const middle = (name: string): number => at(column(reactions, `${PLACES["hip"]}_in_ground_${name}`), start);
  const [origin] = [middle("px")];
  const value = (name: string, share: number): number => {
    const t = start + (share - Math.floor(share)) * (end - start);
    const forwards = origin + speed * (t - start);
    if (name === "pressure_x") {
      return share < 0.5 + (off - start) / (end - start) ? at(column(grf, "ground_force_r_px"), t) - forwards : 0;
    }
    const [, joint, axis] = name.match(/^(\w+)_([xy])$/) ?? [];
    const place = PLACES[joint ?? ""];
    if (place) {
      return at(column(reactions, `${place}_in_ground_p${axis}`), t) - (axis === "x" ? forwards : 0);
    }
    return at(column(clinical, `${name}_r`), t);
  };
  return {
    stepLength: summary.walk.step_length_m,
    leg,
    height: summary.height_m,
    gravity: summary.gravity_m_s2,
    support: (off - start) / (end - start),
    value,
  };
}

const scaled = ({ name, power }: Quantity, { leg, value }: Solved, share: number): number =>
  value(name, share) / leg ** power;

/** The walk as a family keeps it. */
export function sampled(solved: Solved): Walk {
  const shares = sampleShares(solved.support);
  return {
    support: solved.support,
    curves: QUANTITIES.map((quantity) => Float64Array.from(shares, (share) => scaled(quantity, solved, share))),
  };
}

/** Points of a curve from 0 to 100 % of the cycle, divided by the power of the leg length. */
export function scaledPoints(quantity: Quantity, solved: Solved): Float64Array {
  return Float64Array.from({ length: POINTS }, (_, index) => scaled(quantity, solved, index / (POINTS - 1)));
}
