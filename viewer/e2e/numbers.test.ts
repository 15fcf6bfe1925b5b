import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { type Column, readCycles, readTable, timeNormalised } from "./files";
import { PAGES, withPage } from "./page";

/** A curve as the page draws it. */
interface Drawn {
  panel: string;
  file: string;
  column: string;
  factor: number;
  side: "r" | "l" | null;
  cycle: number | null;
  /** Start and end of the cycle [s]. */
  span: [number, number] | null;
  start: number;
  frameStep: number;
  values: number[];
  /** Quantisation step of the values in the page. */
  step: number;
  /** Whether the panel's own array has the same values. */
  same: boolean;
}

/** Reads every curve with a source column from the page, on both axes, and lists the panels without such curves. */
async function curvesOf(name: string): Promise<{ curves: Drawn[]; withoutSource: string[] }> {
  let curves: Drawn[] = [];
  let withoutSource: string[] = [];
  await withPage(name, async ({ page }) => {
    curves = await page.evaluate(() => {
      const { page: data, numbers, display } = window.ambulo;
      const [session] = data.sessions;
      if (!session) {
        return [];
      }
      const out: Drawn[] = [];
      const same = (panel: string, values: Float64Array): boolean =>
        window.ambulo.panels[panel]?.lines.some(
          ({ y }) => y.length === values.length && y.every((value, index) => Object.is(value, values[index])),
        ) ?? false;
      const groups = [...session.groups, ...session.quality.groups];
      const base = { start: session.time.start_s, frameStep: session.time.step_s };
      for (const axis of ["cycle", "time"] as const) {
        display.axis = axis;
        for (const panel of groups.flatMap((group) => group.panels)) {
          const curves = axis === "cycle" ? panel.cycles : panel.traces;
          for (const curve of curves) {
            const values = numbers.read(curve.values);
            if (curve.origin) {
              const cycle = "number" in curve ? curve.number : null;
              const own = session.cycles.find(({ side, number }) => side === curve.side && number === cycle);
              const span: [number, number] | null = own ? [own.start_s, own.end_s] : null;
              const drawn = { values: [...values], step: curve.values.step, same: same(panel.id, values) };
              out.push({ panel: panel.id, ...curve.origin, side: curve.side, cycle, span, ...base, ...drawn });
            }
          }
        }
      }
      return out;
    });
    withoutSource = await page.evaluate(() => {
      const [session] = window.ambulo.page.sessions;
      const panels = [...(session?.groups ?? []), ...(session?.quality.groups ?? [])].flatMap((group) => group.panels);
      const hasSource = (curve: { origin: unknown }): boolean => curve.origin !== null;
      return panels
        .filter((panel) => panel.empty === null && ![...panel.cycles, ...panel.traces].some(hasSource))
        .map((panel) => panel.id);
    });
  });
  return { curves, withoutSource };
}

/** Panels whose curves are computed from several columns. */
const DERIVED = ["friction_use", "residual_force"];

/** Compares the curves of a page with the files in its folder; returns the number of equal values. */
async function compare(name: string): Promise<{ curves: number; numbers: number }> {
  const tables = new Map<string, Map<string, Column>>();
  const cycles = readCycles(readFileSync(join(PAGES, name, "cycles.csv"), "utf8"));
  let count = 0;
  const { curves, withoutSource } = await curvesOf(name);
  assert.deepEqual(
    withoutSource.filter((panel) => !DERIVED.includes(panel)),
    [],
    "panels without a curve of a file",
  );
  for (const curve of curves) {
    const where = `${curve.panel} ${curve.file} ${curve.column} ${curve.side} ${curve.cycle ?? ""}`;
    if (!tables.has(curve.file) && curve.file !== "cycles.csv") {
      tables.set(curve.file, readTable(readFileSync(join(PAGES, name, curve.file), "utf8")));
    }
    const column = tables.get(curve.file)?.get(curve.column);
    const wanted =
      curve.cycle === null
        ? onFrames(column, curve)
        : curve.file === "cycles.csv"
          ? cycles.get(`${curve.side} ${curve.cycle} ${curve.column}`)
          : column && curve.span && timeNormalised(column, ...curve.span);
    assert.ok(wanted, `${where}: the file has no such column`);
    assert.equal(curve.values.length, wanted.length, where);
    assert.ok(curve.same, `${where}: the panel draws something else`);
    for (const [index, drawn] of curve.values.entries()) {
      const value = curve.factor * (wanted[index] ?? Number.NaN);
      const near = Math.abs(drawn - value) <= 0.5001 * curve.step + 1e-9 * Math.abs(value);
      assert.ok(
        near || (Number.isNaN(drawn) && isGap(value, curve)),
        `${where} [${index}]: drawn ${drawn}, file ${value}`,
      );
      count += 1;
    }
  }
  return { curves: curves.length, numbers: count };
}

/** Ground forces are 0 in the file while a foot is unloaded; the page has a gap there. */
function isGap(value: number, curve: Drawn): boolean {
  return Number.isNaN(value) || (value === 0 && curve.file.startsWith("grf"));
}

function onFrames(column: Column | undefined, curve: Drawn): number[] | undefined {
  return column?.values.filter((_, index) => {
    const frame = ((column.times[index] ?? 0) - curve.start) / curve.frameStep;
    return frame > -0.5 && frame < curve.values.length - 0.5;
  });
}

for (const name of ["demo", "recording", "predicted"]) {
  test(`${name}: every number drawn equals the file`, async (t) => {
    const { curves, numbers } = await compare(name);
    t.diagnostic(`${name}: ${numbers} numbers of ${curves} curves compared with the files`);
    assert.ok(curves >= 20, `${curves} curves`);
  });
}

test("the required friction is computed from the ground forces in the file", async () => {
  const table = readTable(readFileSync(join(PAGES, "demo", "grf.mot"), "utf8"));
  const column = (side: string, axis: string): number[] => table.get(`ground_force_${side}_v${axis}`)?.values ?? [];
  await withPage("demo", async ({ page }) => {
    const traces = await page.evaluate(() => {
      const { page: data, numbers } = window.ambulo;
      const panels = data.sessions[0]?.quality.groups.flatMap((group) => group.panels) ?? [];
      const panel = panels.find(({ id }) => id === "friction_use");
      const main = panel?.traces.filter(({ role }) => role === "main") ?? [];
      return main.map(({ side, values }) => ({ side, step: values.step, values: [...numbers.read(values)] }));
    });
    assert.deepEqual(traces.map(({ side }) => side).sort(), ["l", "r"]);
    for (const { side, step, values } of traces) {
      const [x, y, z] = ["x", "y", "z"].map((axis) => column(side ?? "", axis)) as [number[], number[], number[]];
      const drawn = [...values.entries()].filter(([, value]) => Number.isFinite(value));
      assert.ok(drawn.length > 50, `${drawn.length} values`);
      for (const [index, value] of drawn) {
        const wanted = Math.hypot(x[index] ?? Number.NaN, z[index] ?? Number.NaN) / (y[index] ?? Number.NaN);
        assert.ok(
          Math.abs(value - wanted) <= 0.5001 * step + 1e-9,
          `${side} [${index}]: drawn ${value}, file ${wanted}`,
        );
      }
    }
  });
});
