import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, type TestContext, test } from "node:test";
import { fileURLToPath } from "node:url";
import { closeBrowser, IN_FIREFOX, type Page } from "../../viewer/e2e/page";
import { readSolved } from "../family/solved";
import { POINTS, QUANTITIES, type Values, Walks } from "../src/family";
import { obstacles } from "./obstacles";
import { comparable, difference, native } from "./results";
import { compute, host, saved, shown, visit } from "./site";
import { unzip } from "./unit/archive";

// The tests are compiled to viewer/out/web.
const REPOSITORY = fileURLToPath(new URL("../../..", import.meta.url));
const RECORDING = join(REPOSITORY, "crates/ambulo-cli/tests/recording");
const FAMILY = join(REPOSITORY, "web/family/walks.json");
const CHILDREN = join(process.env["AMBULO_DATA"] ?? join(REPOSITORY, "../shared"), "data/biomechzoo-HC032A");
const SHOTS = process.env["SHOTS"] ?? "";
const DESKTOP = { width: 1280, height: 800 };
const PHONE = { width: 390, height: 844 };
/** A walk between those that were solved beforehand: speed [m/s] and mass [kg]. */
const HELD_OUT = { speed: 1.15, mass: 90 };
/** The whole page, compressed [bytes]. */
const LARGEST = 6e6;

/** Files of the demo, written by the program. */
let demo = "";

before(() => {
  demo = mkdtempSync(join(tmpdir(), "ambulo-demo-"));
  for (const [name, content] of native(["demo", "-o", "out"]).files) {
    if (name.startsWith("input/")) {
      writeFileSync(join(demo, name.slice("input/".length)), content);
    }
  }
});

after(() => rmSync(demo, { recursive: true, force: true }));
after(closeBrowser);

/** Compares the bytes of the files that the page saves with those of the program; the report is drawn from the same numbers. */
async function isSame(
  context: TestContext,
  page: Page,
  words: string[],
  inputs: string[],
  inside = "",
): Promise<Map<string, Buffer>> {
  const { content } = await saved(page, "#save-all");
  const found = unzip(content);
  const expected = native(words, inputs, inside).files;
  assert.deepEqual([...found.keys()].sort(), [...expected.keys()].sort());
  const isLeft = (name: string): boolean => /\.(html|c3d)$|^timings\.json$/.test(name);
  const compared = [...expected].filter(([name]) => !isLeft(name));
  for (const [name, bytes] of compared) {
    const [a, b] = [found.get(name) ?? Buffer.of(), bytes].map((content) => comparable(name, content)) as [
      Buffer,
      Buffer,
    ];
    assert.ok(a.equals(b), `${name}: the bytes differ; a number by ${difference(a.toString(), b.toString())}`);
  }
  context.diagnostic(`${compared.length} files have the bytes of the program's`);
  return found;
}

/** Waits until the page shows this command line, which the program writes. */
async function isLine(page: Page, expected: string): Promise<void> {
  await page.waitForFunction((line) => document.querySelector("#line")?.textContent === line, expected);
}

/** Moves the slider of the speed for some seconds; how many different walks were drawn per second. */
async function updates(seconds: number): Promise<number> {
  const slider = document.querySelector<HTMLInputElement>("#walk [name=speed]") as HTMLInputElement;
  const was = slider.value;
  const start = performance.now();
  let [count, last] = [0, ""];
  while (performance.now() < start + 1000 * seconds) {
    slider.value = String(1 + 0.05 * ((count % 9) - 4));
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    const drawn = document.querySelector("#preview .curve")?.getAttribute("d") ?? "";
    count += Number(drawn !== last);
    last = drawn;
    // The frame with this walk.
    await new Promise(requestAnimationFrame);
  }
  slider.value = was;
  return count / seconds;
}

