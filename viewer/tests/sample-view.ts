// An invented walk for tests and for viewing: joint angles as sums of a few cosines, without physics.
import { Quaternion, Vector3 } from "three";
import type {
  Page,
  PageEvent,
  PageSide,
  Series,
  Session,
  View,
  ViewBody,
  ViewForce,
  ViewTorque,
} from "../src/contract";
import { FORMAT } from "../src/contract";

const HIGHEST = 65534;
const CYCLE_S = 1.1;
const SPEED = 1.25;
const STEP_S = 0.01;
const FLOOR_M = 0;
const WEIGHT_N = 735;
const THIGH = 0.42;
const SHANK = 0.42;
const HALF_PELVIS = 0.085;
const STANCE = 0.62;

/** Stores series like a page's block, and reads them back like the page. */
export class SampleNumbers {
  readonly codes: number[] = [];

  add(values: number[]): Series {
    const finite = values.filter((value) => Number.isFinite(value));
    const low = finite.length > 0 ? Math.min(...finite) : 0;
    const step = finite.length > 0 ? (Math.max(...finite) - low) / HIGHEST : 0;
    const at = this.codes.length;
    for (const value of values) {
      this.codes.push(!Number.isFinite(value) ? HIGHEST + 1 : step > 0 ? Math.round((value - low) / step) : 0);
    }
    return { at, count: values.length, low, step };
  }

  read(series: Series): Float64Array {
    return Float64Array.from(this.codes.slice(series.at, series.at + series.count), (code) =>
      code > HIGHEST ? Number.NaN : series.low + series.step * code,
    );
  }
}

/** Gait of a sample. */
export interface SampleWalk {
  name: string;
  seconds: number;
  cycle_s: number;
  speed: number;
  /** Factor of the joint angles. */
  stride: number;
}

export const ORDINARY: SampleWalk = { name: "sample", seconds: 4, cycle_s: CYCLE_S, speed: SPEED, stride: 1 };

/** A page with one session per walk. */
export function samplePage(numbers: SampleNumbers, walks: SampleWalk[] = [ORDINARY]): Page {
  return {
    format: FORMAT,
    program: "0",
    title: "Sample",
    sessions: walks.map((walk) => sampleSession(numbers, walk)),
  };
}

function sampleSession(numbers: SampleNumbers, walk: SampleWalk): Session {
  const frames = Math.round(walk.seconds / STEP_S) + 1;
  return {
    name: walk.name,
    data: null,
    outcome: [],
    glance: null,
    header: [],
    source: "simulated",
    time: { start_s: 0, step_s: STEP_S, frames },
    events: eventsOf(walk),
    cycles: [],
    groups: [],
    machines: [],
    tables: [],
    quality: { facts: [], groups: [], tables: [], findings: [], assumptions: [] },
    feasibility: null,
    view: viewOf(numbers, walk, frames),
    missing: [],
  };
}

function eventsOf(walk: SampleWalk): PageEvent[] {
  const events: PageEvent[] = [];
  for (const side of ["r", "l"] as const) {
    const first = side === "r" ? 0 : walk.cycle_s / 2;
    for (let time = first; time < walk.seconds; time += walk.cycle_s) {
      events.push({ side, strike: true, time_s: time });
      if (time + STANCE * walk.cycle_s < walk.seconds) {
        events.push({ side, strike: false, time_s: time + STANCE * walk.cycle_s });
      }
    }
  }
  return events.sort((a, b) => a.time_s - b.time_s);
}

/** Hip and knee flexion, dorsiflexion and shoulder angle at a fraction of the cycle [rad]. */
function angles(part: number, stride: number): { hip: number; knee: number; ankle: number; shoulder: number } {
  const wave = (amplitude: number, times: number, shift: number): number =>
    amplitude * Math.cos(2 * Math.PI * (times * part - shift));
  const degree = (Math.PI / 180) * stride;
  return {
    hip: (8 + wave(22, 1, -0.06) + wave(3, 2, 0.1)) * degree,
    knee: (24 + wave(21, 1, 0.72) + wave(17, 2, 0.44)) * degree,
    ankle: (wave(6, 1, 0.4) + wave(9, 2, 0.85)) * degree,
    shoulder: (-5 - wave(20, 1, 0)) * degree,
  };
}

