import assert from "node:assert/strict";
import { existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { type BrowserContextOptions, closeBrowser, newContext, type Page } from "../../viewer/e2e/page";
import { obstacles } from "./obstacles";
import { type Host, host } from "./site";

const SITE = process.env["SITE"] ?? "";
const SHOTS = process.env["SHOTS"] ?? "";
const DESKTOP = { width: 1280, height: 800 };
const PHONE = { width: 390, height: 844 };
/** Pages of which pictures are taken, and which are tried with a screen reader's rules. */
const SHOWN = [
  "index",
  "docs/index",
  "docs/OUTPUTS",
  "docs/PHYSICAL_WALK",
  "docs/MODEL_CARD",
  "docs/BENCHMARKS",
  "python",
  "search",
  "gallery",
];
/** Parts that only the whole site has: the documents alone link to them all the same. */
const OTHER_PARTS = ["index.html", "api/ambulo/index.html"].filter((name) => !existsSync(join(SITE, name)));

after(closeBrowser);

/** Opens a page of a new host of the site, passes both to `use`, and closes them. */
async function onSite(options: BrowserContextOptions, use: (site: Host, page: Page) => Promise<void>): Promise<void> {
  const site = await host(SITE);
  const opened = await newContext(options);
  opened.setDefaultTimeout(60_000);
  try {
    await use(site, await opened.newPage());
  } finally {
    await opened.close();
    site.close();
  }
}

/**
 * Follows all links of the documents in the browser. Returns what leads nowhere, and how many addresses were visited.
 */
async function walked(site: Host, page: Page, start: string): Promise<{ dead: string[]; visited: Set<string> }> {
  const dead: string[] = [];
  const visited = new Set<string>();
  const ids = new Map<string, Set<string>>();
  const wanted: { from: string; place: string; heading: string }[] = [];
  const waiting = [{ from: "", place: start }];
  const others = OTHER_PARTS.map((name) => site.address + name);
  for (let next = waiting.pop(); next; next = waiting.pop()) {
    const { from, place } = next;
    if (visited.has(place) || others.includes(place)) {
      continue;
    }
    visited.add(place);
    if (!(await page.request.get(place)).ok()) {
      dead.push(`${from}: ${place}`);
      continue;
    }
    if (!place.startsWith(`${site.address}documents/`) || !place.endsWith(".html")) {
      continue;
    }
    await page.goto(place);
    const found = await page.evaluate(() => ({
      ids: Array.from(document.querySelectorAll("[id]"), ({ id }) => id),
      links: Array.from(document.querySelectorAll<HTMLAnchorElement>("a[href]"), ({ href }) => href),
      sources: Array.from(document.querySelectorAll<HTMLImageElement | HTMLScriptElement>("[src]"), ({ src }) => src),
    }));
    ids.set(place, new Set(found.ids));
    for (const link of [...found.links, ...found.sources].map((link) => new URL(link))) {
      if (`${link.origin}/` === site.address) {
        const to = `${link.origin}${link.pathname}`;
        waiting.push({ from: place, place: to });
        wanted.push({ from: place, place: to, heading: decodeURIComponent(link.hash.slice(1)) });
      }
    }
  }
  for (const { from, place, heading } of wanted) {
    const known = ids.get(place);
    if (heading !== "" && known && !known.has(heading)) {
      dead.push(`${from}: ${place}#${heading}`);
    }
  }
  return { dead, visited };
}

test("every link of the documents leads to a page and its heading, and no page complains", async (context) => {
  await onSite({ viewport: PHONE }, async (site, page) => {
    const complaints: string[] = [];
    page.on("pageerror", (error) => complaints.push(`${page.url()}: ${error}`));
    page.on("console", (message) => complaints.push(`${page.url()}: ${message.text()}`));
    const { dead, visited } = await walked(site, page, `${site.address}documents/docs/index.html`);
    context.diagnostic(
      `${visited.size} pages, pictures and other files; not here: ${OTHER_PARTS.join(", ") || "none"}`,
    );
    assert.deepEqual(dead, []);
    assert.deepEqual(complaints, []);
    assert.ok(visited.size > 90, "the documents are reached");
    // A link and a heading that are broken on the way are found.
    await page.route("**/docs/index.html", async (route) => {
      const answer = await route.fetch();
      const body = (await answer.text())
        .replace("OPTIMAL.html", "NOWHERE.html")
        .replace(/id="by-kind"/, 'id="by-sort"');
      await route.fulfill({ response: answer, body: `${body}<a href="#by-kind">kind</a>` });
    });
    const broken = await walked(site, page, `${site.address}documents/docs/index.html`);
    assert.ok(broken.dead.some((link) => link.endsWith("NOWHERE.html")));
    assert.ok(broken.dead.some((link) => link.endsWith("#by-kind")));
  });
});

test("the search of the documents finds the parts that have all words, from any page", async () => {
  await onSite({ viewport: DESKTOP }, async (site, page) => {
    await page.goto(`${site.address}documents/docs/measured/PEOPLE.html`);
    await page.fill("header input", "knee adduction");
    await page.press("header input", "Enter");
    await page.waitForSelector("[data-ready] #found a");
    assert.equal(await page.inputValue("#question"), "knee adduction");
    const titles = await page.locator("#found a").allTextContents();
    assert.ok(
      titles.some((title) => title.includes("The load of a knee")),
      titles.join("; "),
    );
    await page.fill("#question", "zweihundertvierzig");
    assert.match((await page.textContent("#count")) ?? "", /^No part/);
    await page.fill("#question", "markers.swap");
    await page.locator("#found a").first().click();
    assert.match(page.url(), /FINDINGS\.html/);
  });
});

for (const colorScheme of ["light", "dark"] as const) {
  for (const [device, viewport] of Object.entries({ desktop: DESKTOP, phone: PHONE })) {
    test(`documents, ${device}, ${colorScheme}: accessible, and not wider than the window`, async () => {
      await onSite({ viewport, colorScheme }, async (site, page) => {
        mkdirSync(SHOTS, { recursive: true });
        const present = SHOWN.filter((name) => existsSync(join(SITE, `documents/${name}.html`)));
        for (const name of present) {
          await page.goto(`${site.address}documents/${name}.html`);
          const wide = await page.evaluate(() => document.documentElement.scrollWidth);
          assert.ok(wide <= viewport.width, `${name} is ${wide} wide`);
          await page.screenshot({ path: join(SHOTS, `web-${device}-${colorScheme}-${name.replace("/", "-")}.png`) });
          assert.deepEqual(await obstacles(page), [], name);
        }
      });
    });
  }
}
