import assert from "node:assert/strict";
import { test } from "node:test";
import { aimed, momentumOf, type Run, readRun, sceneOf, valueAt } from "../../src/walker";

/** A walk at 1.3 m/s whose trunk turns while it goes; the sphere is 0.2 m above the mass centre. */
function walk(balls: Run["bodies"] = []): Run {
  const times = [0, 1, 2, 3];
  const torso = {
    name: "walker/torso",
    side: null,
    capsules: [{ from: [0, 0.2] as const, to: [0, 0.2] as const, radius: 0.12, sphere: true }],
    x: times.map((time) => 1.3 * time),
    y: times.map(() => 1.2),
    angle: times.map((time) => 0.1 * time),
    speed: times.map(() => 1.3),
  };
  return { times, bodies: [torso, ...balls], ground: [], fall: undefined };
}

test("a ball touches the trunk when it is meant to, from behind and from the front", () => {
  const run = walk();
  for (const faster of [3, -2]) {
    const ball = aimed(run, 1.5, faster);
    assert.ok(ball);
    const center = [1.95 - 0.2 * Math.sin(0.15), 1.2 + 0.2 * Math.cos(0.15)] as const;
    assert.ok(Math.abs(ball.y - center[1]) < 1e-12);
    assert.ok(Math.abs(ball.x + ball.speed * 1.5 - (center[0] - Math.sign(faster) * 0.22)) < 1e-12);
    assert.equal(ball.speed, 1.3 + faster);
  }
  assert.equal(aimed(run, 1.5, 0), undefined);
});

test("numbers between instants are linear, and the last stays", () => {
  const run = walk();
  assert.deepEqual(
    [0, 0.25, 2.9, 7].map((time) => Number(valueAt(run, run.times, time).toFixed(9))),
    [0, 0.25, 2.9, 3],
  );
});

test("every ball has a rail of its own, and balls pass each other", () => {
  const ball = { x: -4, y: 1.3, speed: 5 };
  const count = (text: string, word: string): number => text.split(word).length - 1;
  const counted = (balls: number): number[] => {
    const scene = sceneOf(Array.from({ length: balls }, () => ball));
    return ["[[body]]", "[[joint]]", "[[ignore]]"].map((word) => count(scene, word));
  };
  assert.deepEqual(
    [counted(0), counted(1), counted(3)],
    [
      [0, 0, 0],
      [1, 1, 0],
      [3, 3, 3],
    ],
  );
});

test("the momentum is that which the balls lost", () => {
  const ball = { name: "ball 1", side: null, capsules: [], x: [], y: [], angle: [], speed: [5, 5, 1, -1] };
  assert.equal(momentumOf(walk([ball])), 18);
  assert.equal(momentumOf(walk()), 0);
});

test("results are read by body and instant, with what is said of a fall", () => {
  const files = (findings: object[]): Map<string, Uint8Array> =>
    new Map(
      Object.entries({
        "shapes.json": JSON.stringify({
          bodies: [
            {
              name: "walker/torso",
              side: null,
              shapes: [{ from: [1, 2, 3], to: [4, 5, 6], radius: 0.1 }, { points: [] }],
            },
          ],
        }),
        "poses.csv": `time,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n0,walker/torso,1,2,0,${Math.cos(0.1)},0,0,${Math.sin(0.1)},1.3,0,0,0,0,0\n0.5,walker/torso,3,2,0,1,0,0,0,1.4,0,0,0,0,0\n`,
        "summary.json": JSON.stringify({ findings }),
        "contacts.csv": "time\n",
      }).map(([name, text]) => [name, new TextEncoder().encode(text)]),
    );
  const run = readRun(files([{ code: "figure.fell", message: "`walker` fell at 3 s" }]));
  const [torso] = run.bodies;
  assert.deepEqual(run.times, [0, 0.5]);
  assert.deepEqual(torso?.capsules, [{ from: [1, 2], to: [4, 5], radius: 0.1, sphere: false }]);
  assert.deepEqual(
    [torso?.x, torso?.speed, torso?.angle.map((a) => Number(a.toFixed(9)))],
    [
      [1, 3],
      [1.3, 1.4],
      [0.2, 0],
    ],
  );
  assert.equal(run.fall, "The walker fell at 3 s");
  assert.equal(readRun(files([])).fall, undefined);
});

test("forces of the ground are summed by leg, whichever body is first", () => {
  const body = (name: string, side: string | null): object => ({ name, side, shapes: [] });
  const bodies = [body("walker/torso", null), body("walker/calcn_r", "r"), body("walker/toes_r", "r")];
  const contact = (first: string, second: string, x: number, [fx, fy]: [number, number]): string =>
    `0.02,contact,${first},${second},${x},0,0,0,1,0,${fx},${fy},0,0,0,0,0`;
  const files = new Map(
    Object.entries({
      "shapes.json": JSON.stringify({ bodies }),
      "summary.json": JSON.stringify({ findings: [] }),
      "poses.csv": "head\n0,walker/torso,0,1,0,1,0,0,0,0\n0.02,walker/torso,0,1,0,1,0,0,0,0\n",
      "contacts.csv": [
        "head",
        contact("walker/calcn_r", "floor", 1, [-10, 300]),
        contact("floor", "walker/toes_r", 2, [-5, -100]),
        contact("walker/torso", "ball 1", 9, [50, 900]),
      ].join("\n"),
    }).map(([name, text]) => [name, new TextEncoder().encode(text)]),
  );
  const { ground } = readRun(files);
  const right = ground.find(({ side }) => side === "r");
  assert.deepEqual(
    [right?.up, right?.forward, right?.x],
    [
      [0, 400],
      [0, -5],
      [0, 1.25],
    ],
  );
  assert.ok(ground.filter(({ side }) => side !== "r").every(({ up }) => up.every((force) => force === 0)));
});
