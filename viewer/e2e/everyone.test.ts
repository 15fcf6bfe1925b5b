import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { test } from "node:test";
import { DESKTOP, drawn, PHONE, SHOTS, withPage } from "./page";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

interface Finding {
  id: string;
  impact: string;
  nodes: { target: string[]; failureSummary: string }[];
}

type Look = [colorScheme: "light" | "dark", device: "desktop" | "phone"];

/** Colours do not depend on the width: one page shows both themes on both devices, the others each of them once. */
const ONCE: Look[] = [
  ["light", "desktop"],
  ["dark", "phone"],
];
const ALL: Look[] = [...ONCE, ["light", "phone"], ["dark", "desktop"]];
const LOOKS: [page: string, looks: Look[]][] = [
  ["demo", ALL],
  ["infeasible", ONCE],
  ["compared", ONCE],
];

for (const [name, looks] of LOOKS) {
  for (const [colorScheme, device] of looks) {
    const viewport = device === "phone" ? PHONE : DESKTOP;
    test(`${name}, ${colorScheme}, ${device}: accessible, and not wider than the window`, async () => {
      await withPage(
        name,
        async ({ page }) => {
          await drawn(page);
          mkdirSync(SHOTS, { recursive: true });
          await page.screenshot({ path: join(SHOTS, `${name}-${device}-${colorScheme}.png`) });
          const wide = await page.evaluate(() => document.documentElement.scrollWidth);
          assert.ok(wide <= viewport.width, `${name} is ${wide} wide`);
          await page.evaluate(AXE);
          const findings = await page.evaluate(async () => {
            const { axe } = window as unknown as { axe: { run(): Promise<{ violations: Finding[] }> } };
            return (await axe.run()).violations;
          });
          const serious = findings.filter(({ impact }) => impact === "serious" || impact === "critical");
          const words = serious.map(
            ({ id, nodes }) =>
              `${id}: ${nodes
                .slice(0, 3)
                .map((n) => `${n.target} ${n.failureSummary}`)
                .join("; ")}`,
          );
          assert.deepEqual(words, []);
        },
        { viewport, colorScheme },
      );
    });
  }
}