interface Pose {
  place: Vector3;
  turn: Quaternion;
}

/** Body poses at an instant, with the pelvis at height 0. */
function poses(time: number, walk: SampleWalk): Map<string, Pose> {
  const out = new Map<string, Pose>();
  const root = { place: new Vector3(walk.speed * time, 0, 0), turn: new Quaternion() };
  out.set("pelvis", root);
  out.set("torso", child(root, new Vector3(0, 0.08, 0), -0.04));
  for (const side of ["r", "l"] as const) {
    const sign = side === "r" ? 1 : -1;
    const { hip, knee, ankle, shoulder } = angles(time / walk.cycle_s + (side === "r" ? 0 : 0.5), walk.stride);
    const thigh = child(root, new Vector3(0, -0.02, sign * HALF_PELVIS), hip);
    const shank = child(thigh, new Vector3(0, -THIGH, 0), -knee);
    const foot = child(shank, new Vector3(0, -SHANK, 0), ankle);
    const arm = child(root, new Vector3(0, 0.5, sign * 0.19), shoulder);
    out.set(`thigh_${side}`, thigh).set(`shank_${side}`, shank).set(`foot_${side}`, foot);
    out.set(`arm_${side}`, arm).set(`forearm_${side}`, child(arm, new Vector3(0, -0.29, 0), 0.35));
  }
  return out;
}

function child(parent: Pose, offset: Vector3, angle: number): Pose {
  const turn = parent.turn.clone().multiply(new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), angle));
  return { place: offset.clone().applyQuaternion(parent.turn).add(parent.place), turn };
}

const SOLE: [number, number, number][] = [
  [-0.05, -0.08, 0.03],
  [-0.05, -0.08, -0.03],
  [0.15, -0.08, 0.04],
  [0.15, -0.08, -0.04],
];

function grounded(time: number, walk: SampleWalk): Map<string, Pose> {
  const out = poses(time, walk);
  const feet = [out.get("foot_r"), out.get("foot_l")] as Pose[];
  const lowest = Math.min(
    ...feet.flatMap(({ place, turn }) => SOLE.map((point) => new Vector3(...point).applyQuaternion(turn).add(place).y)),
  );
  for (const pose of out.values()) {
    pose.place.y += FLOOR_M - lowest;
  }
  return out;
}

const SHAPES: Record<string, ViewBody["shapes"]> = {
  pelvis: [{ kind: "capsule", from: [0, 0.03, -0.07], to: [0, 0.03, 0.07], radius: 0.1 }],
  torso: [
    { kind: "capsule", from: [0, 0.1, 0], to: [0, 0.36, 0], radius: 0.13 },
    { kind: "capsule", from: [0.02, 0.62, 0], to: [0.02, 0.68, 0], radius: 0.09 },
  ],
  thigh: [{ kind: "capsule", from: [0, -0.02, 0], to: [0, -THIGH, 0], radius: 0.065 }],
  shank: [{ kind: "capsule", from: [0, -0.01, 0], to: [0, -SHANK, 0], radius: 0.045 }],
  foot: [{ kind: "capsule", from: [-0.03, -0.05, 0], to: [0.16, -0.055, 0], radius: 0.028 }],
  arm: [{ kind: "capsule", from: [0, 0, 0], to: [0, -0.29, 0], radius: 0.04 }],
  forearm: [{ kind: "capsule", from: [0, 0, 0], to: [0, -0.34, 0], radius: 0.033 }],
};

