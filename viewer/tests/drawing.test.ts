import assert from "node:assert/strict";
import { test } from "node:test";
import type { Page, Trace } from "../src/contract";
import { type Drawing, drawing, hasValues, type Line, type PanelSource, valueRange } from "../src/drawing";
import { pixels, predictedDash } from "../src/look";
import { Numbers } from "../src/numbers";
import { readings } from "../src/reading";
import { STYLE } from "../src/style";
import { Block } from "./block";
import { samplePage, type Variant } from "./sample";

const WHOLE: Variant = { name: "one", scale: 1, cycles: true, red: true };
const BOTH = { axis: "cycle", sides: ["r", "l"] } as const;

async function pageOf(...variants: Variant[]): Promise<{ page: Page; numbers: Numbers }> {
  const block = new Block();
  const page = samplePage(block, variants);
  return { page, numbers: await Numbers.decode(block.encode()) };
}

function sourcesOf(page: Page, id: string): PanelSource[] {
  return page.sessions.flatMap((session, index) => {
    const groups = [...session.groups, ...session.quality.groups];
    const panel = groups.flatMap((group) => group.panels).find((one) => one.id === id);
    return panel ? [{ index, session, panel }] : [];
  });
}

const count = (of: Drawing | null, role: string): number => of?.lines.filter((line) => line.role === role).length ?? 0;

test("every cycle, one mean per side, the band and foot offs are drawn over the cycle", async () => {
  const { page, numbers } = await pageOf(WHOLE);
  const now = drawing(sourcesOf(page, "knee_flexion"), numbers, BOTH);
  assert.equal(count(now, "cycle"), 5);
  assert.equal(count(now, "mean"), 2);
  assert.deepEqual(
    now?.areas.map((area) => area.kind),
    ["band"],
  );
  assert.deepEqual(
    now?.marks.map((mark) => mark.x),
    [61.6, 63.2],
  );
  assert.deepEqual(now?.x, [0, 100]);
});

test("one chosen side hides the other", async () => {
  const { page, numbers } = await pageOf(WHOLE);
  const now = drawing(sourcesOf(page, "knee_flexion"), numbers, { axis: "cycle", sides: ["l"] });
  assert.equal(count(now, "mean"), 1);
  assert.ok(now?.lines.every((line) => line.side === "l"));
});

test("with several sessions only means are drawn", async () => {
  const { page, numbers } = await pageOf(WHOLE, { ...WHOLE, name: "two", scale: 1.2 });
  const now = drawing(sourcesOf(page, "knee_flexion"), numbers, BOTH);
  assert.equal(count(now, "cycle"), 0);
  assert.deepEqual(
    now?.lines.map((line) => line.session),
    [0, 0, 1, 1],
  );
  assert.equal(now?.areas.length, 1);
});

test("without values over time nothing is drawn over time", async () => {
  const { page, numbers } = await pageOf(WHOLE);
  const sources = sourcesOf(page, "knee_flexion").map((one) => ({ ...one, panel: { ...one.panel, traces: [] } }));
  assert.equal(drawing(sources, numbers, { ...BOTH, axis: "time" }), null);
  assert.equal(drawing(sources, numbers, BOTH)?.axis, "cycle");
  assert.ok(hasValues(sources));
});

test("without cycles the panel is over time, with deviations and events", async () => {
  const { page, numbers } = await pageOf({ ...WHOLE, cycles: false });
  const now = drawing(sourcesOf(page, "knee_flexion"), numbers, BOTH);
  assert.equal(now?.axis, "time");
  assert.equal(count(now, "main"), 2);
  assert.deepEqual(
    now?.areas.map((area) => area.kind),
    ["deviation", "deviation"],
  );
  assert.equal(now?.marks.length, page.sessions[0]?.events.length);
  assert.equal(now?.x[0], page.sessions[0]?.time.start_s);
});

