import assert from "node:assert/strict";
import { test } from "node:test";
import { addressOf, emptyBoxes, type Opened, withPage } from "./page";

test("curves on predicted forces are dotted, in the words of the legend", async () => {
  await withPage("one_leg", async ({ page }) => {
    await page.getByRole("button", { name: "Time" }).click();
    assert.match((await page.locator(".legend").first().textContent()) ?? "", /predicted ground forces/);
    assert.match(
      (await page.locator(".answers").first().textContent()) ?? "",
      /no stance of the left leg was measured/,
    );
    assert.match((await page.locator(".header").textContent()) ?? "", /measured, in part predicted/);
    const roles = await page.evaluate(() =>
      (window.ambulo.panels["knee_flexion_moment"]?.lines ?? []).map((line) => [line.role, line.side]),
    );
    assert.deepEqual(roles, [
      ["main", "r"],
      ["main", "l"],
      ["predicted", "l"],
    ]);
  });
});

test("infeasible spans are red, with the reason as text", async () => {
  await withPage("infeasible", async ({ page }) => {
    const spans = page.locator(".lane .span");
    assert.ok((await spans.count()) > 0);
    const color = await spans.first().evaluate((span) => getComputedStyle(span).backgroundColor);
    const wanted = await page.evaluate(() => {
      const sample = document.createElement("i");
      sample.style.backgroundColor = "var(--infeasible)";
      document.body.append(sample);
      return getComputedStyle(sample).backgroundColor;
    });
    assert.equal(color, wanted);
    const box = await spans.first().boundingBox();
    assert.ok(box && box.width >= 3 && box.height >= 3, JSON.stringify(box));
    const reasons = await page.locator(".reasons li").allTextContents();
    assert.ok(reasons.length > 0 && reasons.every((reason) => /\d/.test(reason) && reason.length > 40));
    await page.locator(".reasons button").first().click();
    const from = await page.evaluate(() => window.ambulo.page.sessions[0]?.feasibility?.red[0]?.from_s ?? Number.NaN);
    assert.ok(Math.abs((await page.evaluate(() => window.ambulo.clock.time)) - from) < 1e-6);
  });
});

/** A browser without WebGL. */
const NO_WEBGL = `
  const get = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return kind.startsWith("webgl") ? null : get.call(this, kind, ...rest);
  };`;

test("without WebGL a sentence replaces the figure, and everything else works", async () => {
  const look = async ({ page }: Opened): Promise<void> => {
    assert.match(await page.locator(".view").innerText(), /WebGL/);
    assert.deepEqual(await emptyBoxes(page), []);
    await page.keyboard.press("End");
    assert.equal(await page.evaluate(() => window.ambulo.clock.time === window.ambulo.clock.end), true);
    assert.ok((await page.locator(".plot canvas").count()) > 0);
  };
  await withPage("demo", look, {}, NO_WEBGL);
});

test("text of files is text: no script of it runs", async () => {
  await withPage(
    "hostile",
    async ({ page, requests, complaints }) => {
      const text = await page.evaluate(() => document.querySelector("#ambulo")?.textContent ?? "");
      assert.ok(text.includes("onerror=hacked()"), "the names are shown as they are");
      assert.equal(await page.locator("img[src=x]").count(), 0);
      assert.equal(await page.evaluate(() => (window as { ran?: boolean }).ran ?? false), false);
      assert.deepEqual(requests, [addressOf("hostile")]);
      assert.deepEqual(complaints, []);
    },
    {},
    "window.hacked = () => { window.ran = true; };",
  );
});