/** Checks that the interpolated walk differs from the exact one by no more than the page states; returns the words of its first panel. */
function isNear(
  context: TestContext,
  files: Map<string, Buffer>,
  at: Pick<Values, "speed" | "height" | "mass">,
): string {
  const walk = new Walks(JSON.parse(readFileSync(FAMILY, "utf8"))).at({ ...at, stepLength: undefined, slope: 0 });
  assert.ok(walk, "a walk of the family");
  const exact = readSolved(files);
  const shares = QUANTITIES.map(({ name }) => {
    const { largest } = walk.error(name);
    const off = Math.max(
      ...walk.curve(name).map((value, index) => Math.abs(value - exact.value(name, index / (POINTS - 1)))),
    );
    assert.ok(off <= largest, `${name}: interpolated with an error of ${off}, stated ${largest}`);
    return off / largest;
  });
  const worst = Math.max(...shares);
  const name = QUANTITIES[shares.indexOf(worst)]?.name;
  context.diagnostic(`interpolated walk: differs by at most ${worst.toFixed(2)} of the stated errors (${name})`);
  const [least, most] = [Math.min(...walk.curve("hip_flexion")), Math.max(...walk.curve("hip_flexion"))];
  return `Hip flexion: from ${least.toFixed(1)} to ${most.toFixed(1)} °`;
}

test("the demo is shown at once and is the program's", async (context) => {
  const times: number[] = [];
  for (let visitor = 0; visitor < 3; visitor++) {
    await visit(async ({ page, complaints }) => {
      await shown(page, "demo");
      // Since the visitor opened the page.
      times.push(await page.evaluate(() => (performance.getEntriesByName("shown")[0]?.startTime ?? Number.NaN) / 1000));
      assert.deepEqual(complaints, []);
      if (visitor === 0) {
        await isSame(context, page, ["demo", "-o", "out"], []);
      }
    });
  }
  const best = Math.min(...times);
  context.diagnostic(`first result of the demo after ${best.toFixed(2)} s, best of ${times.length}`);
});

test("the page is small", async (context) => {
  await visit(async ({ page, host }) => {
    await shown(page, "demo");
    const { gzipSync } = await import("node:zlib");
    // The documents are kept for a visit without a connection, after the page is shown.
    const loaded = [...new Set(host.requests)].filter((path) => path !== "/plain" && !path.startsWith("/documents/"));
    const sizes = loaded.map((path) => {
      const file = join(process.env["SITE"] ?? "", path === "/" ? "index.html" : path);
      return existsSync(file) ? gzipSync(readFileSync(file), { level: 9 }).length : 0;
    });
    const size = sizes.reduce((a, b) => a + b, 0);
    context.diagnostic(`${(size / 1e6).toFixed(2)} MB compressed`);
    assert.ok(size > 1e6 && size <= LARGEST, `${size} bytes`);
  });
});

test("every kind of file gives the program's results", async (context) => {
  const at = (...names: string[]): string[] => names.map((name) => join(demo, name));
  const recorded = ["walk.mot", "figure.osim", "walk_grf.mot", "walk_grf.xml"].map((name) => join(RECORDING, name));
  const cases: [inputs: string[], words: string][] = [
    [at("standing.c3d", "walk.c3d"), "walk.c3d --static standing.c3d --mass 75"],
    [at("walk.trc", "figure.osim"), "walk.trc --model figure.osim --mass 75"],
    [at("walk.bvh"), "walk.bvh --mass 75"],
    [recorded, "walk.mot --model figure.osim --loads walk_grf.xml --mass 75"],
  ];
  for (const [inputs, words] of cases) {
    await visit(async ({ page, complaints }) => {
      await shown(page, "demo");
      await compute(page, inputs, "75");
      await shown(page, "walk");
      await isLine(page, `ambulo forces ${words} -o out`);
      await isSame(context, page, ["forces", ...words.split(" "), "-o", "out"], inputs);
      assert.deepEqual(complaints, []);
    });
  }
});

