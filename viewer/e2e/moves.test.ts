import assert from "node:assert/strict";
import { test } from "node:test";
import type { Page } from "playwright-core";
import { drawn, PHONE, picture, timeOf, withPage } from "./page";

/** Point at half the height and a fraction of the width of a panel's plot, in CSS pixels of the window. */
async function inPlot(page: Page, panel: string, part: number): Promise<{ x: number; y: number }> {
  const plot = page.locator(`#panel-${panel} .u-over`);
  // At the lower edge of the window: on a phone the figure covers the upper half.
  await plot.evaluate((element) => element.scrollIntoView({ block: "end" }));
  const box = await plot.boundingBox();
  assert.ok(box, `${panel} is not drawn`);
  return { x: box.x + part * box.width, y: box.y + box.height / 2 };
}

/** Positions of the cursors of the visible panels, by panel and side. */
function cursors(page: Page): Promise<Record<string, string>> {
  return page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll<HTMLElement>(".plot .cursor")]
        .filter((line) => {
          const box = line.closest("figure")?.getBoundingClientRect();
          return box && box.top >= 0 && box.bottom <= innerHeight;
        })
        .map((line) => [`${line.closest("figure")?.id} ${line.className}`, `${line.hidden} ${line.style.transform}`]),
    ),
  );
}

test("play moves time and figure, pause stops them", async () => {
  await withPage("demo", async ({ page }) => {
    const [time, before] = [await timeOf(page), await picture(page)];
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await page.waitForFunction((from) => window.ambulo.clock.time > from + 0.1, time);
    await page.getByRole("button", { name: "Pause", exact: true }).click();
    assert.notEqual((await picture(page)).print, before.print);
    const held = await timeOf(page);
    await page.waitForTimeout(150);
    assert.equal(await timeOf(page), held);
  });
});

test("hovering a curve moves time and figure", async () => {
  await withPage("demo", async ({ page }) => {
    const start = await inPlot(page, "hip_flexion_angle", 0.3);
    await page.mouse.move(start.x, start.y);
    await drawn(page);
    const [time, before] = [await timeOf(page), await picture(page)];
    const end = await inPlot(page, "hip_flexion_angle", 0.7);
    await page.mouse.move(end.x, end.y, { steps: 3 });
    await drawn(page);
    assert.ok(Math.abs((await timeOf(page)) - time) > 0.1);
    assert.notEqual((await picture(page)).print, before.print);
  });
});

test("the slider moves the cursors of all visible panels", async () => {
  await withPage("demo", async ({ page }) => {
    await page.locator("#panel-hip_flexion_angle .u-over").scrollIntoViewIfNeeded();
    await drawn(page);
    const before = Object.entries(await cursors(page));
    assert.ok(before.length >= 4, `${before.length} cursors`);
    await page.locator(".timeline input").evaluate((slider: HTMLInputElement) => {
      slider.value = String(Number(slider.value) + 0.17);
      slider.dispatchEvent(new Event("input", { bubbles: true }));
    });
    await drawn(page);
    const after = await cursors(page);
    const still = before.filter(([panel, place]) => after[panel] === place && !place.startsWith("true"));
    assert.deepEqual(still, []);
  });
});

test("keys: space, arrows, Home, cameras, help", async () => {
  await withPage("demo", async ({ page }) => {
    const step = await page.evaluate(() => window.ambulo.clock.step);
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowLeft");
    assert.ok(Math.abs((await timeOf(page)) - step) < 1e-9);
    const prints = new Set<number>();
    for (const key of ["1", "2", "3"]) {
      await page.keyboard.press(key);
      await drawn(page);
      prints.add((await picture(page)).print);
    }
    assert.equal(prints.size, 3, "three cameras, three pictures");
    await page.keyboard.press("Space");
    await page.waitForFunction((from) => window.ambulo.clock.time > from + 0.05, step);
    await page.keyboard.press("Space");
    assert.equal(await page.evaluate(() => window.ambulo.clock.playing), false);
    await page.keyboard.press("?");
    assert.ok(await page.getByRole("dialog").isVisible());
    await page.keyboard.press("Escape");
    assert.equal(await page.getByRole("dialog").isVisible(), false);
  });
});

