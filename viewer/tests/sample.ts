import {
  FORMAT,
  type Group,
  type Page,
  type PageCycle,
  type PageEvent,
  type PageMachine,
  type PagePeriod,
  type PageSide,
  type Panel,
  type RedSpan,
  type Series,
  type Session,
  type Table,
} from "../src/contract";
import type { Block } from "./block";

const STEP_S = 0.01;
const FRAMES = 420;
const START_S = 0.25;
const STRIDE_S = 1.12;
const TOE_OFF = 0.62;

/** An invented quantity: a sum of harmonics of the stride. */
interface Quantity {
  readonly id: string;
  readonly title: string;
  readonly unit: string;
  readonly positive: string;
  readonly negative: string;
  readonly wave: (phase: number) => number;
}

const wave =
  (mean: number, ...parts: readonly (readonly [number, number])[]) =>
  (phase: number): number =>
    mean + parts.reduce((sum, [size, at], i) => sum + size * Math.cos(2 * Math.PI * (i + 1) * (phase - at)), 0);
const hump = (phase: number): number =>
  phase > TOE_OFF
    ? 0
    : (1.05 + 0.18 * Math.cos((4 * Math.PI * phase) / TOE_OFF + Math.PI)) *
      Math.sin((Math.PI * phase) / TOE_OFF) ** 0.4;

const q = (id: string, title: string, unit: string, signs: string, f: (phase: number) => number): Quantity => {
  const [positive = "", negative = ""] = signs.split(" ");
  return { id, title, unit, positive, negative, wave: f };
};

const KINEMATICS: readonly Quantity[] = [
  q("pelvis_tilt", "Pelvic tilt", "deg", "anterior posterior", wave(9, [0.4, 0.1], [1.2, 0.2])),
  q("pelvis_list", "Pelvic obliquity", "deg", "up down", wave(0, [3.5, 0.12], [1.1, 0.1])),
  q("pelvis_rotation", "Pelvic rotation", "deg", "internal external", wave(0, [5, 0.02])),
  q("hip_flexion", "Hip flexion", "deg", "flexion extension", wave(12, [20, 0.93], [3, 0.05])),
  q("hip_adduction", "Hip adduction", "deg", "adduction abduction", wave(-1, [4.5, 0.25], [1.5, 0.1])),
  q("hip_rotation", "Hip rotation", "deg", "internal external", wave(2, [4, 0.4], [1, 0.3])),
  q("knee_flexion", "Knee flexion", "deg", "flexion extension", wave(24, [20, 0.78], [16, 0.2], [4, 0.3])),
  q(
    "ankle_flexion",
    "Ankle dorsiflexion",
    "deg",
    "dorsiflexion plantarflexion",
    wave(3, [5, 0.33], [8, 0.4], [3, 0.05]),
  ),
];
const KINETICS: readonly Quantity[] = [
  q("hip_moment", "Hip flexion moment", "N.m/kg", "extensor flexor", wave(0.03, [0.55, 0.06], [0.2, 0.1])),
  q(
    "knee_moment",
    "Knee flexion moment",
    "N.m/kg",
    "extensor flexor",
    wave(0.05, [0.15, 0.14], [0.25, 0.12], [0.1, 0.1]),
  ),
  q("ankle_moment", "Ankle flexion moment", "N.m/kg", "plantarflexor dorsiflexor", (p) =>
    p > TOE_OFF ? 0 : 1.45 * (p / 0.48) ** 2 * (p < 0.48 ? 1 : Math.max(0, (TOE_OFF - p) / 0.14)),
  ),
  q("hip_adduction_moment", "Hip abduction moment", "N.m/kg", "abductor adductor", (p) => 0.8 * hump(p)),
  q("hip_power", "Hip power", "W/kg", "generated absorbed", wave(0.2, [0.5, 0.1], [0.6, 0.1], [0.2, 0.2])),
  q("knee_power", "Knee power", "W/kg", "generated absorbed", wave(-0.2, [0.3, 0.2], [0.5, 0.4], [0.4, 0.2])),
  q("ankle_power", "Ankle power", "W/kg", "generated absorbed", (p) =>
    p > TOE_OFF ? 0 : p < 0.4 ? -0.7 * Math.sin((Math.PI * p) / 0.4) : 3.1 * Math.sin((Math.PI * (p - 0.4)) / 0.22),
  ),
];
const GROUND: readonly Quantity[] = [
  q("ground_vertical", "Vertical ground force", "BW", "up down", hump),
  q("ground_forward", "Forward ground force", "BW", "forward backward", (p) =>
    p > TOE_OFF ? 0 : -0.2 * Math.sin((2 * Math.PI * p) / TOE_OFF),
  ),
  q("ground_lateral", "Medial ground force", "BW", "medial lateral", (p) => (p > TOE_OFF ? 0 : 0.06 * hump(p))),
];

