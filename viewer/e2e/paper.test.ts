import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { SHOTS, withPage } from "./page";

/** Size of A4 in points. */
const A4 = { width: 595, height: 842 };

test("prints on A4 with the figure as a still", async () => {
  await withPage("demo", async ({ page }) => {
    const pdf = await page.pdf({ preferCSSPageSize: true, printBackground: true });
    mkdirSync(SHOTS, { recursive: true });
    writeFileSync(join(SHOTS, "demo.pdf"), pdf);
    const text = pdf.toString("latin1");
    const boxes = [...text.matchAll(/\/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)\s*\]/g)];
    assert.ok(boxes.length > 0, "no pages");
    for (const [, width, height] of boxes) {
      assert.ok(
        Math.abs(Number(width) - A4.width) < 3 && Math.abs(Number(height) - A4.height) < 3,
        `${width} x ${height}`,
      );
    }
    assert.match(text, /\/Subtype\s*\/Image/, "no still of the figure");
    assert.ok(pdf.length > 40_000, `${pdf.length} bytes`);
    const still = await page.locator("img.still").evaluate((image: HTMLImageElement) => image.naturalWidth);
    assert.ok(still > 100, `the still is ${still} pixels wide`);
  });
});