test("keys rotate and zoom the focused picture", async () => {
  await withPage("demo", async ({ page }) => {
    await page.locator("canvas[role=img]").focus();
    const prints = new Set([(await picture(page)).print]);
    for (const key of ["d", "w", "e"]) {
      await page.keyboard.press(key);
      prints.add((await picture(page)).print);
    }
    assert.equal(prints.size, 4);
  });
});

test("a slider goes from the recorded motion to the corrected one", async () => {
  await withPage("consistent", async ({ page }) => {
    const slider = page.getByRole("slider", { name: /as recorded/ });
    const prints = [(await picture(page)).print];
    for (const value of ["0.5", "0", "1"]) {
      await slider.fill(value);
      prints.push((await picture(page)).print);
    }
    assert.equal(new Set(prints).size, 3, "corrected, between, recorded");
    assert.equal(prints[3], prints[0]);
  });
  await withPage("demo", async ({ page }) => {
    assert.equal(await page.getByRole("slider", { name: /as recorded/ }).count(), 0, "a motion that was not changed");
  });
});

test("the reader can choose the parts shown with the figure", async () => {
  await withPage("compared", async ({ page }) => {
    const prints = new Set([(await picture(page)).print]);
    for (const word of ["Moments", "Forces", "Soles", "Ghost"]) {
      const toggle = page.getByRole("button", { name: word, exact: true });
      const before = await toggle.getAttribute("aria-pressed");
      await toggle.click();
      assert.notEqual(await toggle.getAttribute("aria-pressed"), before);
      prints.add((await picture(page)).print);
    }
    assert.equal(prints.size, 5, "each changes the picture");
  });
});

test("a finger on a curve moves the time; on the figure it scrolls or rotates", async () => {
  const phone = { viewport: PHONE, hasTouch: true, isMobile: true };
  await withPage(
    "demo",
    async ({ page }) => {
      const place = await inPlot(page, "hip_flexion_angle", 0.25);
      await page.touchscreen.tap(place.x, place.y);
      const first = await timeOf(page);
      const next = await inPlot(page, "hip_flexion_angle", 0.75);
      await page.touchscreen.tap(next.x, next.y);
      assert.notEqual(await timeOf(page), first);
      const action = () => page.locator("canvas[role=img]").evaluate((canvas) => getComputedStyle(canvas).touchAction);
      assert.match(await action(), /pan-y/);
      await page.getByRole("button", { name: "Free" }).tap();
      assert.equal(await action(), "none");
    },
    phone,
  );
});

test("the picture follows the theme and the size of its host", async () => {
  await withPage("demo", async ({ page }) => {
    const light = await picture(page);
    await page.keyboard.press("t");
    assert.notEqual((await picture(page)).print, light.print);
    const width = () => page.locator("canvas[role=img]").evaluate((canvas: HTMLCanvasElement) => canvas.width);
    const wide = await width();
    await page.setViewportSize({ width: 1000, height: 800 });
    await drawn(page);
    assert.ok((await width()) < wide);
  });
});

test("nothing is drawn while nothing changes", async () => {
  await withPage("demo", async ({ page }) => {
    await drawn(page);
    const calls = await page.evaluate(async () => {
      const canvas = document.querySelector<HTMLCanvasElement>("canvas[role=img]");
      const gl = canvas?.getContext("webgl2") as WebGL2RenderingContext;
      let count = 0;
      const draw = gl.drawElements.bind(gl);
      gl.drawElements = (...values) => {
        count += 1;
        draw(...values);
      };
      await new Promise((done) => setTimeout(done, 300));
      const idle = count;
      window.ambulo.clock.nudge(1);
      const end = performance.now() + 60_000;
      while (count === idle && performance.now() < end) await new Promise(requestAnimationFrame);
      return { idle, moved: count };
    });
    assert.equal(calls.idle, 0);
    assert.ok(calls.moved > 0);
  });
});
