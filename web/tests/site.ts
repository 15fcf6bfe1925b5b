import { existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join } from "node:path";
import { type BrowserContextOptions, browser, IN_FIREFOX, type Page } from "../../viewer/e2e/page";

const TYPES: Record<string, string> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".webmanifest": "application/manifest+json",
};

/** A static host of a folder. */
export interface Host {
  address: string;
  /** Paths that were asked for. */
  requests: string[];
  close(): void;
}

/** Serves a folder; `/plain` is an empty page without a policy. */
export async function host(folder: string): Promise<Host> {
  const requests: string[] = [];
  const server = createServer((request, response) => {
    const path = new URL(request.url ?? "/", "http://host").pathname;
    requests.push(path);
    if (path === "/plain") {
      response.writeHead(200, { "Content-Type": "text/html" }).end("<!doctype html><title>plain</title>");
      return;
    }
    const file = join(folder, path.endsWith("/") ? `${path}index.html` : path);
    if (!existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { "Content-Type": TYPES[extname(file)] ?? "application/octet-stream" });
    response.end(readFileSync(file));
  });
  await new Promise<void>((done) => server.listen(0, "localhost", done));
  const { port } = server.address() as AddressInfo;
  const close = (): void => {
    server.closeAllConnections();
    server.close();
  };
  return { address: `http://localhost:${port}/`, requests, close };
}

/** An open page. */
export interface Visit {
  page: Page;
  host: Host;
  /** Console errors and warnings, and exceptions. */
  complaints: string[];
}

/** Opens the page of a new host for a visitor who was never there, and passes it to `use`. */
export async function visit(use: (visit: Visit) => Promise<void>, options: BrowserContextOptions = {}): Promise<void> {
  const site = await host(process.env["SITE"] ?? "");
  const context = await (await browser()).newContext({ viewport: { width: 1280, height: 800 }, ...options });
  try {
    const page = await context.newPage();
    const complaints: string[] = [];
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("console", (message) => {
      const isBad = message.type() === "error" || message.type() === "warning";
      // The machines of tests have no graphics card, and only Chromium draws without.
      if (isBad && !(IN_FIREFOX && /WebGL|^Error$/.test(message.text()))) {
        complaints.push(message.text());
      }
    });
    if (IN_FIREFOX) {
      await page.addInitScript(keepSaved);
    }
    await page.goto(site.address);
    await use({ page, host: site, complaints });
  } finally {
    await context.close();
    site.close();
  }
}

/** Waits until the result with this name is shown; returns what the page says about it. */
export async function shown(page: Page, name: string): Promise<string> {
  await page.waitForFunction((name) => document.documentElement.dataset["shown"] === name, name, { timeout: 120_000 });
  return (await page.textContent("#status")) ?? "";
}

/** Gives the page files and a body mass [kg], and computes. */
export async function compute(page: Page, paths: string[], mass = ""): Promise<void> {
  await page.fill("#mass", mass);
  await page.setInputFiles("#files", paths);
  await page.waitForFunction((count) => document.querySelectorAll("#list li").length >= count, paths.length);
  await page.click("#compute");
}

/** A window with what its page saved last, in Firefox. */
interface Keeping extends Window {
  saved?: { name: string; content: string };
}

/** Keeps what a page saves: Playwright does not see the downloads of Firefox. */
function keepSaved(): void {
  const blobs = new Map<string, Blob>();
  const address = URL.createObjectURL;
  URL.createObjectURL = (blob: Blob): string => {
    const made = address(blob);
    blobs.set(made, blob);
    return made;
  };
  HTMLAnchorElement.prototype.click = async function (): Promise<void> {
    const bytes = new Uint8Array((await blobs.get(this.href)?.arrayBuffer()) ?? []);
    const letters = Array.from(bytes, (byte) => String.fromCharCode(byte));
    (window as Keeping).saved = { name: this.download, content: btoa(letters.join("")) };
  };
}

/** Saves by a button; returns the name and the content of the file. */
export async function saved(page: Page, button: string): Promise<{ name: string; content: Buffer }> {
  if (IN_FIREFOX) {
    await page.evaluate(() => {
      delete (window as Keeping).saved;
    });
    await page.click(button);
    await page.waitForFunction(() => (window as Keeping).saved !== undefined);
    const kept = await page.evaluate(() => (window as Keeping).saved);
    return { name: kept?.name ?? "", content: Buffer.from(kept?.content ?? "", "base64") };
  }
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  return { name: download.suggestedFilename(), content: readFileSync(await download.path()) };
}
