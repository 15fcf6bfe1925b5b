// Tests the page and the documents: `node web/tests/run.mjs SITE [NAME]`. SITE is a folder that build.mjs has written, or one with `documents` alone
// (documents/site.mjs): then only these are tested. AMBULO names the program whose results the
// page's are compared with, SHOTS a folder for screenshots. The browser is Chromium (its path in CHROMIUM), or Firefox (FIREFOX) if BROWSER is firefox.
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const viewer = join(here, "../../viewer");
const { build } = createRequire(join(viewer, "package.json"))("esbuild");
const [site, only] = process.argv.slice(2);
if (!site) {
  throw new Error("usage: node web/tests/run.mjs SITE [NAME]");
}
// The tests import packages of viewer/.
const out = join(viewer, "out/web");
mkdirSync(out, { recursive: true });
const isWhole = existsSync(join(site, "index.html"));
// The documents are the same in every browser.
const isChromium = process.env.BROWSER !== "firefox";
const tests = [...(isWhole ? ["page"] : []), ...(isChromium ? ["documents"] : [])];
await build({
  entryPoints: tests.map((name) => join(here, `${name}.test.ts`)),
  outdir: out,
  outExtension: { ".js": ".mjs" },
  bundle: true,
  packages: "external",
  platform: "node",
  format: "esm",
  target: "node18",
  sourcemap: "inline",
});
const pattern = only ? ["--test-name-pattern", only] : [];
const run = spawnSync(
  process.execPath,
  ["--test", "--test-reporter=spec", ...pattern, ...tests.map((name) => join(out, `${name}.test.mjs`))],
  {
    stdio: "inherit",
    env: { ...process.env, SITE: resolve(site), SHOTS: process.env.SHOTS ?? join(out, "shots") },
  },
);
process.exitCode = run.status ?? 1;
