import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Clock } from "../src/clock";

/** Requested animation frames, run by hand. */
let waiting: ((now: number) => void)[] = [];
globalThis.requestAnimationFrame = (draw) => waiting.push(draw);
const picture = (now_ms: number): void => {
  const draws = waiting;
  waiting = [];
  for (const draw of draws) {
    draw(now_ms);
  }
};
beforeEach(() => {
  waiting = [];
});

const clock = (): Clock => new Clock({ start_s: 2, step_s: 0.01, frames: 101 });

test("the time stays between the first and the last instant", () => {
  const one = clock();
  one.seek(99);
  assert.equal(one.time, 3);
  one.seek(-1);
  assert.equal(one.time, 2);
  one.seek(Number.NaN);
  assert.equal(one.time, 2);
});

test("a nudge moves from frame to frame and pauses", () => {
  const one = clock();
  one.play();
  one.seek(2.504);
  one.nudge(1);
  assert.equal(one.time.toFixed(6), "2.510000");
  assert.equal(one.playing, false);
});

test("playback follows real time and the speed, and loops", () => {
  const one = clock();
  one.speed = 0.5;
  one.play();
  picture(1000);
  picture(1100);
  assert.equal(one.time.toFixed(6), "2.050000");
  one.seek(2.99);
  picture(1200);
  assert.equal(one.time, 2);
});

test("play, pause, play within one picture request only one picture", () => {
  const one = clock();
  one.play();
  one.pause();
  one.play();
  assert.equal(waiting.length, 1);
  picture(1000);
  picture(1100);
  assert.equal(one.time.toFixed(6), "2.100000");
});

test("listeners are called at every change until they are removed", () => {
  const one = clock();
  let heard = 0;
  const leave = one.subscribe(() => heard++);
  one.seek(2.5);
  leave();
  one.seek(2.6);
  assert.equal(heard, 1);
});

test("a single instant does not play", () => {
  const one = new Clock({ start_s: 0, step_s: 0.01, frames: 1 });
  one.toggle();
  assert.equal(one.playing, false);
});
