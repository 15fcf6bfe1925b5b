// Colours of the report page, for the page and the documents.
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

/** Style, script and other data of the report page. */
export const REPORT = join(dirname(fileURLToPath(import.meta.url)), "../crates/ambulo-report/data/report");

/** The colours as CSS. */
export function colours() {
  const style = JSON.parse(readFileSync(join(REPORT, "style.json"), "utf8"));
  const names = {
    paper: style.paper,
    text: style.text,
    quiet: style.quiet,
    accent: style.right,
    left: style.left,
    band: style.band,
    bad: style.infeasible,
    control: style.quiet,
  };
  const rules = (key) =>
    `:root{${Object.entries(names)
      .map(([name, colour]) => `--${name}:${colour[key]}`)
      .join(";")}}`;
  return `${rules("color")}\n@media (prefers-color-scheme: dark){${rules("dark")}}\n`;
}
