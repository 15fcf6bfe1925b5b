// Guesses what each dropped file is for and makes the words of the command from that. The command itself reads and checks the files; a
// wrong guess can be changed on the page.

/** Role of a file. Most are named like the option of the command that takes the file. */
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

/** The visitor's statements besides the files, as typed; may be empty. */
export interface Stated {
  /** Body mass [kg]. */
  mass: string;
  /** Stature [m]. */
  height: string;
  /** Further options of the command. */
  more: string;
}

/** Roles whose files are the value of the option with this name. */
const OPTIONS = [
  "model",
  "static",
  "grf",
  "loads",
  "setup",
  "marker-set",
  "markers",
  "smpl",
  "person",
  "thresholds",
  "device",
] as const satisfies readonly Role[];

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

/** The words of a line as a shell would split them. */
export function splitWords(line: string): string[] {
  const found = line.match(/(?:"[^"]*"|'[^']*'|[^\s"'])+/g) ?? [];
  return found.map((word) => word.replace(/"([^"]*)"|'([^']*)'/g, "$1$2"));
}

/** A file name that no command takes for an option. */
function path(name: string): string {
  return name.startsWith("-") ? `./${name}` : name;
}

/** The words of the command for these files, without the name of the program. */
export function wordsFor(files: readonly Dropped[], { mass, height, more }: Stated): string[] {
  const names = (role: Role): string[] => files.filter((file) => file.role === role).map(({ name }) => path(name));
  const option = (name: string, value: string): string[] => (value.trim() === "" ? [] : [`--${name}`, value.trim()]);
  const end = [...splitWords(more), "-o", "out"];
  if (names("scene").length > 0) {
    return ["simulate", ...names("scene"), ...end];
  }
  const size = [...option("mass", mass), ...option("height", height)];
  if (names("gait").length > 0 && names("recording").length === 0) {
    return ["walk", ...names("gait").flatMap((name) => ["--gait", name]), ...size, ...end];
  }
  const options = OPTIONS.flatMap((role) => names(role).flatMap((name) => [`--${role}`, name]));
  return ["forces", ...names("recording"), ...options, ...size, ...end];
}

/** The words of the command for a walk with these options and values. */
export function wordsOfWalk(options: readonly (readonly [option: string, value: string])[]): string[] {
  return ["walk", ...options.flatMap(([option, value]) => [`--${option}`, value]), "-o", "out"];
}

/** A command line as it is typed in a shell. */
export function commandLine(words: readonly string[]): string {
  const quoted = words.map((word) => (/^[\w./\\+=:@%,~-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`));
  return ["ambulo", ...quoted].join(" ");
}