test("HC032A03: dropped files are told apart, and the result is the program's", async (context) => {
  if (!existsSync(CHILDREN)) {
    context.skip("no data");
    return;
  }
  const [walk, standing] = ["HC032A03.c3d", "HC032A01.c3d"].map((name) => join(CHILDREN, name)) as [string, string];
  await visit(async ({ page }) => {
    await shown(page, "demo");
    await page.setInputFiles("#files", [walk]);
    await page.waitForSelector("#compute:enabled");
    const start = performance.now();
    await page.click("#compute");
    await shown(page, "HC032A03");
    const seconds = (performance.now() - start) / 1000;
    context.diagnostic(`HC032A03 is shown after ${seconds.toFixed(2)} s`);
    await isSame(context, page, ["forces", "HC032A03.c3d", "-o", "out"], [walk]);
    await compute(page, [standing]);
    await isLine(page, "ambulo forces HC032A03.c3d --static HC032A01.c3d -o out");
  });
});

test("an error is the program's text, marks its cause, and goes away with it", async () => {
  const broken = join(demo, "broken.trc");
  writeFileSync(broken, readFileSync(join(demo, "walk.trc"), "utf8").replace("Units", "Ells"));
  await visit(async ({ page }) => {
    await shown(page, "demo");
    await compute(page, [broken]);
    await page.waitForSelector("#error:not([hidden])");
    const { complained } = native(["forces", "broken.trc", "-o", "out"], [broken]);
    assert.match(complained, /^error: broken\.trc/);
    assert.equal(await page.textContent("#error"), complained.trim().replace("error: ", ""));
    const marked = (): Promise<string[]> =>
      page.locator("[aria-invalid]").evaluateAll((all) => all.map((one) => one.id || one.ariaLabel || ""));
    assert.deepEqual(await marked(), ["broken.trc is"]);
    await page.fill("#more", "--nonsense");
    assert.ok(await page.isHidden("#error"), "another option is another input");
    assert.deepEqual(await marked(), []);
    await page.press("#more", "Enter");
    await page.waitForFunction(() => document.querySelector("#error")?.textContent?.includes("--nonsense"));
    assert.deepEqual(await marked(), ["more"]);
    await page.fill("#more", "");
    await page.click("#list button");
    await compute(page, [join(demo, "walk.bvh")]);
    await page.waitForSelector("#error:not([hidden])");
    assert.match((await page.textContent("#error")) ?? "", /fill in the field "Body mass"/);
    assert.deepEqual(await marked(), ["mass"]);
    mkdirSync(SHOTS, { recursive: true });
    await page.screenshot({ path: join(SHOTS, "web-error.png") });
    await page.fill("#mass", "75 kg");
    assert.ok(await page.isHidden("#error"), "another mass is another input");
    await page.click("#compute");
    assert.match((await page.textContent("#error")) ?? "", /^Body mass: found "75 kg"; expected a number/);
    assert.deepEqual(await marked(), ["mass"]);
    await page.fill("#mass", "75");
    await page.click("#compute");
    await shown(page, "walk");
    assert.ok(await page.isHidden("#error"));
    assert.deepEqual(await marked(), []);
  });
});