/** Settings in which sessions differ. */
export interface Variant {
  readonly name: string;
  /** Scale of all values. */
  readonly scale: number;
  /** Whether the session has cycles, or only values over time. */
  readonly cycles: boolean;
  /** Whether some time is not feasible. */
  readonly red: boolean;
}

/** A leg with two states, and an arm that rests. */
function machines(): PageMachine[] {
  const end = START_S + (FRAMES - 1) * STEP_S;
  const periods: PagePeriod[] = [];
  for (let from_s = START_S, state = 0; from_s < end; state = 1 - state) {
    const to_s = Math.min(from_s + STRIDE_S * (state === 0 ? TOE_OFF : 1 - TOE_OFF), end);
    periods.push({ state, from_s, to_s });
    from_s = to_s;
  }
  return [
    { name: "right leg", states: ["stance", "swing"], periods },
    { name: "right arm", states: ["rest"], periods: [{ state: 0, from_s: START_S, to_s: end }] },
  ];
}

/** A page of invented sessions that contains every kind of element. */
export function samplePage(block: Block, variants: readonly Variant[]): Page {
  const title = variants.map((variant) => variant.name).join(" / ");
  return { format: FORMAT, program: "0.0.0", title, sessions: variants.map((variant) => session(block, variant)) };
}

function session(block: Block, variant: Variant): Session {
  const red = variant.red ? redSpans() : [];
  const group = (
    id: string,
    title: string,
    columns: number,
    quantities: readonly Quantity[],
    note: string | null,
  ): Group => ({
    id,
    title,
    note,
    columns,
    panels: quantities.map((quantity) => panel(block, quantity, variant, red)),
  });
  return {
    name: variant.name,
    data: variant.red
      ? { state: "doubtful", reasons: ["the residual force is 24 % of body weight (at most 20 %)"] }
      : { state: "good", reasons: [] },
    outcome: [],
    glance: {
      facts: [
        { label: "Recording", value: variant.name, note: null },
        { label: "Speed", value: "1.25 m/s", note: null },
        { label: "Largest asymmetry", value: "4 %", note: "Step length, larger right" },
      ],
      deviations: ["Knee flexion, left: 1.8 SD from normal; most at 72 % of the cycle, 48 instead of 60 deg"],
      norm: "SD: root mean square over the cycle, in standard deviations.",
    },
    header: header(),
    source: variant.scale === 1 ? "predicted" : "measured",
    time: { start_s: START_S, step_s: STEP_S, frames: FRAMES },
    events: events(),
    cycles: variant.cycles ? cycles() : [],
    machines: variant.cycles ? machines() : [],
    groups: [
      group("kinematics", "Joint angles", 4, KINEMATICS, null),
      group("kinetics", "Joint moments and powers", 4, KINETICS, "Internal moments: moments of muscles and ligaments."),
      group("ground", "Ground forces", 3, GROUND, null),
    ],
    tables: [timeTable(variant), extracted(variant)],
    quality: {
      facts: [
        {
          label: "Residual force at the pelvis",
          value: "14.2 N (1.9 % BW)",
          allowed: "below 5 % of the greatest ground force",
          good: true,
        },
        { label: "Marker error, mean", value: "31 mm", allowed: "below 20 mm", good: false },
        { label: "Required friction coefficient", value: "0.31", allowed: null, good: null },
      ],
      groups: [emptyGroup(block)],
      tables: [],
      findings: [
        {
          code: "ground.predicted",
          severity: "note",
          message: "The ground forces were predicted from the motion.",
          count: 1,
        },
        {
          code: "markers.gap",
          severity: "warning",
          message: "Marker <b>RASI</b> was filled over 12 frames.",
          count: 3,
        },
      ],
      assumptions: ["In double support the forces are shared by a smooth transition.", "The floor is level at 0 m."],
    },
    feasibility: {
      state: variant.red ? "infeasible" : "feasible",
      sentence: variant.red
        ? "A person of this size could not do this: 3 spans exceed the limits."
        : "A person could do this.",
      red,
      closest: table(
        "closest",
        "Nearest to the limits",
        ["Check", "Used [%]", "When [s]", "Where"],
        [
          ["strength", "112", "1.32", "ankle, right"],
          ["friction", "62", "2.10", "left foot"],
        ],
      ),
    },
    view: null,
    missing: variant.cycles ? [] : ["There is no whole gait cycle: curves are shown over time only."],
  };
}

