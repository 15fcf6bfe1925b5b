import assert from "node:assert/strict";
import { type ChildProcessWithoutNullStreams, spawn } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { test } from "node:test";
import { HANGS, newContext, PAGES, type Page, PHONE, picture, SHOTS } from "./page";
import { program } from "./pages.mjs";

/** The demo's recording, which `makePages` writes. */
const INPUT = join(PAGES, "demo", "input");
const RATE_HZ = 100;
const SMALL_DESKTOP = { width: 1280, height: 800 };

/** Lines of a stream of the recorded walk: the names, then a frame each. */
function lines(): { heading: string; frames: string[] } {
  const text = readFileSync(join(INPUT, "walk.mot"), "utf8").split("\n");
  const rows = text.slice(text.findIndex((line) => line.trim() === "endheader") + 1).filter((line) => line.trim());
  const cells = rows.map((row) => row.trim().split(/\s+/).slice(1));
  const names = cells.shift() ?? [];
  return {
    heading: JSON.stringify({ coordinates: names, angles: "deg" }),
    frames: cells.map((values) => `[${values.join(",")}]`),
  };
}

/** The command with its page. */
interface Running {
  process: ChildProcessWithoutNullStreams;
  address: string;
}

async function started(page: string): Promise<Running> {
  const child = spawn(program(), ["stream", join(INPUT, "figure.osim"), "--rate", `${RATE_HZ}`, `--page=${page}`]);
  child.stdout.resume();
  // Frames that wait when the command is ended would hide why a test has failed.
  child.stdin.on("error", () => {});
  const said = [];
  for await (const line of createInterface({ input: child.stderr })) {
    const found = /http:\S+/.exec(line);
    if (found) return { process: child, address: found[0] };
    said.push(line);
  }
  throw new Error(`the command named no page: ${said.join(" ")}`);
}

/** The command at a port that another one has just left, started again as long as it is refused, as a person would. */
async function startedAgain(port: string, trials = 50): Promise<Running> {
  try {
    return await started(port);
  } catch (error) {
    if (trials <= 1) throw error;
    await new Promise((done) => setTimeout(done, 100));
    return startedAgain(port, trials - 1);
  }
}

/** Sends the walk in real time, again and again, until it is told to end. The numbers of the frames begin at zero each time, as for a new recording. */
function send({ process }: Running): () => void {
  const { heading, frames } = lines();
  process.stdin.write(`${heading}\n`);
  const begun = Date.now();
  let frame = 0;
  const timer = setInterval(() => {
    for (; frame < ((Date.now() - begun) * RATE_HZ) / 1000; frame += 1) {
      const number = frame % frames.length;
      // Frame 50 of the first time is lost.
      if (frame !== 50) process.stdin.write(`{"frame": ${number}, "q": ${frames[number]}}\n`);
    }
  }, 10);
  return () => clearInterval(timer);
}

interface LiveWindow {
  ambulo: { shown: { frames: number }; panels: { newest: number[] }[] };
}

const framesOf = (page: Page): Promise<number> =>
  page.evaluate(() => (window as unknown as LiveWindow).ambulo.shown.frames);
const forcesOf = (page: Page): Promise<number[]> =>
  page.evaluate(() => (window as unknown as LiveWindow).ambulo.panels[0]?.newest ?? []);
const stateOf = (page: Page): Promise<string> =>
  page.evaluate(() => document.querySelector<HTMLElement>(".live-status")?.dataset["state"] ?? "");
const until = (page: Page, state: string): Promise<unknown> =>
  page.waitForFunction(
    (wanted) => document.querySelector<HTMLElement>(".live-status")?.dataset["state"] === wanted,
    state,
  );

for (const [device, viewport, colorScheme] of [
  ["desktop", SMALL_DESKTOP, "light"],
  ["phone", PHONE, "dark"],
] as const) {
  test(`a live page moves with the stream, and says when it ends: ${device}, ${colorScheme}`, async () => {
    const running = await started("0");
    const context = await newContext({ viewport, colorScheme });
    let stop = (): void => {};
    try {
      const page = await context.newPage();
      const complaints: string[] = [];
      page.on("pageerror", (error) => complaints.push(String(error)));
      await page.goto(running.address);
      await until(page, "waiting");
      stop = send(running);
      await until(page, "running");
      const most = new Array<number>(2).fill(0);
      const before = await picture(page);
      const wanted = (await framesOf(page)) + 100;
      const carried = (): boolean => most.every((force) => force > 400);
      const end = Date.now() + HANGS;
      while (Date.now() < end && ((await framesOf(page)) < wanted || !carried())) {
        for (const [side, force] of (await forcesOf(page)).entries()) {
          most[side] = Math.max(most[side] ?? 0, force);
        }
        await page.waitForTimeout(50);
      }
      assert.ok(carried(), `forces of ${most} N`);
      const after = await picture(page);
      assert.ok(before.print !== after.print && after.share > 0.01, "the figure moves");
      assert.match((await page.textContent(".live-facts")) ?? "", /delay 70 ms at 100 Hz; 1 frames? lost/);
      await page.keyboard.press("2");
      mkdirSync(SHOTS, { recursive: true });
      await page.screenshot({ path: join(SHOTS, `live-${device}-${colorScheme}.png`) });
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= viewport.width);
      stop();
      running.process.stdin.end();
      await until(page, "lost");
      assert.deepEqual(complaints, []);
    } finally {
      stop();
      running.process.kill();
      await context.close();
    }
  });
}

test("a live page finds the program again", async () => {
  const first = await started("0");
  const context = await newContext({ viewport: SMALL_DESKTOP });
  try {
    const page = await context.newPage();
    await page.goto(first.address);
    await until(page, "waiting");
    first.process.kill();
    await until(page, "lost");
    const second = await startedAgain(new URL(first.address).port);
    try {
      await until(page, "waiting");
      assert.equal(await stateOf(page), "waiting");
    } finally {
      second.process.kill();
    }
  } finally {
    await context.close();
  }
});
