import assert from "node:assert/strict";
import { test } from "node:test";
import { Color, type InstancedMesh, type Material, Matrix4, type Mesh, Quaternion, Vector3 } from "three";
import type { PageSide, View, ViewBody, ViewShape } from "../src/contract";
import { arrowParts, arrowScale, dashParts } from "../src/view3d/arrow";
import { directionOf, fittingDistance } from "../src/view3d/camera";
import { extentOf, Framing } from "../src/view3d/extent";
import { Figure } from "../src/view3d/figure";
import { peakOf } from "../src/view3d/forces";
import { Motion } from "../src/view3d/motion";
import { activationColor, Muscles, thickness } from "../src/view3d/muscles";
import { Obstacles } from "../src/view3d/obstacles";
import { palette } from "../src/view3d/palette";
import { filled, Path, smoothed } from "../src/view3d/path";
import { type Gait, gaitOf, matchingTime } from "../src/view3d/phase";
import { marks } from "../src/view3d/ruler";
import { sample, Timeline } from "../src/view3d/timeline";
import { togglesOf } from "../src/view3d/toggles";
import { arcAngle } from "../src/view3d/torques";
import { contactStart, type Place, rings, trailPoints } from "../src/view3d/trail";
import { ORDINARY, SampleNumbers, samplePage } from "./sample-view";

const NONE = Number.NaN;

function close(found: number, wanted: number, tolerance = 1e-9): void {
  assert.ok(Math.abs(found - wanted) <= tolerance, `${found} is not ${wanted}`);
}

function gait(start: number, end: number, right: number[], left: number[] = []): Gait {
  const strikes: Record<PageSide, number[]> = { r: right, l: left };
  return {
    timeline: new Timeline({ start_s: start, step_s: 0.01, frames: Math.round((end - start) / 0.01) + 1 }),
    strikes,
  };
}

test("frames are interpolated, and constant beyond the ends", () => {
  const timeline = new Timeline({ start_s: 2, step_s: 0.01, frames: 101 });
  close(timeline.end, 3);
  close(timeline.frameAt(2.005), 0.5);
  close(timeline.frameAt(0), 0);
  close(timeline.frameAt(9), 100);
});

test("a number next to a gap is NaN, a number on a frame is exact", () => {
  const values = Float64Array.of(1, 3, NONE, 5);
  close(sample(values, 0.25), 1.5);
  close(sample(values, 1), 3);
  assert.ok(Number.isNaN(sample(values, 1.5)));
  assert.ok(Number.isNaN(sample(values, 2)));
  close(sample(values, 3), 5);
});

test("poses are interpolated along great arcs and missing in gaps", () => {
  const numbers = new SampleNumbers();
  const half = Math.SQRT1_2;
  const of = (...values: number[]) => numbers.add(values);
  const motion = new Motion(
    {
      name: "b",
      side: null,
      shapes: [],
      position: [of(0, 2, 4), of(1, 1, NONE), of(0, 0, 0)],
      rotation: [of(0, 0, 0), of(0, 0, 0), of(0, half, 1), of(1, half, 0)],
    },
    numbers,
  );
  const place = new Vector3();
  const turn = new Quaternion();
  assert.equal(motion.at(0.5, place, turn), true);
  close(place.x, 1, 1e-4);
  close(2 * Math.atan2(turn.z, turn.w), Math.PI / 4, 1e-4);
  assert.equal(motion.at(1.5, place, turn), false);
});

test("a pose half way between the recorded and the corrected motion is equally far from both", () => {
  const numbers = new SampleNumbers();
  const half = Math.SQRT1_2;
  const of = (value: number) => numbers.add([value, value]);
  const pose = (x: number, z: number, w: number) => ({
    position: [of(x), of(0), of(0)] as ViewBody["position"],
    rotation: [of(0), of(0), of(z), of(w)] as ViewBody["rotation"],
  });
  const changed = { name: "b", side: null, shapes: [], ...pose(4, half, half), recorded: pose(0, 0, 1) };
  const motion = new Motion(changed, numbers);
  const place = new Vector3();
  const turn = new Quaternion();
  for (const corrected of [1, 0.25, 0]) {
    assert.equal(motion.at(0.5, place, turn, corrected), true);
    close(place.x, 4 * corrected, 1e-3);
    close(2 * Math.atan2(turn.z, turn.w), (corrected * Math.PI) / 2, 1e-3);
  }
});

test("at the same phase, foot strikes of the same foot coincide", () => {
  const main = gait(0, 4, [0.5, 1.5, 2.5]);
  const slow = gait(0, 9, [1, 3, 5, 7]);
  close(matchingTime(0.5, main, slow), 1);
  close(matchingTime(1.0, main, slow), 2);
  close(matchingTime(2.5, main, slow), 5);
  close(matchingTime(3.0, main, slow), 6);
});

