// Solves walks with the command that the variable AMBULO names.

import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { KEPT, readSolved, type Solved } from "./solved";

/** Instants per second of the walks that are read. */
const RATE_HZ = 500;

/** What the command finds with these words, or what it complains of. */
export async function solve(words: readonly string[]): Promise<Solved | string> {
  const folder = mkdtempSync(join(tmpdir(), "ambulo-family-"));
  const all = ["walk", ...words, "--cycles", "1", "--rate", `${RATE_HZ}`, "--keep", KEPT.join(), "-o", folder];
  try {
    const child = spawn(process.env["AMBULO"] ?? "ambulo", all, { stdio: ["ignore", "ignore", "pipe"] });
    let complained = "";
    child.stderr.on("data", (piece) => {
      complained += piece;
    });
    const code = await new Promise<number | null>((done, failed) => child.on("close", done).on("error", failed));
    if (code !== 0) {
      return complained;
    }
    return readSolved(new Map(readdirSync(folder).map((name) => [name, readFileSync(join(folder, name))])));
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
