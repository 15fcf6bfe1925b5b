// Guesses what each dropped file is for and makes a request from that. The command itself reads and checks the request and the files; a
// wrong guess can be changed on the page.

import type { Request } from "./request";

/** Role of a file. */
export const ROLES = {
  recording: "recording",
  static: "standing trial",
  model: "model",
  grf: "ground forces",
  loads: "external loads",
  setup: "set-up of OpenSim",
  "marker-set": "marker set of OpenSim",
  markers: "marker set of Ambulo",
  smpl: "SMPL model",
  person: "calibration of the person",
  thresholds: "limits of the person",
  device: "moments of a device",
  gait: "gait of a walk",
  scene: "scene to simulate",
  trials: "statements about the trials",
  named: "named by another file",
  unused: "not used",
} as const;

export type Role = keyof typeof ROLES;

/** A file by its name and content. */
export interface Named {
  name: string;
  bytes: Uint8Array;
}

/** A dropped file. */
export interface Dropped extends Named {
  role: Role;
}

/** The visitor's statements about the person, as typed; may be empty. */
export interface Stated {
  /** Body mass [kg]. */
  mass: string;
  /** Stature [m]. */
  height: string;
}

/** So much of a file is searched for words [bytes]. */
const BEGINNING = 1 << 16;

/** The beginning of a file as text; bytes that are no text do no harm. */
function beginning({ bytes }: Named): string {
  return new TextDecoder().decode(bytes.subarray(0, BEGINNING));
}

function ending({ name }: Pick<Named, "name">): string {
  return name.slice(name.lastIndexOf(".") + 1).toLowerCase();
}

function roleOfXml(text: string): Role {
  if (/<(\w+Tool|IMUPlacer)[\s>]/.test(text)) {
    return "setup";
  }
  return /<ExternalLoads[\s>]/.test(text) || !/<MarkerSet[\s>]/.test(text) ? "loads" : "marker-set";
}

function roleOfToml(text: string): Role {
  if (/^\[\[(body|figure|obstacle)\]\]/m.test(text)) {
    return "scene";
  }
  if (/^leg_length_m\b/m.test(text)) {
    return "person";
  }
  if (/^landmark\b/m.test(text)) {
    return "markers";
  }
  return /^(base\b|\[\[(joint|machine)\]\])/m.test(text) ? "gait" : "thresholds";
}

/** Whether the columns of a table are forces, as OpenSim and most laboratories name them. */
function hasForces(text: string): boolean {
  return /ground_force|force_v[xyz]|(^|[\s,])\w*_v[xyz]([\s,]|$)/im.test(text);
}

/** Kind of a file by its own content. */
function roleOf(file: Named): Role {
  switch (ending(file)) {
    case "osim":
      return "model";
    case "xml":
      return roleOfXml(beginning(file));
    case "toml":
      return file.name === "trials.toml" ? "trials" : roleOfToml(beginning(file));
    case "mot":
    case "sto":
    case "csv":
      return hasForces(beginning(file)) ? "grf" : "recording";
    default:
      return "recording";
  }
}

/** The files with their likely roles. `walks` returns whether a foot strikes or leaves the ground in a recording of markers. */
export async function withRoles(files: readonly Named[], walks: (file: Named) => Promise<boolean>): Promise<Dropped[]> {
  const out: Dropped[] = files.map((file) => ({ ...file, role: roleOf(file) }));
  const with_ = (role: Role): Dropped[] => out.filter((file) => file.role === role);
  const setups = with_("setup").map(beginning);
  const loads = with_("loads").map(beginning);
  const isIn = (texts: string[], { name }: Named): boolean => texts.some((text) => text.includes(name));
  for (const file of out) {
    if (file.role !== "setup" && (isIn(setups, file) || (file.role === "grf" && isIn(loads, file)))) {
      file.role = "named";
    }
  }
  const markers = with_("recording").filter(hasMarkers);
  if (markers.length > 1) {
    const walking = await Promise.all(markers.map(walks));
    const first = markers[Math.max(walking.indexOf(true), 0)];
    const standing = markers.find((file, index) => !walking[index] && file !== first);
    for (const [index, file] of markers.entries()) {
      if (file !== first && !walking[index]) {
        file.role = file === standing ? "static" : "unused";
      }
    }
  }
  return out;
}

function hasMarkers(file: Pick<Named, "name">): boolean {
  return ["c3d", "trc"].includes(ending(file));
}

/** The folder in which the command writes its results. */
export const OUTPUT = "out";

/** The folder of a visit, if its files were not dropped as a folder. */
export const VISIT = "visit";

/** Endings of files that the command reads: only these are taken from a dropped folder. */
const READ = "b3d bvh c3d csv json mot mvnx npz osim sto toml trc tsv xml".split(" ");

/** Whether a file of a dropped folder is taken. */
export function isRead(name: string): boolean {
  return !name.startsWith(".") && READ.includes(ending({ name }));
}

/** A number as typed, in a field with this name. */
function numberOf(name: string, typed: string, example: string): number | null {
  const text = typed.trim();
  const number = Number(text);
  if (!Number.isFinite(number)) {
    throw new Error(`${name}: found "${text}"; expected a number, such as ${example}.`);
  }
  return text === "" ? null : number;
}

/** Whether these files are a visit: several walks of one person. */
export function isVisit(files: readonly Dropped[]): boolean {
  return files.filter((file) => file.role === "recording" && hasMarkers(file)).length > 1;
}

/** The request for these files; those of a visit are in a folder with the name `visit`. */
export function requestFor(files: readonly Dropped[], stated: Stated, visit: string = VISIT): Request {
  const mass = numberOf("Body mass", stated.mass, "75");
  const height = numberOf("Stature", stated.height, "1.75");
  if (isVisit(files)) {
    const own = { source: [visit], output: OUTPUT };
    return { session: { own, job: { size: { mass_kg: mass, height_m: height } } } };
  }
  const names = (role: Role): string[] => files.filter((file) => file.role === role).map(({ name }) => name);
  const only = (role: Role): string | null => {
    const [name, second] = names(role);
    if (second !== undefined) {
      throw new Error(
        `${name} and ${second}: found two files as "${ROLES[role]}"; expected one. Change what they are.`,
      );
    }
    return name ?? null;
  };
  const scene = only("scene");
  if (scene !== null) {
    return { simulate: { scene, output: OUTPUT } };
  }
  const [gait, recording] = [only("gait"), only("recording")];
  if (gait !== null && recording === null) {
    return { walk: { gait: { gait }, figure: { mass, height }, output: OUTPUT } };
  }
  const job = {
    recording,
    standing: only("static"),
    model: only("model"),
    marker_set: only("marker-set"),
    markers: only("markers"),
    size: { mass_kg: mass, height_m: height },
    smpl: only("smpl"),
    forces: { table: only("grf"), loads: only("loads") },
    person: only("person"),
    device: only("device"),
    thresholds: only("thresholds"),
    setups: names("setup"),
  };
  return { forces: { job, output: OUTPUT } };
}
