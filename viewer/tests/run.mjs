// Compiles tests/*.test.ts, also those of the page in web/, and runs them with node's test runner.
import { spawnSync } from "node:child_process";
import { mkdirSync, readdirSync, rmSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const out = join(here, "../out/tests");
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const testsIn = (folder) =>
  readdirSync(folder)
    .filter((name) => name.endsWith(".test.ts"))
    .map((name) => join(folder, name));
const tests = [here, join(here, "../../web/tests/unit")].flatMap(testsIn);
await build({
  entryPoints: tests,
  outdir: out,
  entryNames: "[name]",
  outExtension: { ".js": ".mjs" },
  bundle: true,
  platform: "node",
  format: "esm",
  target: "node18",
  sourcemap: "inline",
  loader: { ".css": "empty" },
});
const compiled = tests.map((path) => join(out, basename(path).replace(/\.ts$/, ".mjs")));
process.exitCode = spawnSync(process.execPath, ["--test", ...compiled], { stdio: "inherit" }).status ?? 1;
