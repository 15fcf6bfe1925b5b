// Bundles make.ts and runs it: `node web/family/run.mjs [FILE]`. AMBULO names the program that solves the walks.
import { spawnSync } from "node:child_process";
import { mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const viewer = join(here, "../../viewer");
const { build } = createRequire(join(viewer, "package.json"))("esbuild");
const compiled = join(viewer, "out/web/family.mjs");
mkdirSync(dirname(compiled), { recursive: true });
await build({
  entryPoints: [join(here, "make.ts")],
  outfile: compiled,
  bundle: true,
  platform: "node",
  format: "esm",
  target: "node18",
});
const file = process.argv[2] ?? join(here, "walks.json");
process.exitCode = spawnSync(process.execPath, [compiled, file], { stdio: "inherit" }).status ?? 1;
