import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import type { Page } from "../../viewer/e2e/page";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

interface Finding {
  id: string;
  impact: string;
  nodes: { target: string[]; failureSummary: string }[];
}

/** What hinders people who use a screen reader or a keyboard, as axe finds it. */
export async function obstacles(page: Page): Promise<string[]> {
  // Playwright passes the script past the policy of the page.
  await page.evaluate(AXE);
  const findings = await page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run(options: object): Promise<{ violations: Finding[] }> } };
    return (await axe.run({ iframes: false })).violations;
  });
  return findings.map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.failureSummary).join("; ")}`);
}