test("beyond its recording a ghost continues from its first cycle", () => {
  const main = gait(0, 6, [0.5, 1.5, 2.5, 3.5, 4.5]);
  const short = gait(0, 2.2, [0.1, 1.1, 2.1]);
  close(matchingTime(3.0, main, short), 0.6);
  const found = matchingTime(0.1, main, short);
  assert.ok(found >= 0 && found <= 2.2, `${found}`);
});

test("a session compared with itself coincides with itself at all times", () => {
  const [session] = samplePage(new SampleNumbers()).sessions;
  assert.ok(session);
  const own = gaitOf(session);
  for (const time of [0, 0.3, 1.7, 3.99]) {
    close(matchingTime(time, own, own), time);
  }
});

test("without cycles the time from the start is equal", () => {
  const main = gait(2, 4, []);
  const other = gait(7, 8, [7.1, 7.9]);
  close(matchingTime(2.5, main, other), 7.5);
  close(matchingTime(3.9, main, other), 8);
});

test("the left foot defines the phase if only it has cycles in both", () => {
  close(matchingTime(1, gait(0, 3, [0.2], [1, 2]), gait(0, 3, [0, 1], [0.5, 1.5])), 0.5);
});

test("one body weight is an arrow of 0.55 heights unless the peak would leave the picture", () => {
  close(arrowScale(1.8, 1.2), 0.99);
  close(arrowScale(1.8, 0), 0.99);
  close(arrowScale(2, 4) * 4, 1.9);
});

test("an impact does not shrink the other arrows", () => {
  const numbers = new SampleNumbers();
  const view = samplePage(numbers).sessions[0]?.view;
  assert.ok(view?.forces[0]);
  const ordinary = peakOf(view, numbers);
  close(ordinary, 0.98, 0.02);
  const impact = [...numbers.read(view.forces[0].force[1])];
  impact[10] = 1e5;
  view.forces[0].force[1] = numbers.add(impact);
  close(peakOf(view, numbers), ordinary, 0.02);
});

test("dashes fill a shaft, a short shaft is solid", () => {
  const { count, unit } = dashParts(0.9, 0.012);
  assert.equal(count, 8);
  close(unit * (count * 9.5 - 3), 0.9);
  assert.ok(Math.abs(unit / 0.012 - 1) < 0.1);
  assert.equal(dashParts(0.05, 0.012).count, 1);
  assert.equal(dashParts(50, 0.012).count, 40);
});

test("heads of short arrows shrink, lengths do not change", () => {
  const long = arrowParts(1, 0.01);
  close(long.head, 0.065);
  const short = arrowParts(0.05, 0.01);
  close(short.shaft + short.head, 0.05);
  assert.ok(short.headRadius < long.headRadius);
});

test("arcs grow with the moment up to a full arc and keep its sign", () => {
  assert.equal(arcAngle(0.01), 0);
  assert.equal(arcAngle(NONE), 0);
  close(arcAngle(-0.8), -arcAngle(0.8));
  close(arcAngle(5), arcAngle(1.6));
  assert.ok(arcAngle(1.2) > arcAngle(0.6));
});

test("a trail begins at its contact or after the last jump", () => {
  const x = Float64Array.of(9, NONE, 1, 1.01, 1.02, 2, 2.01);
  const level = x.map(() => 0);
  const along = (frame: number): number[] => trailPoints([x, level, level], frame).map(([a]) => a);
  assert.equal(contactStart(x, 4), 2);
  assert.equal(contactStart(x, 1), -1);
  assert.deepEqual(along(4), [1, 1.01, 1.02]);
  assert.deepEqual(along(6), [2, 2.01]);
  assert.deepEqual(along(1), []);
});

test("the trail's line surrounds its points and fades with age", () => {
  const points: Place[] = [0, 1, 2].map((x) => [x, 0.5, 0]);
  const { corners, strength } = rings(points, 0.2);
  assert.deepEqual(corners[0], [0, 0.5, 0.2]);
  assert.equal(corners.length, 18);
  assert.ok(corners.every(([, y, z]) => Math.abs(Math.hypot(y - 0.5, z) - 0.2) < 1e-9));
  assert.ok((strength[0] ?? 1) < (strength[2] ?? 0));
  close(strength[2] ?? 0, 1);
});

