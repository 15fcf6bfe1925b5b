import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { DESKTOP, drawn, PAGES, PHONE, timeOf, withPage } from "./page";

/** State of a machine at a time, from `states.csv`. */
function stateInFile(machine: string, time: number): string | undefined {
  const lines = readFileSync(join(PAGES, "limp", "states.csv"), "utf8")
    .trim()
    .split("\n")
    .slice(1);
  const rows = lines.map((line) => /^([^,]*),"?(.*?)"?,([\d.]+),([\d.]+)$/.exec(line)?.slice(1) ?? []);
  return rows.find(([name, , from, to]) => name === machine && Number(from) <= time && time < Number(to))?.[1];
}

for (const [device, viewport] of Object.entries({ desktop: DESKTOP, phone: PHONE })) {
  test(`${device}: names of states are either complete or hidden`, async () => {
    await withPage(
      "limp",
      async ({ page }) => {
        await drawn(page);
        const names = await page.evaluate(() =>
          [...document.querySelectorAll<HTMLElement>(".period span")].map((name) => {
            const [box, period] = [name.getBoundingClientRect(), name.parentElement?.getBoundingClientRect()];
            const hidden = box.top >= (period?.bottom ?? 0);
            return { name: name.textContent, hidden, complete: !hidden && box.right <= (period?.right ?? 0) + 0.5 };
          }),
        );
        assert.deepEqual(
          names.filter(({ hidden, complete }) => !hidden && !complete),
          [],
        );
        assert.ok(names.filter(({ complete }) => complete).length > 30, "too few names are visible");
        assert.ok(names.some(({ hidden }) => hidden));
      },
      { viewport },
    );
  });
}

test("pointing at a band shows the states of all machines at that time", async () => {
  await withPage("limp", async ({ page }) => {
    const band = page.locator(".machine", { hasText: "balancing arm" }).last().locator(".band");
    await band.evaluate((element) => element.scrollIntoView({ block: "end" }));
    for (const part of [0.13, 0.42, 0.77]) {
      const box = await band.boundingBox();
      assert.ok(box);
      await page.mouse.move(box.x + part * box.width, box.y + box.height / 2);
      await drawn(page);
      const time = await timeOf(page);
      const shown = await page.evaluate(() =>
        [...document.querySelectorAll(".machine")].map((row) => [
          row.querySelector(".machine-name b")?.textContent ?? "",
          row.querySelector(".now")?.textContent ?? "",
        ]),
      );
      assert.ok(shown.length > 10);
      for (const [machine = "", state] of shown) {
        assert.equal(state, stateInFile(machine, time), `${machine} at ${time} s`);
      }
    }
  });
});
