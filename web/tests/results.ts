import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, relative } from "node:path";

/** What the program wrote and said. */
export interface Native {
  files: Map<string, Buffer>;
  complained: string;
}

/** Runs the program in a new folder with copies of these files, or with copies in a folder `inside` it. */
export function native(words: string[], inputs: string[] = [], inside = ""): Native {
  const folder = mkdtempSync(join(tmpdir(), "ambulo-web-"));
  try {
    mkdirSync(join(folder, inside), { recursive: true });
    for (const path of inputs) {
      copyFileSync(path, join(folder, inside, basename(path)));
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

/** The largest difference of a number in two texts, divided by the number if that is above 1; infinite if the words differ. */
export function difference(found: string, expected: string): number {
  if (found.replace(NUMBER, "#") !== expected.replace(NUMBER, "#")) {
    return Number.POSITIVE_INFINITY;
  }
  const numbers = (expected.match(NUMBER) ?? []).map(Number);
  const differs = (text: string, index: number): number => {
    const number = numbers[index] ?? 0;
    return Math.abs(Number(text) - number) / Math.max(1, Math.abs(number));
  };
  return (found.match(NUMBER) ?? []).map(differs).reduce((largest, one) => Math.max(largest, one), 0);
}

/** The bytes that do not depend on when or where they were computed: of the summary, all but the hash of the report. */
export function comparable(name: string, content: Buffer): Buffer {
  if (name !== "summary.json") {
    return content;
  }
  const summary = JSON.parse(content.toString("utf8"));
  return Buffer.from(JSON.stringify({ ...summary, files: { ...summary.files, "report.html": null } }));
}