test("several walks of one person give the page of the session, also from a dropped folder", async (context) => {
  const folder = join(demo, "visit-1");
  mkdirSync(join(folder, "more"), { recursive: true });
  const names = ["first.c3d", "more/second.c3d"];
  for (const [index, name] of names.entries()) {
    // Equal files would be one trial, so the second one ends with an empty block.
    writeFileSync(join(folder, name), Buffer.concat([readFileSync(join(demo, "walk.c3d")), Buffer.alloc(512 * index)]));
  }
  writeFileSync(join(folder, "standing.c3d"), readFileSync(join(demo, "standing.c3d")));
  writeFileSync(join(folder, "film.mp4"), "no recording");
  const paths = [...names, "standing.c3d"].map((name) => join(folder, name));
  await visit(async ({ page, complaints }) => {
    await shown(page, "demo");
    if (IN_FIREFOX) {
      // Playwright cannot drop a folder there.
      await page.setInputFiles("#files", paths);
    } else {
      const client = await page.context().newCDPSession(page);
      const data = { items: [], files: [folder], dragOperationsMask: 1 };
      for (const type of ["dragEnter", "dragOver", "drop"] as const) {
        await client.send("Input.dispatchDragEvent", { type, x: 100, y: 200, data });
      }
    }
    await page.waitForFunction(() => document.querySelectorAll("#list li").length === 3);
    const name = IN_FIREFOX ? "visit" : "visit-1";
    await page.fill("#mass", "75");
    await page.click("#compute");
    await shown(page, name);
    await isLine(page, `ambulo session ${name} -o out -- --mass 75`);
    const session = page.frames().find((frame) => frame.url().startsWith("blob:"));
    assert.match((await session?.textContent("h1")) ?? "", /^Gait session/);
    assert.ok((await page.locator("#pages option").count()) >= 3, "the pages of both trials");
    const words = ["session", name, "-o", "out", "--", "--mass", "75"];
    await isSame(context, page, words, paths, name);
    mkdirSync(SHOTS, { recursive: true });
    await page.screenshot({ path: join(SHOTS, "web-session.png") });
    // A trial in the list leads to its page.
    const link = session?.locator("#trials a").first();
    const trial = decodeURIComponent((await link?.getAttribute("href")) ?? "");
    await link?.click();
    await page.waitForFunction((trial) => document.querySelector<HTMLSelectElement>("#pages")?.value === trial, trial);
    const heading = page.frameLocator("#page iframe").locator("h1").first();
    await heading.waitFor();
    assert.doesNotMatch((await heading.textContent()) ?? "", /^Gait session/);
    assert.deepEqual(complaints, []);
  });
});

/** Tries every way to send something; `address` is a place that would notice. */
async function leak(address: string): Promise<void> {
  const ignore = (): void => {};
  const tries: (() => unknown)[] = [
    () => fetch(`${address}fetch`).catch(ignore),
    () => fetch(`${address}post`, { method: "POST", mode: "no-cors", body: "secret" }).catch(ignore),
    () => {
      const request = new XMLHttpRequest();
      request.open("GET", `${address}xhr`);
      request.send();
    },
    () => new WebSocket(`${address.replace("http", "ws")}socket`),
    () => new EventSource(`${address}events`),
    () => (self as unknown as { importScripts(address: string): void }).importScripts(`${address}worker-script`),
    () => navigator.sendBeacon(`${address}beacon`, "secret"),
    () => {
      new Image().src = `${address}image`;
    },
    ...[
      ["script", "src"],
      ["iframe", "src"],
      ["video", "src"],
      ["object", "data"],
    ].map(([name, key]) => () => {
      const element = document.createElement(name as string);
      element.setAttribute(key as string, `${address}${name}`);
      document.body.append(element);
    }),
    ...["stylesheet", "prefetch", "preload", "preconnect", "manifest"].map((relation) => () => {
      const link = document.createElement("link");
      [link.rel, link.as, link.href] = [relation, "image", `${address}${relation}`];
      document.head.append(link);
    }),
    () => {
      const form = document.createElement("form");
      [form.action, form.method, form.target] = [`${address}form`, "get", "elsewhere"];
      const frame = document.createElement("iframe");
      frame.name = "elsewhere";
      document.body.append(frame, form);
      form.submit();
    },
    () => import(`${address}module`).catch(ignore),
  ];
  for (const one of tries) {
    try {
      await one();
    } catch {
      // Refused; what matters is what arrives.
    }
  }
  await new Promise((done) => setTimeout(done, 500));
}

/** Runs a script in a worker from memory; it says when it is done. */
async function inWorker(script: string): Promise<void> {
  const worker = new Worker(URL.createObjectURL(new Blob([script])));
  await new Promise((done) => worker.addEventListener("message", done));
}

