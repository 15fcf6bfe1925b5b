// A walker who is struck by balls. He walks by his own torques (docs/PHYSICAL_WALK.md); the command simulates the whole scene anew for every ball.

import type { Files } from "./wasi";

/** Name of the scene's file. */
export const SCENE = "walker.toml";
/** Outputs that are drawn. */
export const KEPT = ["poses", "contacts"];
export const DURATION_S = 12;

const WALKER = "walker";
const FLOOR = "floor";
const TORSO = `${WALKER}/torso`;
/** Radius of the sphere in the trunk that balls hit, and of a ball [m]. */
const [TRUNK_M, BALL_M] = [0.12, 0.1];
const BALL_KG = 3;

/** A ball that is in flight from the beginning and hits the trunk. */
export interface Ball {
  /** Where it is at the beginning [m]. */
  x: number;
  y: number;
  /** Forward [m/s]. */
  speed: number;
}

/** The scene with balls that are elastic and pass each other. */
export function sceneOf(balls: readonly Ball[]): string {
  const body = ({ x, y, speed }: Ball, index: number): string => `
[[body]]
name = "ball ${index + 1}"
mass = ${BALL_KG}
position = [${x}, ${y}, 0]
shape = { kind = "sphere", radius = ${BALL_M}, material = "ball" }

[[joint]]
name = "rail ${index + 1}"
kind = "prismatic"
parent = "world"
child = "ball ${index + 1}"
at = [${x}, ${y}, 0]
axis = [1, 0, 0]
[joint.coordinate]
rate = ${speed}
`;
  const pairs = balls.flatMap((_, second) => balls.slice(0, second).map((_, first) => [first + 1, second + 1]));
  const ignored = pairs.map(([first, second]) => `\n[[ignore]]\npair = ["ball ${first}", "ball ${second}"]\n`);
  return `# A walker who is struck by balls, by his own torques (docs/PHYSICAL_WALK.md).
title = "Balls hit a walker"
step = 0.001
duration = ${DURATION_S}
output_rate = 50

[material.ball]
friction = 0
restitution = 1

[[obstacle]]
name = "${FLOOR}"
kind = "plane"

[[figure]]
name = "${WALKER}"
build = { table = "de-leva-male", mass = 75, height = 1.75 }
walk = { gait = "free" }
control = {}

[[figure.sphere]]
body = "torso"
at = [0, 0.28, 0]
radius = ${TRUNK_M}
${balls.map(body).join("")}${ignored.join("")}`;
}

/** A line with round ends in a body, seen from the side [m]. */
export interface Capsule {
  /** Spheres of a walker are no part of the figure: they are where it can touch balls and the ground. */
  sphere: boolean;
  from: readonly [x: number, y: number];
  to: readonly [x: number, y: number];
  radius: number;
}

/** A body that moves in the plane. */
export interface Moving {
  name: string;
  side: "r" | "l" | null;
  capsules: Capsule[];
  /** Place of the mass centre [m] and angle [rad] at each instant; the forward speed [m/s]. */
  x: number[];
  y: number[];
  angle: number[];
  speed: number[];
}

/** The force of the ground on a leg, or on the rest of the body of a walker who lies on it. */
export interface GroundForce {
  side: "r" | "l" | null;
  /** Centre of pressure [m] and force [N] at each instant; zero without contact. */
  x: number[];
  y: number[];
  forward: number[];
  up: number[];
}

/** A simulated walk. */
export interface Run {
  times: number[];
  bodies: Moving[];
  ground: GroundForce[];
  /** The program's message about a fall; none if the walker is up at the end. */
  fall: string | undefined;
}

interface Shapes {
  bodies: {
    name: string;
    side: "r" | "l" | null;
    shapes: { kind: string; from: number[]; to: number[]; radius: number }[];
  }[];
}

interface Summary {
  findings: { code: string; message: string }[];
}

function text(files: Files, name: string): string {
  const bytes = files.get(name);
  if (!bytes) {
    throw new Error(`${name} was not written`);
  }
  return new TextDecoder().decode(bytes);
}