test("an obstacle in front of the figure is translucent, others are not", () => {
  const box = (x: number): ViewShape => ({ kind: "box", center: [x, 0, 0], half: [0.1, 1, 1], turn: [0, 0, 0, 1] });
  const view = samplePage(new SampleNumbers()).sessions[0]?.view;
  assert.ok(view);
  const obstacles = new Obstacles({ ...view, fixed: [box(2), box(-2)] });
  obstacles.group.updateMatrixWorld(true);
  obstacles.clear(new Vector3(5, 0, 0), new Vector3(0, 0, 0));
  const clear = obstacles.group.children.map((part) => ((part as Mesh).material as Material).transparent);
  assert.deepEqual(clear, [true, false]);
});

test("gaps of the path are filled, sway is smoothed, travel is not", () => {
  assert.deepEqual([...filled(Float64Array.of(NONE, 1, NONE, 3, NONE))], [1, 1, 2, 3, 3]);
  assert.deepEqual([...filled(Float64Array.of(NONE, NONE))], [0, 0]);
  const ramp = Float64Array.from({ length: 50 }, (_, index) => 0.1 * index);
  for (const [index, value] of smoothed(ramp, 8).entries()) {
    close(value, ramp[index] ?? NONE);
  }
  const sway = ramp.map((_, index) => (index % 2 === 0 ? 1 : -1));
  close(smoothed(sway, 8)[25] ?? NONE, 0, 0.1);
});

test("the sample walks towards +x and fits its extent", () => {
  const numbers = new SampleNumbers();
  const [session] = samplePage(numbers).sessions;
  assert.ok(session?.view);
  const timeline = new Timeline(session.time);
  const path = new Path(session.view, numbers, timeline);
  close(path.heading.x, 1, 1e-6);
  const extent = extentOf(session.view, numbers, path, timeline);
  assert.ok(extent.top > 1.5 && extent.top < 2, `${extent.top}`);
  assert.ok(extent.along < 1 && extent.across < 0.5);
});

test("the picture frames the person of a scene, not a ball far away", () => {
  const numbers = new SampleNumbers();
  const [session] = samplePage(numbers).sessions;
  assert.ok(session?.view);
  const view: View = session.view;
  const constant = (value: number) => numbers.add(Array.from({ length: session.time.frames }, () => value));
  const ball: ViewBody = {
    name: "ball",
    side: null,
    shapes: [{ kind: "capsule", from: [0, 0, 0], to: [0, 0.01, 0], radius: 0.3 }],
    position: [constant(24), constant(1.2), constant(15)],
    rotation: [constant(0), constant(0), constant(0), constant(1)],
  };
  const person = view.bodies.map((body) => ({ ...body, name: `bob/${body.name}` }));
  const extent = (bodies: ViewBody[]) => {
    const scene = { ...view, bodies };
    const timeline = new Timeline(session.time);
    return extentOf(scene, numbers, new Path(scene, numbers, timeline), timeline);
  };
  assert.deepEqual(extent([...person, ball]), extent(person));
  // Without a person, all bodies count.
  const things = [{ ...ball, name: "stone", position: [constant(0), constant(1), constant(0)] } as ViewBody, ball];
  assert.ok(extent(things).along > 20 && extent(things).across > 10);
});

test("the picture widens while somebody lies, and is narrow while the same person walks", () => {
  const numbers = new SampleNumbers();
  const timeline = new Timeline({ start_s: 0, step_s: 0.02, frames: 401 });
  const add = (value: (time: number) => number) =>
    numbers.add(Array.from({ length: timeline.frames }, (_, frame) => value(0.02 * frame)));
  const zero = add(() => 0);
  // A stick from the pelvis up to the head and down to the feet, which falls forward between 4 s and 4.5 s.
  const half = (time: number) => (Math.PI / 4) * Math.min(1, Math.max(0, 2 * (time - 4)));
  const body: ViewBody = {
    name: "bob/pelvis",
    side: null,
    shapes: [{ kind: "capsule", from: [0, -0.8, 0], to: [0, 0.8, 0], radius: 0.1 }],
    position: [add((time) => Math.min(time, 4)), add((time) => (time < 4.5 ? 0.9 : 0.1)), zero],
    rotation: [zero, zero, add((time) => -Math.sin(half(time))), add((time) => Math.cos(half(time)))],
  };
  const [session] = samplePage(numbers).sessions;
  assert.ok(session?.view);
  const view: View = { ...session.view, bodies: [body], floor_m: 0 };
  const framing = new Framing(view, numbers, new Path(view, numbers, timeline), timeline);
  const [walking, lying] = [framing.at(100), framing.at(390)];
  assert.ok(walking.along < 0.35 && walking.top > 1.75, JSON.stringify(walking));
  assert.ok(lying.along > 0.85 && lying.top < 0.5, JSON.stringify(lying));
  // It changes gradually, and before the fall.
  const widths = Array.from({ length: 401 }, (_, frame) => framing.at(frame).along);
  assert.ok(widths.every((width, frame) => frame === 0 || Math.abs(width - (widths[frame - 1] as number)) < 0.03));
  assert.ok((widths[195] as number) > 0.5);
});

