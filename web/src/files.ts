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

function ending({ name }: Named): string {
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
      return roleOfToml(beginning(file));
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
  const markers = with_("recording").filter((file) => ["c3d", "trc"].includes(ending(file)));
  if (markers.length > 1) {
    const walking = await Promise.all(markers.map(walks));
    const recording = markers[Math.max(walking.indexOf(true), 0)];
    const standing = markers.find((file, index) => !walking[index] && file !== recording);
    for (const file of markers.filter((file) => file !== recording)) {
      file.role = file === standing ? "static" : "unused";
    }
  }
  return out;
}

/** The folder in which the command writes its results. */
export const OUTPUT = "out";

/** A number as typed; other text stays, so that the command refuses it with the name of its field. */
function numberOf(typed: string): number | null {
  const text = typed.trim();
  const number = Number(text);
  return text === "" ? null : Number.isFinite(number) ? number : (text as unknown as number);
}

/** The request for these files. */
export function requestFor(files: readonly Dropped[], stated: Stated): Request {
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
  const [mass, height] = [numberOf(stated.mass), numberOf(stated.height)];
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
