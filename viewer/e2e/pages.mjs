// Makes the pages that the tests open, with the program, from synthetic walks and a recording of the repository.
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const repository = join(dirname(fileURLToPath(import.meta.url)), "../..");
const recording = join(repository, "crates/ambulo-cli/tests/recording");

/** Path of the program: the variable AMBULO, or else the program built last. */
export function program() {
  const built = ["release", "debug"].map((profile) => join(repository, "target", profile, "ambulo")).filter(existsSync);
  built.sort((a, b) => statSync(b).mtimeMs - statSync(a).mtimeMs);
  const found = process.env.AMBULO ?? built[0];
  if (!found) {
    throw new Error("no ambulo program: build it with `cargo build -p ambulo-cli`, or name it in AMBULO");
  }
  return found;
}

/** Fills a folder with one result folder per page; returns the folder. */
export function makePages(folder) {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const at = (name) => join(folder, name);
  const ambulo = (...args) => run(program(), args);
  ambulo("demo", "-o", at("demo"));
  const input = at("demo/input");
  const figure = ["--model", join(input, "figure.osim")];
  ambulo("walk", "--cycles", "9", "-o", at("long"));
  ambulo("walk", "--gait", "goose", "--mode", "paper", "-o", at("infeasible"));
  ambulo("walk", "--gait", join(repository, "examples/gaits/limp.toml"), "-o", at("limp"));
  ambulo(
    "forces",
    join(recording, "walk.mot"),
    "--model",
    join(recording, "figure.osim"),
    "--loads",
    join(recording, "walk_grf.xml"),
    "-o",
    at("recording"),
  );
  ambulo(
    "forces",
    join(input, "walk.mot"),
    ...figure,
    "--loads",
    join(input, "walk_grf.xml"),
    "--predict",
    "-o",
    at("predicted"),
  );
  ambulo("forces", join(input, "walk.mot"), ...figure, "--no-ground", "-o", at("no_ground"));
  ambulo(
    "forces",
    join(input, "walk.mot"),
    ...figure,
    "--grf",
    join(input, "walk_grf.mot"),
    "--right",
    "calcn_r:ground_force_r_",
    "-o",
    at("one_leg"),
  );
  ambulo(
    "forces",
    join(input, "walk.mot"),
    ...figure,
    "--loads",
    join(input, "walk_grf.xml"),
    "--from",
    "0.5",
    "--to",
    "0.9",
    "-o",
    at("no_cycles"),
  );
  gaps(join(input, "walk.trc"), at("gaps.trc"));
  ambulo(
    "forces",
    at("gaps.trc"),
    ...figure,
    "--loads",
    join(input, "walk_grf.xml"),
    "--max-gap",
    "0.1",
    "-o",
    at("gaps"),
  );
  hostile(input, folder);
  ambulo(
    "forces",
    at("<img src=x onerror=hacked()>.mot"),
    "--model",
    at("hostile.osim"),
    "--loads",
    join(input, "walk_grf.xml"),
    "-o",
    at("hostile"),
  );
  hostileSummary(at("hostile"));
  ambulo("report", at("hostile"));
  const person = ["--mass", "75", "--height", "1.75"];
  const standing = ["--static", join(input, "standing.c3d")];
  ambulo("forces", join(input, "walk.c3d"), ...standing, ...person, "--muscles", "-o", at("muscles"));
  ambulo("forces", join(input, "walk.c3d"), ...standing, ...person, "--consistent", "-o", at("consistent"));
  ambulo("session", input, "-o", at("session"), "--", ...person);
  ambulo("simulate", join(repository, "examples/stumble.toml"), "-o", at("scene"));
  cpSync(at("demo"), at("compared"), { recursive: true });
  ambulo("walk", "--speed", "0.8", "-o", at("slow"));
  ambulo("report", at("compared"), "--compare", at("slow"));
  return folder;
}

/** Runs the program. */
function run(command, args) {
  const { status, stderr, error } = spawnSync(command, [...args, "--quiet"], { encoding: "utf8" });
  if (error || status !== 0) {
    throw new Error(`${command} ${args.join(" ")}\nended with ${status}: ${error ?? stderr}`);
  }
}

/** Writes a recording without any marker for half a second: `.trc` leaves such fields blank. */
function gaps(from, to) {
  const lines = readFileSync(from, "utf8").split("\n");
  const first = lines.findIndex((line) => /^\d+\t/.test(line));
  const blank = lines.map((line, index) => {
    if (index < first + 150 || index >= first + 200) {
      return line;
    }
    const cells = line.split("\t");
    return [...cells.slice(0, 2), ...cells.slice(2).map(() => "")].join("\t");
  });
  writeFileSync(to, blank.join("\n"));
}

/** Text that would run if the page interpreted it as HTML. */
const SCRIPT = "</script><script>hacked()</script><img src=x onerror=hacked()>";

/** Puts script into the names of file and model. */
function hostile(input, folder) {
  const escaped = SCRIPT.replaceAll("<", "&lt;").replaceAll(">", "&gt;");
  const model = readFileSync(join(input, "figure.osim"), "utf8").replace(
    /<Model name="[^"]*"/,
    `<Model name="${escaped}"`,
  );
  writeFileSync(join(folder, "hostile.osim"), model);
  cpSync(join(input, "walk.mot"), join(folder, "<img src=x onerror=hacked()>.mot"));
}

/** Puts script into every sentence of the summary. */
function hostileSummary(folder) {
  const path = join(folder, "summary.json");
  const within = (value, key) => {
    if (typeof value === "string") {
      return ["message", "motion", "name", "citation", "note", "model", "path"].includes(key)
        ? `${value} ${SCRIPT}`
        : value;
    }
    if (Array.isArray(value)) {
      return value.map((one) => within(one, key));
    }
    return value && typeof value === "object"
      ? Object.fromEntries(Object.entries(value).map(([name, one]) => [name, within(one, name)]))
      : value;
  };
  writeFileSync(path, JSON.stringify(within(JSON.parse(readFileSync(path, "utf8")), "")));
}