/** Reads the result folder of a simulation. */
export function readRun(files: Files): Run {
  const shapes: Shapes = JSON.parse(text(files, "shapes.json"));
  const flat = ([x = 0, y = 0]: number[]): readonly [number, number] => [x, y];
  const moving = shapes.bodies.map(({ name, side, shapes }): Moving => {
    const round = shapes.filter(({ from, to }) => from && to);
    const capsules = round.map(({ from, to, radius }): Capsule => {
      return { from: flat(from), to: flat(to), radius, sphere: from.every((place, axis) => place === to[axis]) };
    });
    return { name, side, capsules, x: [], y: [], angle: [], speed: [] };
  });
  const bodies = new Map(moving.map((body) => [body.name, body]));
  const times: number[] = [];
  const lines = text(files, "poses.csv").trim().split("\n").slice(1);
  for (const line of lines) {
    const [time, name = "", px, py, , qw, , , qz, vx] = line.split(",");
    const body = bodies.get(name);
    if (times.at(-1) !== Number(time)) {
      times.push(Number(time));
    }
    body?.x.push(Number(px));
    body?.y.push(Number(py));
    body?.angle.push(2 * Math.atan2(Number(qz), Number(qw)));
    body?.speed.push(Number(vx));
  }
  const { findings }: Summary = JSON.parse(text(files, "summary.json"));
  const fell = findings.find(({ code }) => code === "figure.fell")?.message;
  const ground = groundForces(text(files, "contacts.csv"), times, bodies);
  return { times, bodies: moving, ground, fall: fell?.replaceAll("`", "").replace(WALKER, "The walker") };
}

/** Sums the contacts with the ground of each leg, and of the rest of the walker. */
function groundForces(contacts: string, times: readonly number[], bodies: ReadonlyMap<string, Moving>): GroundForce[] {
  const none = (): number[] => times.map(() => 0);
  const found = ([null, "r", "l"] as const).map(
    (side): GroundForce => ({ side, x: none(), y: none(), forward: none(), up: none() }),
  );
  const at = new Map(times.map((time, index) => [time, index]));
  for (const line of contacts.trim().split("\n").slice(1)) {
    const [time, , first = "", second = "", x, y, , , , , fx, fy] = line.split(",");
    // The force is the one on the first body.
    const [name, sign] = first === FLOOR ? [second, -1] : [first, 1];
    const index = at.get(Number(time));
    const force = found.find(({ side }) => side === bodies.get(name)?.side);
    if (!force || index === undefined || (first !== FLOOR && second !== FLOOR)) {
      continue;
    }
    const [before, up] = [force.up[index] ?? 0, sign * Number(fy)];
    const share = before + up > 0 ? up / (before + up) : 0;
    force.x[index] = (1 - share) * (force.x[index] ?? 0) + share * Number(x);
    force.y[index] = (1 - share) * (force.y[index] ?? 0) + share * Number(y);
    force.up[index] = before + up;
    force.forward[index] = (force.forward[index] ?? 0) + sign * Number(fx);
  }
  return found;
}

/** A number of a body between two instants. */
export function valueAt({ times }: Run, values: readonly number[], time: number): number {
  const last = times.length - 1;
  const step = (times[last] ?? 1) / last;
  const at = Math.min(Math.max(time / step, 0), last);
  const index = Math.min(Math.floor(at), last - 1);
  const [a, b] = [values[index] ?? 0, values[index + 1] ?? 0];
  return a + (at - index) * (b - a);
}

/** A ball that reaches the trunk at a time, so much faster than the walker [m/s]: negative from the front. */
export function aimed(run: Run, time: number, faster: number): Ball | undefined {
  const torso = run.bodies.find(({ name }) => name === TORSO);
  const sphere = torso?.capsules.find(({ radius }) => radius === TRUNK_M);
  if (!torso || !sphere || faster === 0) {
    return undefined;
  }
  const [x, y, angle, speed] = [torso.x, torso.y, torso.angle, torso.speed].map((of) => valueAt(run, of, time)) as [
    number,
    number,
    number,
    number,
  ];
  const [across, up] = sphere.from;
  const center = x + across * Math.cos(angle) - up * Math.sin(angle);
  const touching = center - Math.sign(faster) * (TRUNK_M + BALL_M);
  const fast = speed + faster;
  return { x: touching - fast * time, y: y + across * Math.sin(angle) + up * Math.cos(angle), speed: fast };
}

/** Impulse of the balls on the walker, forward [N.s]. */
export function momentumOf(run: Run): number {
  const balls = run.bodies.filter(({ name }) => !name.startsWith(`${WALKER}/`));
  return balls.reduce((sum, { speed }) => sum + BALL_KG * ((speed[0] ?? 0) - (speed.at(-1) ?? 0)), 0);
}
