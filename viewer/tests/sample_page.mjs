// Writes sample pages for viewing: out/sample.html, out/compare.html, out/bare.html.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const out = join(here, "../out");
const report = join(here, "../../crates/ambulo-report/data/report");
mkdirSync(out, { recursive: true });
await build({
  stdin: {
    contents: 'export { Block } from "./block"; export { samplePage } from "./sample";',
    resolveDir: here,
  },
  outfile: join(out, "sample.mjs"),
  bundle: true,
  platform: "node",
  format: "esm",
});
const { Block, samplePage } = await import(pathToFileURL(join(out, "sample.mjs")).href);

const whole = { name: "walk_03", scale: 1, cycles: true, red: true };
const pages = {
  sample: [whole],
  compare: [
    whole,
    { name: "walk_07 after", scale: 1.15, cycles: true, red: false },
    { name: "walk_09", scale: 0.85, cycles: true, red: false },
  ],
  bare: [{ name: "half a step", scale: 1, cycles: false, red: false }],
};
for (const [name, variants] of Object.entries(pages)) {
  const block = new Block();
  const data = JSON.stringify(samplePage(block, variants)).replaceAll("<", "\\u003c");
  const html = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:">
<title>${name}</title>
<style>${readFileSync(join(report, "viewer.css"), "utf8")}</style>
</head>
<body>
<div id="ambulo"></div>
<script type="application/json" id="ambulo-page">${data}</script>
<script type="application/octet-stream" id="ambulo-numbers">${block.encode()}</script>
<script>${readFileSync(join(report, "viewer.js"), "utf8")}</script>
</body>
</html>
`;
  writeFileSync(join(out, `${name}.html`), html);
}
