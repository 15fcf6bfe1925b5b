import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { DESKTOP, newContext, PAGES, type Page, PHONE, SHOTS } from "./page";

/** Opens the page of the session. */
async function withSession(viewport: typeof PHONE, use: (page: Page) => Promise<void>): Promise<void> {
  const context = await newContext({ viewport });
  try {
    const page = await context.newPage();
    await page.goto(pathToFileURL(join(PAGES, "session", "session.html")).href);
    await use(page);
  } finally {
    await context.close();
  }
}

/** Widths of the pictures that are shown, and the right edge of the farthest. */
function pictures(): { count: number; right: number } {
  const shown = [...document.querySelectorAll("svg")].map((picture) => picture.getBoundingClientRect());
  return {
    count: shown.filter(({ width }) => width > 0).length,
    right: Math.max(...shown.map(({ right }) => right)),
  };
}

test("no picture of a session is wider than the screen of a phone", async () => {
  await withSession(PHONE, async (page) => {
    const { count, right } = await page.evaluate(pictures);
    assert.ok(count > 10 && right <= PHONE.width, `${count} pictures, ${right} wide`);
    assert.equal(await page.locator(".picture.narrow:visible").count(), 2);
    assert.equal(await page.locator(".picture.wide:visible").count(), 0);
    mkdirSync(SHOTS, { recursive: true });
    await page.locator(".picture.narrow").first().scrollIntoViewIfNeeded();
    await page.screenshot({ path: join(SHOTS, "session-phone.png") });
  });
});

test("a session on a wide screen and on paper has one picture of the profile", async () => {
  await withSession(DESKTOP, async (page) => {
    for (const media of ["screen", "print"] as const) {
      await page.emulateMedia({ media });
      assert.equal(await page.locator(".picture:visible").count(), 1);
      assert.equal(await page.locator(".picture.wide:visible").count(), 1);
    }
    // The last part is not torn, so that the last sheet has more than some lines.
    assert.equal(await page.locator("#about").evaluate((part) => getComputedStyle(part).breakInside), "avoid");
  });
});