test("nothing leaves the computer: page, worker and report cannot connect to any place", async () => {
  const other = await host("");
  await visit(async ({ page, host }) => {
    await shown(page, "demo");
    await page.evaluate(() => navigator.serviceWorker.ready);
    const report = page.frames().find((frame) => frame.url().startsWith("blob:"));
    const worker = page.workers().find((worker) => worker.url().startsWith("blob:"));
    assert.ok(report && (worker || IN_FIREFOX), "worker and report");
    for (const target of [other, host]) {
      const before = target.requests.length;
      const address = `${target.address}leak/`;
      await page.evaluate(leak, address);
      await report.evaluate(leak, address);
      if (IN_FIREFOX) {
        // Playwright does not reach the worker of the page there; this one is made in the same way.
        await page.evaluate(inWorker, `(${leak})("${address}").then(() => postMessage("done"))`);
      } else {
        await worker?.evaluate(leak, address);
      }
      assert.deepEqual(target.requests.slice(before), []);
    }
    // The same attempts arrive from a page without a policy.
    await page.goto(`${other.address}plain`);
    await page.evaluate(leak, `${other.address}leak/`);
    const arrived = other.requests.filter((path) => path.startsWith("/leak/"));
    assert.ok(arrived.length >= 12, `only ${arrived.join(" ")}`);
  });
  other.close();
});

test("the report is saved as one file that needs nothing else", async () => {
  await visit(async ({ page }) => {
    await shown(page, "demo");
    const { name, content } = await saved(page, "#save-report");
    assert.equal(name, "demo.html");
    const path = join(demo, name);
    writeFileSync(path, content);
    const requests: string[] = [];
    page.on("request", (request) => requests.push(request.url()));
    await page.goto(`file://${path}`);
    await page.waitForFunction(() => document.documentElement.dataset["ready"] === "true");
    assert.deepEqual(
      requests.filter((address) => !/^(file|blob|data):/.test(address)),
      [],
    );
    assert.match((await page.textContent("h1")) ?? "", /free/);
  });
});

test("works without a connection after the first visit", async () => {
  await visit(async ({ page, host }) => {
    await shown(page, "demo");
    await page.evaluate(() => navigator.serviceWorker.ready);
    host.close();
    await page.reload();
    await shown(page, "demo");
    await compute(page, [join(demo, "walk.bvh")], "75");
    await shown(page, "walk");
    await page.click("header nav a");
    await page.waitForSelector("h1");
    await page.click("main a >> nth=0");
    await page.waitForSelector("h1");
    assert.match(page.url(), /\/documents\//);
  });
});

test("a walk that was not solved beforehand leaves the old report, and Stop gives back the sliders", async () => {
  await visit(async ({ page }) => {
    await shown(page, "demo");
    const value = (name: string): Promise<string> => page.locator(`#walk [name=${name}]`).inputValue();
    const before = await Promise.all(["speed", "slope"].map(value));
    // No walk of the family is so steep and fast.
    await page.locator("#walk [name=speed]").fill("1.95");
    await page.locator("#walk [name=slope]").fill("15");
    await page.waitForFunction(() => document.querySelector("#status")?.textContent?.startsWith("No walk near"));
    const isStale = (): Promise<boolean> => page.locator("#page").evaluate((part) => part.classList.contains("stale"));
    assert.ok((await page.isHidden("#preview")) && (await page.isVisible("#page iframe")) && (await isStale()));
    await page.focus("#walk [name=slope]");
    await page.keyboard.press("ArrowLeft");
    await page.waitForSelector("#progress:not([hidden])");
    await page.waitForFunction(() => /^[1-9]\d* s$/.test(document.querySelector("#seconds")?.textContent ?? ""));
    assert.ok((await page.isVisible("#page iframe")) && (await isStale()), "the old report, dimmed");
    mkdirSync(SHOTS, { recursive: true });
    await page.screenshot({ path: join(SHOTS, "web-slow.png") });
    await page.click("#stop");
    await page.waitForFunction(() => document.querySelector("#error")?.textContent?.startsWith("Stopped"));
    assert.deepEqual(await Promise.all(["speed", "slope"].map(value)), before);
    assert.ok((await page.isHidden("#progress")) && !(await isStale()), "the report is that of the sliders again");
  });
});

test("a long computation can be stopped, and the page goes on", async () => {
  await visit(async ({ page }) => {
    await shown(page, "demo");
    await page.fill("#more", "--duration 60");
    await compute(page, [join(REPOSITORY, "examples/pile.toml")]);
    await page.click("#stop");
    await page.waitForFunction(() => document.querySelector("#error")?.textContent?.startsWith("Stopped"));
    await page.click("#demo");
    await page.waitForSelector("#error", { state: "hidden" });
  });
});

test("the keyboard alone is enough", async () => {
  await visit(async ({ page }) => {
    await shown(page, "demo");
    await page.setInputFiles("#files", [join(demo, "walk.bvh")]);
    await page.waitForSelector("#compute:enabled");
    await page.fill("#mass", "75");
    await page.click("h1");
    const reached: string[] = [];
    for (let presses = 0; presses < 24; presses++) {
      await page.keyboard.press("Tab");
      reached.push(await page.evaluate(() => document.activeElement?.id || document.activeElement?.tagName || ""));
    }
    const order = ["files", "SELECT", "mass", "height", "more", "compute", "demo", "save-report", "save-all"];
    assert.deepEqual(
      reached.filter((id) => order.includes(id)),
      order,
    );
    await page.focus("#compute");
    await page.keyboard.press("Enter");
    await shown(page, "walk");
    await page.focus(".skip");
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => document.activeElement?.id), "result");
  });
});

