import assert from "node:assert/strict";
import { test } from "node:test";
import { aimed, momentumOf, type Run, readRun, sceneOf, valueAt } from "../../src/walker";

/** A walk at 1.3 m/s whose trunk turns while it goes; the sphere is 0.2 m above the mass centre. */
function walk(balls: Run["bodies"] = []): Run {
  const times = [0, 1, 2, 3];
  const torso = {
    name: "walker/torso",
    side: null,
    capsules: [{ from: [0, 0.2] as const, to: [0, 0.2] as const, radius: 0.12 }],
    x: times.map((time) => 1.3 * time),
    y: times.map(() => 1.2),
    angle: times.map((time) => 0.1 * time),
    speed: times.map(() => 1.3),
  };
  return { times, bodies: [torso, ...balls], fall: undefined };
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
      }).map(([name, text]) => [name, new TextEncoder().encode(text)]),
    );
  const run = readRun(files([{ code: "figure.fell", message: "`walker` fell at 3 s" }]));
  const [torso] = run.bodies;
  assert.deepEqual(run.times, [0, 0.5]);
  assert.deepEqual(torso?.capsules, [{ from: [1, 2], to: [4, 5], radius: 0.1 }]);
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
