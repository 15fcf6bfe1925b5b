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

/** How two files differ. */
export interface Difference {
  /** Their largest difference of a number, divided by the number if that is above 1. */
  largest: number;
  /** How many numbers differ in any bit. */
  count: number;
  /** How many numbers there are. */
  of: number;
}

/** Compares texts number by number; anything else must be the same. */
export function difference(name: string, found: Buffer, expected: Buffer): Difference {
  const [a, b] = [found, expected].map((content) => readable(name, content)) as [string, string];
  if (a.replace(NUMBER, "#") !== b.replace(NUMBER, "#")) {
    throw new Error(`${name}: the words differ`);
  }
  const numbersIn = (text: string): string[] => text.match(NUMBER) ?? [];
  const [numbers, others] = [numbersIn(a), numbersIn(b)];
  const out = { largest: 0, count: 0, of: numbers.length };
  numbers.forEach((text, index) => {
    const [x, y] = [Number(text), Number(others[index])];
    out.count += text === others[index] ? 0 : 1;
    out.largest = Math.max(out.largest, Math.abs(x - y) / Math.max(1, Math.abs(y)));
  });
  return out;
}

/** The text of a file; of the summary without durations and without hashes of files whose last digits differ. */
function readable(name: string, content: Buffer): string {
  if (name !== "summary.json") {
    return content.toString("utf8");
  }
  const summary = JSON.parse(content.toString("utf8"));
  return JSON.stringify({ ...summary, timing_ms: null, files: Object.keys(summary.files) });
}
