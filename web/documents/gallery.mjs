// The gallery: scenes and figures, each drawn by the command that is printed below it. `ambulo` computes them, and
// Chromium draws the figures in 3-D.
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const CHROMIUM = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
const ARGUMENTS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

/** Name, title, words of the command, pictures: `stage` is the body in 3-D, others are figures of the output. */
const ENTRIES = [
  ["demo", "A walk at free speed", "demo", ["stage", "moments", "ground_forces"]],
  [
    "predicted",
    "Ground forces from motion alone, with plates for comparison",
    "forces demo/input/walk.c3d --static demo/input/standing.c3d --mass 75 --height 1.75 --predict",
    ["prediction"],
  ],
  ["fast", "A fast walk without residual forces", "walk --speed 1.8", ["stage", "sagittal_2col"]],
  ["paper", "The mode of the 1997 paper", "walk --mode paper", ["stage", "gait"]],
  ["pushed", "A walker by its own torques is pushed", "simulate examples/pushed-walker.toml", ["stage"]],
  ["stumble", "A foot meets an edge", "simulate examples/stumble.toml", ["stage"]],
  ["top", "A spinning top", "simulate examples/top.toml", ["bodies", "energy"]],
  ["slope", "Friction holds one block, another slides", "simulate examples/slope.toml", ["bodies", "contacts"]],
  ["four-bar", "A closed loop with a driven crank", "simulate examples/four-bar.toml", ["joints", "closures"]],
  ["pile", "A pile of ten balls", "simulate examples/pile.toml", ["contacts", "energy"]],
];

const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

async function browser() {
  const { chromium } = createRequire(join(root, "viewer/package.json"))("playwright-core");
  const executablePath = process.env.CHROMIUM ?? CHROMIUM.find((path) => existsSync(path));
  if (!executablePath) {
    throw new Error("Chromium was not found: install it, or set CHROMIUM to its path");
  }
  return chromium.launch({ executablePath, args: ARGUMENTS });
}

/** The figure in 3-D on the page of a run. */
async function shot(context, report, picture) {
  const page = await context.newPage();
  await page.goto(pathToFileURL(report).href);
  const stage = page.locator("canvas[role=img]").first();
  await stage.waitFor();
  // The first frames are drawn while the page is laid out.
  await page.waitForTimeout(1500);
  await stage.screenshot({ path: picture });
  await page.close();
}

/** Draws all pictures into a folder of the site; returns the content of the page. `program` is the path of `ambulo`. */
export async function drawGallery(program, folder) {
  const work = mkdtempSync(join(tmpdir(), "ambulo-gallery-"));
  mkdirSync(join(folder, "gallery"), { recursive: true });
  const opened = await browser();
  const context = await opened.newContext({ viewport: { width: 1100, height: 800 }, deviceScaleFactor: 1 });
  const parts = [];
  for (const [name, title, words, figures] of ENTRIES) {
    const given = words.split(" ").map((word) => (word.startsWith("examples/") ? join(root, word) : word));
    const run = spawnSync(program, [...given, "-o", name, "--quiet"], { cwd: work, encoding: "utf8" });
    if (run.status !== 0 && run.status !== 1) {
      throw new Error(`ambulo ${words}: ${run.stderr}`);
    }
    const pictures = [];
    for (const figure of figures) {
      const place = `gallery/${name}-${figure}.${figure === "stage" ? "png" : "svg"}`;
      if (figure === "stage") {
        await shot(context, join(work, name, "report.html"), join(folder, place));
      } else {
        cpSync(join(work, name, "figures", `${figure}.svg`), join(folder, place));
      }
      pictures.push([place, `${title}: ${figure === "stage" ? "the body in 3-D" : figure.replaceAll("_", " ")}`]);
    }
    const images = pictures.map(
      ([place, alt]) => `<a href="${place}"><img src="${place}" alt="${escaped(alt)}" loading="lazy" /></a>`,
    );
    parts.push(
      `<h2 id="${name}">${escaped(title)}</h2>\n<div class="pictures">${images.join("\n")}</div>\n<pre tabindex="0"><code>ambulo ${escaped(words)} -o ${name}</code></pre>`,
    );
  }
  await opened.close();
  rmSync(work, { recursive: true, force: true });
  return `<h1>Gallery</h1>\n<p>Scenes and figures, each made by the command below it when this site was built. A click on a picture shows it alone.</p>\n${parts.join("\n")}`;
}