function header(): Session["header"] {
  const fact = (label: string, value: string, note: string | null = null): Session["header"][number] => ({
    label,
    value,
    note,
  });
  return [
    fact("Subject", "S07 <script>alert(1)</script>"),
    fact("Body mass", "72.8 kg", "weighed by plates"),
    fact("Height", "1.78 m"),
    fact("Leg length", "0.93 m"),
    fact("Speed", "1.31 m/s", "from the pelvis"),
    fact("Cadence", "107 steps/min"),
    fact("Direction", "along +x"),
    fact("Model", "gait2392, scaled"),
    fact("Filter", "Butterworth, 6 Hz, zero lag"),
    fact("Double support", "smooth transition"),
  ];
}

function panel(block: Block, quantity: Quantity, variant: Variant, red: readonly RedSpan[]): Panel {
  const value = (side: PageSide, phase: number, n: number): number =>
    variant.scale *
    quantity.wave(phase) *
    (1 + (side === "l" ? 0.06 : 0) + 0.09 * Math.sin(3 * n + (side === "l" ? 1 : 0)));
  const percents = Array.from({ length: 101 }, (_, i) => i / 100);
  const all = variant.cycles ? cycles() : [];
  const { wave: _, ...words } = quantity;
  const origin = { file: "cycles.csv", column: quantity.id, factor: 1 };
  const mean = (side: PageSide): number[] => {
    const own = all.filter((cycle) => cycle.side === side);
    return percents.map((p) => own.reduce((sum, { number }) => sum + value(side, p, number), 0) / own.length);
  };
  const trace = (side: PageSide): number[] =>
    Array.from({ length: FRAMES }, (_, i) => {
      const phase = (i * STEP_S - offset(side)) / STRIDE_S;
      return value(side, phase - Math.floor(phase), Math.floor(phase) + 1);
    });
  const sides: readonly PageSide[] = ["r", "l"];
  return {
    ...words,
    cycles: all.map(({ side, number }) => ({
      side,
      number,
      values: block.add(percents.map((p) => value(side, p, number))),
      origin,
    })),
    means: (all.length > 0 ? sides : []).map((side) => ({
      side,
      cycles: 3,
      values: block.add(mean(side)),
      sd: null,
      foot_off_percent: side === "r" ? 61.6 : 63.2,
    })),
    band: quantity.id === "pelvis_tilt" ? null : band(block, quantity.wave),
    traces: sides.map((side) => ({
      name: side === "r" ? "right" : "left",
      side,
      role: "main",
      values: block.add(trace(side)),
      sd: block.add(trace(side).map((x) => 0.03 + 0.05 * Math.abs(x))),
      predicted: [],
      origin,
    })),
    red: red.filter((span) => span.panel === quantity.id),
    empty: null,
  };
}

function band(block: Block, f: (phase: number) => number): Panel["band"] {
  const places = Array.from({ length: 51 }, (_, i) => i / 50);
  const values = places.map((p) => 0.95 * f(p));
  const reach = Math.max(...values) - Math.min(...values);
  const sd: Series = block.add(places.map(() => 0.09 * reach));
  return {
    mean: block.add(values),
    sd,
    citation: "Example and Sample 2018 (doi:10.0/0), 24 adults, 1.2 to 1.4 m/s; made up for this test",
  };
}

