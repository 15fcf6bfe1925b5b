import assert from "node:assert/strict";
import { test } from "node:test";
import { isRead, requestFor, withRoles } from "../../src/files";
import type { Request } from "../../src/request";

const NOTHING = { mass: "", height: "" };

/** What a request states: fields without a value and empty ones are left out. */
function stated(value: unknown): unknown {
  if (value === null || typeof value !== "object" || Array.isArray(value)) {
    return value;
  }
  const fields = Object.entries(value).map(([name, inner]) => [name, stated(inner)] as const);
  const isStated = (inner: unknown): boolean => inner !== null && inner !== undefined && JSON.stringify(inner) !== "{}";
  return Object.fromEntries(fields.filter(([, inner]) => isStated(inner) && JSON.stringify(inner) !== "[]"));
}

/** The request for files with these contents; `standing` are recordings without a step. */
async function request(files: Record<string, string>, standing: string[] = [], person = NOTHING): Promise<Request> {
  const named = Object.entries(files).map(([name, text]) => ({ name, bytes: new TextEncoder().encode(text) }));
  const dropped = await withRoles(named, async ({ name }) => !standing.includes(name));
  return stated(requestFor(dropped, person)) as Request;
}

/** A request for forces with this job. */
const forces = (job: object): object => ({ forces: { job, output: "out" } });

test("a recording is computed by itself, with what the visitor states", async () => {
  assert.deepEqual(await request({ "walk.c3d": "" }), forces({ recording: "walk.c3d" }));
  const person = { mass: " 60.3", height: "1.58" };
  const expected = forces({ recording: "walk.bvh", size: { mass_kg: 60.3, height_m: 1.58 } });
  assert.deepEqual(await request({ "walk.bvh": "" }, [], person), expected);
});

test("text that is no number is refused with the name of its field", async () => {
  const asked = (person: typeof NOTHING): Promise<Request> => request({ "walk.bvh": "" }, [], person);
  await assert.rejects(asked({ mass: "60 kg", height: "" }), /^Error: Body mass: found "60 kg"; expected a number/);
  await assert.rejects(asked({ mass: "", height: "1,75" }), /^Error: Stature: found "1,75"; expected a number/);
});

test("several walks of one person are a session, with the files in a folder", async () => {
  const session = (job = {}): object => ({ session: { own: { source: ["visit"], output: "out" }, ...job } });
  const files = { "a.c3d": "", "b.c3d": "", "c.c3d": "", "d.c3d": "", "trials.toml": 'person = "A"' };
  assert.deepEqual(await request(files, ["a.c3d", "d.c3d"]), session());
  const person = { mass: "60", height: "" };
  assert.deepEqual(await request(files, [], person), session({ job: { size: { mass_kg: 60 } } }));
});

test("of a dropped folder, the files are taken that the command reads", () => {
  const names = ["walk.c3d", "WALK.C3D", "film.mp4", ".hidden.c3d", "README", "trials.toml"];
  assert.deepEqual(names.filter(isRead), ["walk.c3d", "WALK.C3D", "trials.toml"]);
});

test("of recordings with markers, the one without a step is the standing trial", async () => {
  const expected = forces({ recording: "b.c3d", standing: "a.c3d" });
  assert.deepEqual(await request({ "a.c3d": "", "b.c3d": "" }, ["a.c3d"]), expected);
  assert.deepEqual(await request({ "b.c3d": "", "a.c3d": "" }, ["a.c3d"]), expected);
  assert.deepEqual(await request({ "a.c3d": "", "b.c3d": "", "d.c3d": "" }, ["a.c3d", "d.c3d"]), expected);
  assert.deepEqual(
    await request({ "a.trc": "", "b.trc": "" }, ["a.trc", "b.trc"]),
    forces({ recording: "a.trc", standing: "b.trc" }),
  );
});

test("coordinates come with a model, forces and loads; forces that loads name are not stated", async () => {
  const motion = { "walk.mot": "time\tknee_angle_r\n", "body.osim": "" };
  const grf = { "grf.mot": "time\tground_force_vx\tground_force_px\n" };
  const loads = { "grf.xml": "<OpenSimDocument><ExternalLoads><datafile>grf.mot</datafile></ExternalLoads>" };
  const job = { recording: "walk.mot", model: "body.osim" };
  assert.deepEqual(await request(motion), forces(job));
  assert.deepEqual(await request({ ...motion, ...grf }), forces({ ...job, forces: { table: "grf.mot" } }));
  const both = await request({ ...motion, ...grf, ...loads });
  assert.deepEqual(both, forces({ ...job, forces: { loads: "grf.xml" } }));
  const also = { "grf.xml": `${loads["grf.xml"]}<external_loads_model_kinematics_file>walk.mot</...>` };
  assert.deepEqual(await request({ ...motion, ...grf, ...also }), both);
});

test("set-ups name their files", async () => {
  const files = {
    "ik.xml": "<InverseKinematicsTool><marker_file>walk.trc</marker_file><model_file>body.osim</model_file>",
    "id.xml": "<InverseDynamicsTool name=''><external_loads_file>loads.xml</external_loads_file>",
    "walk.trc": "",
    "body.osim": "",
    "loads.xml": "<ExternalLoads>",
  };
  assert.deepEqual(await request(files), forces({ setups: ["ik.xml", "id.xml"] }));
});

test("files of Ambulo are told apart by their keys", async () => {
  const scene = { simulate: { scene: "fall.toml", output: "out" } };
  assert.deepEqual(await request({ "fall.toml": "step = 0.001\n[[body]]\n" }), scene);
  const walk = { walk: { gait: { gait: "limp.toml" }, output: "out" } };
  assert.deepEqual(await request({ "limp.toml": 'base = "standard"\n[[joint]]\n' }), walk);
  const fields: [string, string][] = [
    ["person", "mass_kg = 60\nleg_length_m = 0.9\n"],
    ["markers", 'name = "lab"\n[[pair]]\nlandmark = "asis"\n'],
    ["thresholds", 'skip = ["sliding"]\n'],
  ];
  for (const [field, text] of fields) {
    assert.deepEqual(await request({ "a.c3d": "", "b.toml": text }), forces({ recording: "a.c3d", [field]: "b.toml" }));
  }
});

test("two files for one purpose are refused by name", () => {
  const models = ["a.osim", "b.osim"].map((name) => ({ name, bytes: new Uint8Array(), role: "model" as const }));
  assert.throws(() => requestFor(models, NOTHING), /a\.osim and b\.osim: found two files as "model"; expected one/);
});