test("walking on the spot has the direction of the pelvis", () => {
  const numbers = new SampleNumbers();
  const [session] = samplePage(numbers, [{ ...ORDINARY, speed: 0 }]).sessions;
  assert.ok(session?.view);
  close(new Path(session.view, numbers, new Timeline(session.time)).heading.x, 1, 1e-6);
});

test("in the side view the path runs to the right of the picture", () => {
  for (const heading of [new Vector3(1, 0, 0), new Vector3(0, 0, -1), new Vector3(-1, 0, 0)]) {
    const towards = directionOf("side", heading);
    const right = new Vector3(0, 1, 0).cross(towards).normalize();
    assert.ok(right.dot(heading) > 0.99);
    assert.ok(directionOf("front", heading).dot(heading) > 0.9);
  }
});

test("the tighter dimension of a picture determines the distance", () => {
  close(fittingDistance(1, 0.1, 0, 1), fittingDistance(1, 0.5, 0, 2));
  assert.ok(fittingDistance(1, 0.8, 0, 0.4) > fittingDistance(1, 0.1, 0, 0.4));
});

test("a long path has fewer marks per metre", () => {
  assert.deepEqual(marks(-0.5, 2.2, 20), [0, 1, 2]);
  const long = marks(0, 1000, 20);
  assert.ok(long.length <= 21 && long[1] === 100);
});

test("only existing parts can be shown or hidden", () => {
  const [session] = samplePage(new SampleNumbers()).sessions;
  assert.ok(session?.view);
  const words = (view: View, ghosts: boolean) => togglesOf(view, ghosts).map(({ word }) => word);
  assert.deepEqual(words(session.view, false), ["Forces", "Moments", "Soles"]);
  assert.deepEqual(words({ ...session.view, forces: [], torques: [], contacts: [] }, true), ["Ghost"]);
  const muscles = [{ name: "soleus_r", side: "r" as const, points: [], activation: new SampleNumbers().add([0]) }];
  assert.deepEqual(words({ ...session.view, muscles }, false), ["Forces", "Moments", "Soles", "Muscles"]);
});

test("a muscle is a line between the points of its bodies, coloured and thicker when active", () => {
  const numbers = new SampleNumbers();
  const of = (...values: number[]) => numbers.add(values);
  const body = (x: number, y: number): ViewBody => ({
    name: "b",
    side: null,
    shapes: [],
    position: [of(x, x), of(y, y), of(0, 0)],
    rotation: [of(0, 0), of(0, 0), of(Math.SQRT1_2, Math.SQRT1_2), of(Math.SQRT1_2, Math.SQRT1_2)],
  });
  const view = {
    bodies: [body(0, 1), body(0, 0)],
    // The bodies are turned by a quarter about z: x of the body is y of the world.
    muscles: [
      {
        name: "soleus_r",
        side: "r",
        points: [
          { body: 0, place: [0.1, 0, 0] },
          { body: 1, place: [0, 0, 0] },
        ],
        activation: of(0, 1),
      },
    ],
  } as unknown as View;
  const figure = new Figure(view, numbers);
  const muscles = new Muscles(view, numbers, 2);
  const colors = palette(false, false);
  muscles.recolor(colors);
  for (const [frame, activation] of [
    [0, 0],
    [0.5, 0.5],
    [1, 1],
  ] as const) {
    figure.pose(frame);
    muscles.pose(frame, figure);
    const lines = muscles.group.children[0] as InstancedMesh;
    const [matrix, color] = [new Matrix4(), new Color()];
    lines.getMatrixAt(0, matrix);
    lines.getColorAt(0, color);
    const ends = [new Vector3(0, 0, 0), new Vector3(0, 1, 0)].map((end) => end.applyMatrix4(matrix));
    close(ends[0]?.y ?? NONE, 1.1, 1e-6);
    close(ends[1]?.y ?? NONE, 0, 1e-6);
    close(new Vector3().setFromMatrixScale(matrix).x, 2 * thickness(activation), 1e-6);
    close(color.r, activationColor(colors, activation, new Color()).r, 1e-6);
  }
  assert.ok(thickness(1) > 2 * thickness(0) && thickness(NONE) === thickness(0) && thickness(7) === thickness(1));
});
