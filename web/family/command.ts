// Solves walks with the command that the variable AMBULO names.

import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Request, WalkArgs } from "../src/request";
import { KEPT, readSolved, type Solved } from "./solved";

/** Instants per second of the walks that are read. */
const RATE_HZ = 500;

/** The walk that the command finds, or what it complains of. */
export async function solve(walk: WalkArgs): Promise<Solved | string> {
  const folder = mkdtempSync(join(tmpdir(), "ambulo-family-"));
  const [output, file] = [join(folder, "out"), join(folder, "request.json")];
  const request: Request = { walk: { ...walk, cycles: 1, rate: RATE_HZ, keep: [...KEPT], output } };
  try {
    writeFileSync(file, JSON.stringify(request));
    const child = spawn(process.env["AMBULO"] ?? "ambulo", ["run", file], { stdio: ["ignore", "ignore", "pipe"] });
    let complained = "";
    child.stderr.on("data", (piece) => {
      complained += piece;
    });
    const code = await new Promise<number | null>((done, failed) => child.on("close", done).on("error", failed));
    if (code !== 0) {
      return complained;
    }
    return readSolved(new Map(readdirSync(output).map((name) => [name, readFileSync(join(output, name))])));
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