test("a walk follows the sliders", async (context) => {
  await visit(async ({ page, complaints }) => {
    await shown(page, "demo");
    const { walk, mass_kg } = JSON.parse(native(["demo", "-o", "out"]).files.get("summary.json")?.toString() ?? "");
    const value = (name: string): Promise<number> => page.locator(`#walk [name=${name}]`).inputValue().then(Number);
    // A slider shows the nearest of its steps.
    assert.ok(Math.abs((await value("speed")) - walk.speed_asked_m_s) < 0.03);
    assert.ok(Math.abs((await value("step-length")) - walk.step_length_m) < 0.006);
    assert.equal(await value("mass"), mass_kg);
    const rates = [];
    for (let time = 0; time < 3; time++) {
      rates.push(await page.evaluate(updates, 0.5));
    }
    const rate = Math.max(...rates);
    context.diagnostic(`${rate.toFixed(0)} interpolated walks are shown per second`);
    await page.focus("#walk [name=speed]");
    await page.locator("#walk [name=speed]").fill(String(HELD_OUT.speed));
    await page.keyboard.press("ArrowRight");
    await page.locator("#walk [name=mass]").fill(String(HELD_OUT.mass - 1));
    await page.focus("#walk [name=mass]");
    await page.keyboard.press("ArrowRight");
    assert.ok(await page.isVisible("#preview"), "the preview is shown");
    assert.ok(await page.isVisible("#page.stale iframe"), "the report before is dimmed below it");
    const preview = await page.getAttribute("#preview .chart svg", "aria-label");
    await shown(page, "walk");
    assert.ok((await page.isHidden("#preview")) && (await page.isVisible("#page iframe")), "the exact walk is shown");
    context.diagnostic((await page.textContent("#status")) ?? "");
    const speed = await value("speed");
    const words = ["walk", "--speed", String(speed), "--mass", String(HELD_OUT.mass), "-o", "out"];
    await isLine(page, `ambulo ${words.join(" ")}`);
    const files = await isSame(context, page, words, []);
    const height = await value("height");
    assert.equal(isNear(context, files, { speed, height, mass: HELD_OUT.mass }), preview);
    await page.click("#walk button[type=reset]");
    for (const begin of ["Computing the walk", "walk: computed"]) {
      await page.waitForFunction((begin) => document.querySelector("#status")?.textContent?.startsWith(begin), begin);
    }
    assert.deepEqual(complaints, []);
  });
});

