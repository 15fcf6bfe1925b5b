import { existsSync } from "node:fs";
import { join } from "node:path";
import { after } from "node:test";
import { pathToFileURL } from "node:url";
import {
  type Browser,
  type BrowserContext,
  type BrowserContextOptions,
  chromium,
  firefox,
  type Page,
} from "playwright-core";

export type { BrowserContextOptions, Page };

/** Folder of the result folders and their pages, made by run.mjs. */
export const PAGES = process.env["PAGES"] ?? "";
export const SHOTS = process.env["SHOTS"] ?? "";
export const DESKTOP = { width: 1400, height: 1000 };
export const PHONE = { width: 390, height: 844 };

/** Paths searched for Chromium if the variable CHROMIUM is not set. */
const CHROMIUM = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
/** Paths searched for Firefox if the variable FIREFOX is not set. */
const FIREFOX = ["/usr/bin/firefox-esr", "/usr/bin/firefox"];
/** WebGL without a graphics card. */
const ARGUMENTS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

/** What takes longer does not come; how long a page takes depends on the machine [ms]. */
export const HANGS = 600_000;

let running: Promise<Browser> | null = null;

/** The tests run in Firefox, an unchanged one that is driven by WebDriver BiDi, if the variable BROWSER says so. */
export const IN_FIREFOX = process.env["BROWSER"] === "firefox";

function pathOf(name: "CHROMIUM" | "FIREFOX", paths: string[]): string {
  const path = process.env[name] ?? paths.find((path) => existsSync(path));
  if (!path) {
    throw new Error(`the browser was not found: install it, or set ${name} to its path`);
  }
  return path;
}

/** The browser, which is started when it is first needed. */
export function browser(): Promise<Browser> {
  running ??= IN_FIREFOX
    ? firefox.launch({ channel: "moz-firefox", executablePath: pathOf("FIREFOX", FIREFOX), timeout: HANGS })
    : chromium.launch({ executablePath: pathOf("CHROMIUM", CHROMIUM), args: ARGUMENTS, timeout: HANGS });
  return running;
}

/** A new context of the browser, as a new visitor has it. */
export async function newContext(options: BrowserContextOptions): Promise<BrowserContext> {
  const context = await (await browser()).newContext(options);
  context.setDefaultTimeout(HANGS);
  return context;
}

/** Closes the browser; otherwise this process would not end. */
export async function closeBrowser(): Promise<void> {
  const was = running;
  running = null;
  await (await was)?.close();
}

after(closeBrowser);

/** An open page with its requests and messages. */
export interface Opened {
  page: Page;
  /** Requested addresses. */
  requests: string[];
  /** Console errors and warnings, and exceptions. */
  complaints: string[];
}

/** Opens a result's page, passes it to `use` and closes it; `before` is script that runs first. */
export async function withPage(
  name: string,
  use: (opened: Opened) => Promise<void>,
  options: BrowserContextOptions = {},
  before = "",
): Promise<void> {
  const context = await newContext({ viewport: DESKTOP, ...options });
  try {
    await context.addInitScript(before);
    const page = await context.newPage();
    const opened: Opened = { page, requests: [], complaints: [] };
    page.on("request", (request) => opened.requests.push(request.url()));
    page.on("pageerror", (error) => opened.complaints.push(String(error)));
    page.on("console", (message) => {
      if (message.type() === "error" || message.type() === "warning") {
        opened.complaints.push(message.text());
      }
    });
    await page.goto(addressOf(name));
    await page.waitForFunction(() => document.documentElement.dataset["ready"] === "true");
    await use(opened);
  } finally {
    await context.close();
  }
}

/** Address of a result's page. */
export function addressOf(name: string): string {
  return pathToFileURL(join(PAGES, name, "report.html")).href;
}

/** Waits until the page has drawn. */
export async function drawn(page: Page): Promise<void> {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** The clock's time [s]. */
export function timeOf(page: Page): Promise<number> {
  return page.evaluate(() => window.ambulo.clock.time);
}

/** A hash of the figure's picture, the share of its pixels that differ from the background, and its number of colours. */
export function picture(page: Page): Promise<{ print: number; share: number; colors: number }> {
  return page.evaluate(async () => {
    const image = new Image();
    image.src = window.ambulo.view?.still() ?? "";
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
    pen.drawImage(image, 0, 0);
    const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
    let print = 0;
    let drawn = 0;
    const colors = new Set<number>();
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = [data[i] ?? 0, data[i + 1] ?? 0, data[i + 2] ?? 0];
      print = (Math.imul(print, 31) + r + 256 * g + 65536 * b) | 0;
      if (r !== data[0] || g !== data[1] || b !== data[2]) {
        drawn += 1;
        colors.add(((r >> 4) << 8) | ((g >> 4) << 4) | (b >> 4));
      }
    }
    return { print, share: drawn / (data.length / 4), colors: colors.size };
  });
}

/** Panels, tables and views that contain neither a drawing nor a sentence. */
export function emptyBoxes(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const hasSentence = (box: Element): boolean => (box.querySelector(".empty")?.textContent ?? "").trim().length > 20;
    const panels = [...document.querySelectorAll("figure.panel")].filter(
      (box) => !hasSentence(box) && window.ambulo.panels[box.id.replace("panel-", "")] == null,
    );
    const views = [...document.querySelectorAll(".view")].filter(
      (box) => !hasSentence(box) && !box.querySelector("canvas"),
    );
    const tables = [...document.querySelectorAll("table")].filter((box) => !box.querySelector("tbody tr"));
    const chapters = [...document.querySelectorAll(".chapter")].filter((box) => box.children.length < 2);
    return [...panels, ...views, ...tables, ...chapters].map(
      (box) => box.id || box.className || box.outerHTML.slice(0, 80),
    );
  });
}
