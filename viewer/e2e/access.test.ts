import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test } from "node:test";
import { DESKTOP, PHONE, withPage } from "./page";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

interface Finding {
  id: string;
  impact: string;
  nodes: { target: string[]; failureSummary: string }[];
}

for (const name of ["demo", "infeasible", "compared"]) {
  for (const colorScheme of ["light", "dark"] as const) {
    for (const [device, viewport] of Object.entries({ desktop: DESKTOP, phone: PHONE })) {
      test(`${name}, ${colorScheme}, ${device}: nothing serious for those who see or move differently`, async () => {
        await withPage(
          name,
          async ({ page }) => {
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
}
