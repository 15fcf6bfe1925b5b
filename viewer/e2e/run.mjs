// Makes pages with the `ambulo` program and opens them in Chromium: compiles e2e/*.test.ts into one file and runs it with node's test
// runner. AMBULO names the program (else the last built one in target/), CHROMIUM the browser, SHOTS a folder for the screenshots.
import { spawnSync } from "node:child_process";
import { mkdirSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { makePages } from "./pages.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const out = join(here, "../out/e2e");
mkdirSync(out, { recursive: true });
const tests = readdirSync(here).filter((name) => name.endsWith(".test.ts"));
// Node 18 does not run `after` outside of suites: a last test closes the browser.
const last =
  'import { test } from "node:test"; import { closeBrowser } from "./page"; test("the browser ends", closeBrowser);';
await build({
  stdin: { contents: [...tests.map((name) => `import "./${name}";`), last].join("\n"), resolveDir: here },
  outfile: join(out, "all.mjs"),
  bundle: true,
  packages: "external",
  platform: "node",
  format: "esm",
  target: "node18",
  sourcemap: "inline",
});
const pages = makePages(join(out, "pages"));
const only = process.argv[2] ? ["--test-name-pattern", process.argv[2]] : [];
const run = spawnSync(process.execPath, ["--test", "--test-reporter=spec", ...only, join(out, "all.mjs")], {
  stdio: "inherit",
  env: { ...process.env, PAGES: pages, SHOTS: process.env.SHOTS ?? join(out, "shots") },
});
process.exitCode = run.status ?? 1;
