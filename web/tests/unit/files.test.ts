import assert from "node:assert/strict";
import { test } from "node:test";
import { commandLine, splitWords, withRoles, wordsFor } from "../../src/files";

const NOTHING = { mass: "", height: "", more: "" };

/** The command line for files with these contents; `standing` are recordings without a step. */
async function line(files: Record<string, string>, standing: string[] = [], stated = NOTHING): Promise<string> {
  const named = Object.entries(files).map(([name, text]) => ({ name, bytes: new TextEncoder().encode(text) }));
  const dropped = await withRoles(named, async ({ name }) => !standing.includes(name));
  return commandLine(wordsFor(dropped, stated));
}

test("a recording is computed by itself, with what the visitor states", async () => {
  assert.equal(await line({ "walk.c3d": "" }), "ambulo forces walk.c3d -o out");
  const stated = { mass: " 60.3", height: "1.58", more: "--predict --from 0.5" };
  const expected = "ambulo forces walk.bvh --mass 60.3 --height 1.58 --predict --from 0.5 -o out";
  assert.equal(await line({ "walk.bvh": "" }, [], stated), expected);
});

test("of recordings with markers, the one without a step is the standing trial, and one is computed", async () => {
  const expected = "ambulo forces b.c3d --static a.c3d -o out";
  assert.equal(await line({ "a.c3d": "", "b.c3d": "" }, ["a.c3d"]), expected);
  assert.equal(await line({ "b.c3d": "", "a.c3d": "" }, ["a.c3d"]), expected);
  assert.equal(await line({ "a.c3d": "", "b.c3d": "", "c.c3d": "", "d.c3d": "" }, ["a.c3d", "d.c3d"]), expected);
  assert.equal(
    await line({ "a.trc": "", "b.trc": "" }, ["a.trc", "b.trc"]),
    "ambulo forces a.trc --static b.trc -o out",
  );
});

test("coordinates come with a model, forces and loads; forces that loads name need no option", async () => {
  const motion = { "walk.mot": "time\tknee_angle_r\n", "body.osim": "" };
  const forces = { "grf.mot": "time\tground_force_vx\tground_force_px\n" };
  const loads = { "grf.xml": "<OpenSimDocument><ExternalLoads><datafile>grf.mot</datafile></ExternalLoads>" };
  assert.equal(await line(motion), "ambulo forces walk.mot --model body.osim -o out");
  assert.equal(await line({ ...motion, ...forces }), "ambulo forces walk.mot --model body.osim --grf grf.mot -o out");
  const both = await line({ ...motion, ...forces, ...loads });
  assert.equal(both, "ambulo forces walk.mot --model body.osim --loads grf.xml -o out");
  const also = { "grf.xml": `${loads["grf.xml"]}<external_loads_model_kinematics_file>walk.mot</...>` };
  assert.equal(await line({ ...motion, ...forces, ...also }), both);
});

test("set-ups name their files", async () => {
  const files = {
    "ik.xml": "<InverseKinematicsTool><marker_file>walk.trc</marker_file><model_file>body.osim</model_file>",
    "id.xml": "<InverseDynamicsTool name=''><external_loads_file>loads.xml</external_loads_file>",
    "walk.trc": "",
    "body.osim": "",
    "loads.xml": "<ExternalLoads>",
  };
  assert.equal(await line(files), "ambulo forces --setup ik.xml --setup id.xml -o out");
});

test("files of Ambulo are told apart by their keys", async () => {
  assert.equal(await line({ "fall.toml": "step = 0.001\n[[body]]\n" }), "ambulo simulate fall.toml -o out");
  assert.equal(await line({ "limp.toml": 'base = "standard"\n[[joint]]\n' }), "ambulo walk --gait limp.toml -o out");
  const options: [string, string][] = [
    ["person", "mass_kg = 60\nleg_length_m = 0.9\n"],
    ["markers", 'name = "lab"\n[[pair]]\nlandmark = "asis"\n'],
    ["thresholds", 'skip = ["sliding"]\n'],
  ];
  for (const [option, text] of options) {
    assert.equal(await line({ "a.c3d": "", "b.toml": text }), `ambulo forces a.c3d --${option} b.toml -o out`);
  }
});

test("words are split and joined as in a shell", () => {
  assert.deepEqual(splitWords(`--add-mass 'torso:2' --x="a b" c`), ["--add-mass", "torso:2", "--x=a b", "c"]);
  assert.deepEqual(splitWords("  "), []);
  assert.equal(commandLine(["forces", "it's a walk.c3d"]), "ambulo forces 'it'\\''s a walk.c3d'");
});

test("a file name is never taken for an option", async () => {
  assert.equal(await line({ "--force.c3d": "" }), "ambulo forces ./--force.c3d -o out");
});