test("a walker can be pushed, and falls or not as the program says of the same scene", async (context) => {
  await visit(async ({ page, complaints }) => {
    await shown(page, "demo");
    const note = async (pattern: RegExp): Promise<string> => {
      const matches = ([source]: string[]): boolean =>
        new RegExp(source as string).test(document.querySelector("#stage-note")?.textContent ?? "");
      await page.waitForFunction(matches, [pattern.source], { timeout: 60_000 });
      return (await page.textContent("#stage-note")) ?? "";
    };
    await page.click("#push button");
    await note(/^The walker does not fall/);
    await isLine(page, "ambulo simulate walker.toml --keep poses,contacts -o out");
    await page.waitForSelector("#stage .force.l[d^=M], #stage .force.r[d^=M]", { state: "attached" });
    const picture = await page.locator("#picture svg").boundingBox();
    assert.ok(picture);
    const [x, y] = [picture.x + 0.2 * picture.width, picture.y + 0.5 * picture.height];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 0.1 * picture.width, y, { steps: 3 });
    const start = performance.now();
    await page.mouse.up();
    context.diagnostic(await note(/^1 ball.*does not fall/));
    context.diagnostic(`a push is computed in ${((performance.now() - start) / 1000).toFixed(1)} s`);
    await page.fill("#faster", "20");
    await page.focus("#front");
    await page.keyboard.press("Enter");
    context.diagnostic(await note(/^2 balls.*(fall|fell)/));
    const { name, content } = await saved(page, "#save-scene");
    const path = join(demo, name);
    writeFileSync(path, content);
    const { findings } = JSON.parse(
      native(["simulate", name, "--keep", "poses", "-o", "out"], [path]).files.get("summary.json")?.toString() ?? "",
    );
    const fell = findings.some(({ code }: { code: string }) => code === "figure.fell");
    assert.match((await page.textContent("#stage-note")) ?? "", fell ? /The walker fell/ : /does not fall/);
    mkdirSync(SHOTS, { recursive: true });
    await page.screenshot({ path: join(SHOTS, "web-walker.png") });
    await page.click("#back");
    assert.ok(await page.isVisible("#page iframe"));
    assert.deepEqual(complaints, []);
  });
});

test("a file name is text, never markup", async () => {
  const name = "<img src=x onerror=alert(1)>.bvh";
  const path = join(demo, name);
  writeFileSync(path, readFileSync(join(demo, "walk.bvh")));
  await visit(async ({ page, complaints }) => {
    await shown(page, "demo");
    await compute(page, [path], "75");
    await shown(page, name.replace(".bvh", ""));
    assert.equal(await page.textContent("#list .name"), name);
    assert.equal(await page.locator("img").count(), 0);
    assert.deepEqual(complaints, []);
  });
});

for (const colorScheme of ["light", "dark"] as const) {
  for (const [device, viewport] of Object.entries({ desktop: DESKTOP, phone: PHONE })) {
    test(`${device}, ${colorScheme}: accessible, and not wider than the window`, async () => {
      await visit(
        async ({ page }) => {
          await shown(page, "demo");
          mkdirSync(SHOTS, { recursive: true });
          await page.waitForTimeout(500);
          await page.screenshot({ path: join(SHOTS, `web-${device}-${colorScheme}.png`) });
          await page.setInputFiles("#files", [join(demo, "walk.bvh"), join(demo, "figure.osim")]);
          await page.waitForSelector("#list li");
          await page.evaluate(() => document.querySelector("details")?.setAttribute("open", ""));
          await page.screenshot({ path: join(SHOTS, `web-${device}-${colorScheme}-files.png`) });
          const wide = await page.evaluate(() => document.documentElement.scrollWidth);
          assert.ok(wide <= viewport.width, `${wide} wide`);
          assert.deepEqual(await obstacles(page), []);
          await page.locator("#walk [name=speed]").fill("1");
          await page.waitForSelector("#preview .curve[d]");
          await page.screenshot({ path: join(SHOTS, `web-${device}-${colorScheme}-walk.png`) });
          assert.deepEqual(await obstacles(page), []);
        },
        { viewport, colorScheme },
      );
    });
  }
}