function emptyGroup(block: Block): Group {
  const none = { cycles: [], means: [], band: null, red: [], traces: [], positive: "", negative: "" };
  const residual = Array.from({ length: FRAMES }, (_, i) => 12 + 6 * Math.sin(i / 9));
  const limit = Array.from({ length: FRAMES }, () => 36);
  const trace = (name: string, role: "main" | "limit", values: number[]): Panel["traces"][number] => ({
    name,
    side: null,
    role,
    values: block.add(values),
    sd: null,
    predicted: [],
    origin: null,
  });
  return {
    id: "residuals",
    title: "Residuals",
    note: "Force at the root that nothing supplies.",
    columns: 3,
    panels: [
      {
        ...none,
        id: "residual",
        title: "Residual force",
        unit: "N",
        traces: [trace("residual", "main", residual), trace("limit", "limit", limit)],
        empty: null,
      },
      {
        ...none,
        id: "plates_predicted",
        title: "Plates against prediction",
        unit: "BW",
        empty: "There were no force plates.",
      },
    ],
  };
}

function redSpans(): RedSpan[] {
  return [
    {
      from_s: 1.3,
      to_s: 1.44,
      side: "r",
      check: "strength",
      panel: "ankle_moment",
      sentence: "The right ankle needs 1.52 N.m/kg, 1.36 N.m/kg is possible.",
    },
    {
      from_s: 2.4,
      to_s: 2.52,
      side: "r",
      check: "strength",
      panel: "ankle_moment",
      sentence: "The right ankle needs 1.48 N.m/kg, 1.36 N.m/kg is possible.",
    },
    {
      from_s: 2.05,
      to_s: 2.15,
      side: "l",
      check: "friction",
      panel: "ground_forward",
      sentence: "The left foot needs a friction coefficient of 0.71, 0.60 is possible.",
    },
  ];
}

function offset(side: PageSide): number {
  return side === "r" ? 0.2 : 0.2 + STRIDE_S / 2;
}

function cycles(): PageCycle[] {
  return (["r", "l"] as const).flatMap((side) =>
    Array.from({ length: side === "r" ? 3 : 2 }, (_, i) => {
      const start = START_S + offset(side) + i * STRIDE_S;
      return { side, number: i + 1, start_s: start, end_s: start + STRIDE_S, foot_off_percent: 100 * TOE_OFF };
    }),
  );
}

function events(): PageEvent[] {
  return cycles()
    .flatMap(({ side, start_s }) => [
      { side, strike: true, time_s: start_s },
      { side, strike: false, time_s: start_s + TOE_OFF * STRIDE_S },
    ])
    .sort((a, b) => a.time_s - b.time_s);
}

function timeTable({ scale }: Variant): Table {
  const made = table(
    "time_distance",
    "Time and distance",
    ["", "Right", "Left", "Normal"],
    [
      ["Step length [m]", (0.71 * scale).toFixed(2), (0.69 * scale).toFixed(2), "0.64–0.80"],
      ["Stride time [s]", "1.12", "1.12", "1.02–1.18"],
      ["Stance [%]", "61.6", "63.2", "58.9–62.5"],
      ["Double support [%]", "12.4", "12.4", "8.8–12.6"],
    ],
  );
  const left = made.rows[2]?.[2];
  const rows = made.rows.map((row) => row.map((cell) => (cell === left ? { ...cell, outside: true } : cell)));
  return { ...made, rows, note: "Normal: mean ± 2 SD of 24 adults at 1.2 to 1.4 m/s (Example and Sample 2018)." };
}

function extracted({ scale }: Variant): Table {
  return table(
    "extracted",
    "Extracted values",
    ["", "Right", "Left", "Difference"],
    [
      [
        "Knee flexion, greatest in swing [deg]",
        (62.1 * scale).toFixed(1),
        (60.4 * scale).toFixed(1),
        (1.7 * scale).toFixed(1),
      ],
      ["Hip, range of flexion [deg]", (42.0 * scale).toFixed(1), (43.1 * scale).toFixed(1), "−1.1"],
      ["Ankle power, greatest [W/kg]", (3.12 * scale).toFixed(2), (3.3 * scale).toFixed(2), "−0.18"],
    ],
  );
}

function table(id: string, title: string, columns: string[], rows: readonly (readonly string[])[]): Table {
  const number = (text: string): number | null => (/^[−\d.]+$/.test(text) ? Number(text.replace("−", "-")) : null);
  const cells = rows.map((row) => row.map((text, i) => ({ text, value: i > 0 ? number(text) : null, outside: false })));
  return { id, title, note: null, columns, rows: cells, empty: null };
}
