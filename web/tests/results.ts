import { spawnSync } from "node:child_process";
import { copyFileSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, relative } from "node:path";

/** What the program wrote and said. */
export interface Native {
  files: Map<string, Buffer>;
  complained: string;
}

/** Runs the program in a new folder with copies of these files. */
export function native(words: string[], inputs: string[] = []): Native {
  const folder = mkdtempSync(join(tmpdir(), "ambulo-web-"));
  try {
    for (const path of inputs) {
      copyFileSync(path, join(folder, basename(path)));
    }
    const { stderr, error } = spawnSync(process.env["AMBULO"] ?? "ambulo", words, { cwd: folder, encoding: "utf8" });
    if (error) {
      throw error;
    }
    const out = join(folder, "out");
    const files = new Map(filesIn(out).map((path) => [relative(out, path), readFileSync(path)]));
    return { files, complained: stderr };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function filesIn(folder: string): string[] {
  try {
    const entries = readdirSync(folder, { withFileTypes: true });
    return entries.flatMap((entry) => {
      const path = join(folder, entry.name);
      return entry.isDirectory() ? filesIn(path) : [path];
    });
  } catch {
    return [];
  }
}

const NUMBER = /[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?/gi;

/** The largest difference of a number in two texts, divided by the number if that is above 1; anything else must be the same. */
export function difference(name: string, found: Buffer, expected: Buffer): number {
  const [a, b] = [readable(name, found), readable(name, expected)];
  if (a.replace(NUMBER, "#") !== b.replace(NUMBER, "#")) {
    throw new Error(`${name}: the words differ`);
  }
  const numbers = b.match(NUMBER) ?? [];
  const differs = (text: string, index: number): number => {
    const [x, y] = [Number(text), Number(numbers[index])];
    // A hash may look like a number that is too large.
    return text === numbers[index] ? 0 : Math.abs(x - y) / Math.max(1, Math.abs(y));
  };
  return (a.match(NUMBER) ?? []).map(differs).reduce((largest, one) => Math.max(largest, one), 0);
}

/** The text of a file; of the summary without durations and without hashes of files whose last digits differ. */
function readable(name: string, content: Buffer): string {
  if (name !== "summary.json") {
    return content.toString("utf8");
  }
  const summary = JSON.parse(content.toString("utf8"));
  return JSON.stringify({ ...summary, timing_ms: null, files: Object.keys(summary.files) });
}