test("red spans shade the time, and only the curve of their side is red", async () => {
  const { page, numbers } = await pageOf(WHOLE);
  const now = drawing(sourcesOf(page, "ankle_moment"), numbers, { ...BOTH, axis: "time" });
  assert.equal(now?.shades.length, 2);
  const red = now?.lines.filter((line) => line.role === "infeasible") ?? [];
  assert.deepEqual(
    red.map((line) => line.side),
    ["r"],
  );
  const times = red.flatMap((line) => [...line.x].filter((_, i) => Number.isFinite(line.y[i])));
  assert.ok(times.length > 20);
  assert.ok(times.every((t) => (t >= 1.299 && t <= 1.441) || (t >= 2.399 && t <= 2.521)));
});

test("over the cycle the red part is at the place of the span", async () => {
  const { page, numbers } = await pageOf(WHOLE);
  const now = drawing(sourcesOf(page, "ankle_moment"), numbers, BOTH);
  const red = now?.lines.filter((line) => line.role === "infeasible") ?? [];
  // Spans: 1.30-1.44 s and 2.40-2.52 s. Right cycles: from 0.45 s, 1.12 s each.
  assert.deepEqual(
    red.map((line) => line.cycle),
    [1, 2],
  );
  const percents = [...(red[0]?.y ?? [])].flatMap((value, i) => (Number.isFinite(value) ? [i] : []));
  assert.deepEqual([percents[0], percents.at(-1)], [76, 88]);
});

test("an empty panel gives no drawing", async () => {
  const { page, numbers } = await pageOf(WHOLE);
  assert.equal(drawing(sourcesOf(page, "plates_predicted"), numbers, BOTH), null);
});

test("the reading is the value of the curve at the time", async () => {
  const { page, numbers } = await pageOf(WHOLE);
  const [session] = page.sessions;
  const now = drawing(sourcesOf(page, "knee_flexion"), numbers, BOTH);
  assert.ok(now && session);
  const [right, left] = readings(now, session, 0.45 + 0.3 * 1.12);
  const curve = now.lines.find((line) => line.role === "cycle" && line.side === "r" && line.cycle === 1);
  assert.equal(right?.x?.toFixed(6), "30.000000");
  assert.equal(right?.value, curve?.y[30]);
  assert.deepEqual(left, { side: "l", variant: 0, x: null, value: undefined });
});

test("the range shows a limit if it is near, zero if it is near, and no rounding", () => {
  const line = (role: "main" | "limit", values: number[]) => ({
    name: "",
    role,
    side: null,
    session: 0,
    cycle: null,
    variant: 0,
    x: Float64Array.from(values, (_, i) => i),
    y: Float64Array.from(values),
    origin: null,
  });
  const curve = line("main", [10, 20]);
  assert.ok(valueRange([curve, line("limit", [22, 22])], [])[1] > 22);
  assert.ok(valueRange([curve, line("limit", [90, 90])], [])[1] < 30);
  assert.deepEqual(valueRange([line("main", [Number.NaN])], []), [-1, 1]);
  assert.deepEqual(valueRange([line("main", [0, 0])], []), [-1, 1]);
  assert.deepEqual(valueRange([line("main", [4, 4])], []), [2, 6]);
  assert.deepEqual(valueRange([line("main", [1e-16, -3e-16])], []), [-1, 1]);
  assert.equal(valueRange([line("main", [1, 9])], [])[0], 0);
});

test("a curve on predicted forces is a line of its own that joins the measured one", async () => {
  const block = new Block();
  const page = samplePage(block, [WHOLE]);
  const [session] = page.sessions;
  const [source] = sourcesOf(page, "residual");
  assert.ok(session && source);
  const { start_s, step_s, frames } = session.time;
  const values = block.add(Array.from({ length: frames }, (_, i) => i));
  const at = (frame: number): number => start_s + frame * step_s;
  const trace: Trace = {
    name: "right",
    side: "r",
    role: "main",
    values,
    sd: null,
    predicted: [[at(20), at(30)]],
    origin: null,
  };
  const now = drawing(
    [{ ...source, panel: { ...source.panel, traces: [trace] } }],
    await Numbers.decode(block.encode()),
    BOTH,
  );
  const [main, predicted] = now?.lines ?? [];
  assert.ok(now && main && predicted);
  assert.deepEqual(
    [main.role, main.name, predicted.role, predicted.name],
    ["main", "right", "predicted", "right, predicted"],
  );
  const shown = (line: Line): number[] => Array.from(line.y.keys()).filter((i) => Number.isFinite(line.y[i]));
  assert.deepEqual([shown(predicted).at(0), shown(predicted).at(-1)], [19, 31]);
  assert.ok(!shown(main).includes(20) && !shown(main).includes(30) && shown(main).includes(19));
  // Neither solid as the right side nor dashed as the left one.
  const left = STYLE.left.dash.map((length) => length * pixels(STYLE.lines_pt.mean));
  assert.ok(predictedDash().length > 0);
  assert.notDeepEqual(predictedDash(), left);
  // The value at the cursor is that of either line.
  assert.deepEqual(
    [10, 25].map((frame) => readings(now, session, at(frame)).map((reading) => reading.value?.toFixed(0))),
    [["10"], ["25"]],
  );
});