function viewOf(numbers: SampleNumbers, walk: SampleWalk, frames: number): View {
  const times = Array.from({ length: frames }, (_, index) => index * STEP_S);
  const all = times.map((time) => grounded(time, walk));
  const names = [...(all[0]?.keys() ?? [])];
  const series = (name: string, of: (pose: Pose) => number): Series =>
    numbers.add(all.map((pose) => of(pose.get(name) as Pose)));
  return {
    bodies: names.map((name) => ({
      name,
      side: sideOf(name),
      shapes: SHAPES[name.split("_")[0] as string] ?? [],
      position: [series(name, (p) => p.place.x), series(name, (p) => p.place.y), series(name, (p) => p.place.z)],
      rotation: [
        series(name, (p) => p.turn.x),
        series(name, (p) => p.turn.y),
        series(name, (p) => p.turn.z),
        series(name, (p) => p.turn.w),
      ],
    })),
    fixed: [],
    plates: [0.2, 0.85].map((x, index) => ({
      name: `${index + 1}`,
      corners: [
        [x, FLOOR_M, -0.25],
        [x + 0.6, FLOOR_M, -0.25],
        [x + 0.6, FLOOR_M, 0.25],
        [x, FLOOR_M, 0.25],
      ],
    })),
    forces: (["r", "l"] as const).map((side) => force(numbers, walk, side, times, all)),
    torques: (["r", "l"] as const).flatMap((side) => torques(numbers, walk, side, times, names)),
    contacts: (["r", "l"] as const).flatMap((side) =>
      SOLE.map((place) => ({ body: names.indexOf(`foot_${side}`), place, side })),
    ),
    floor_m: FLOOR_M,
    weight_n: WEIGHT_N,
  };
}

function sideOf(name: string): PageSide | null {
  if (name.endsWith("_r")) {
    return "r";
  }
  return name.endsWith("_l") ? "l" : null;
}

/** A force with two peaks whose centre of pressure moves from heel to toe. */
function force(
  numbers: SampleNumbers,
  walk: SampleWalk,
  side: PageSide,
  times: number[],
  all: Map<string, Pose>[],
): ViewForce {
  const part = times.map((time) => (((time / walk.cycle_s + (side === "r" ? 0 : 0.5)) % 1) + 1) % 1);
  const stance = part.map((p) => (p < STANCE ? p / STANCE : Number.NaN));
  const places = all.map((pose) => (pose.get(`foot_${side}`) as Pose).place);
  const rise = (s: number): number => Math.sin(Math.PI * s) ** 0.6;
  const vertical = stance.map((s) => WEIGHT_N * rise(s) * (1 + 0.12 * Math.cos(4 * Math.PI * (s - 0.25))));
  return {
    name: side === "r" ? "right" : "left",
    side,
    role: "main",
    point: [
      numbers.add(stance.map((s, index) => (places[index]?.x ?? 0) - 0.05 + 0.2 * s)),
      numbers.add(stance.map((s) => (Number.isFinite(s) ? FLOOR_M : Number.NaN))),
      numbers.add(stance.map((s, index) => (Number.isFinite(s) ? (places[index]?.z ?? 0) : Number.NaN))),
    ],
    force: [
      numbers.add(vertical.map((y, index) => -0.2 * Math.cos(Math.PI * (stance[index] ?? 0)) * y)),
      numbers.add(vertical),
      numbers.add(vertical.map((y) => (side === "r" ? -0.04 : 0.04) * y)),
    ],
  };
}

function torques(
  numbers: SampleNumbers,
  walk: SampleWalk,
  side: PageSide,
  times: number[],
  names: string[],
): ViewTorque[] {
  return (["thigh", "shank", "foot"] as const).map((body, joint) => ({
    name: `${side} ${body}`,
    side,
    body: names.indexOf(`${body}_${side}`),
    center: [0, 0, 0],
    axis: [0, 0, joint === 1 ? 1 : -1],
    values: numbers.add(
      times.map((time) => Math.sin(2 * Math.PI * (time / walk.cycle_s + (side === "r" ? 0.05 : 0.55) - 0.2 * joint))),
    ),
    panel: null,
  }));
}