test("several lines without a side have numbers and one reading each", async () => {
  const block = new Block();
  const page = samplePage(block, [WHOLE]);
  const [session] = page.sessions;
  const [source] = sourcesOf(page, "residual");
  assert.ok(session && source);
  const values = block.add(Array.from({ length: session.time.frames }, (_, i) => i));
  const second: Trace = { name: "up", side: null, role: "main", values, sd: null, predicted: [], origin: null };
  const panel = { ...source.panel, traces: [...source.panel.traces, second] };
  const numbers = await Numbers.decode(block.encode());
  const now = drawing([{ ...source, panel }], numbers, BOTH);
  assert.ok(now);
  const main = now.lines.filter((line) => line.role === "main");
  assert.deepEqual(
    main.map((line) => line.variant),
    [0, 1],
  );
  const read = readings(now, session, session.time.start_s + 7 * session.time.step_s);
  assert.deepEqual(
    read.map((reading) => reading.value?.toFixed(1)),
    [main[0]?.y[7]?.toFixed(1), "7.0"],
  );
});

/** A panel with electromyograms of the right side and usual times of activity. */
async function active(...variants: Variant[]): Promise<{ sources: PanelSource[]; numbers: Numbers }> {
  const block = new Block();
  const page = samplePage(block, variants);
  const values = block.add(Array.from({ length: 101 }, (_, i) => i / 100));
  const measured = [{ side: "r" as const, cycles: 3, values, sd: null, foot_off_percent: null }];
  const sources = sourcesOf(page, "knee_flexion").map((one) => ({
    ...one,
    panel: {
      ...one.panel,
      activity: {
        measured,
        recorded: [{ side: "r" as const, times: [[5, 60]] as [number, number][] }],
        usual: [
          [0, 17],
          [92, 100],
        ] as [number, number][],
        agreement: "r",
      },
    },
  }));
  return { sources, numbers: await Numbers.decode(block.encode()) };
}

test("electromyograms and usual times are drawn over the cycle of one session", async () => {
  const { sources, numbers } = await active(WHOLE);
  const now = drawing(sources, numbers, BOTH);
  const measured = now?.lines.filter((line) => line.role === "measured") ?? [];
  assert.deepEqual(
    measured.map(({ name, side, y }) => [name, side, Math.round(100 * (y[50] ?? 0))]),
    [["right, electromyogram, mean of 3", "r", 50]],
  );
  assert.deepEqual(now?.active, [
    { from: 0, to: 17, side: null },
    { from: 92, to: 100, side: null },
    { from: 5, to: 60, side: "r" },
  ]);
  assert.equal(drawing(sources, numbers, { axis: "cycle", sides: ["l"] })?.active.length, 2);
  assert.equal(count(drawing(sources, numbers, { axis: "cycle", sides: ["l"] }), "measured"), 0);
  assert.deepEqual(drawing(sources, numbers, { ...BOTH, axis: "time" })?.active, []);
});

test("a comparison has usual times but no electromyograms over the cycle", async () => {
  const { sources, numbers } = await active(WHOLE, { ...WHOLE, name: "two", scale: 1.2 });
  const now = drawing(sources, numbers, BOTH);
  assert.equal(count(now, "measured"), 0);
  assert.equal(now?.active.length, 2);
});
