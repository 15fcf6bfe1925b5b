import { Color } from "three";
import looks from "../../../crates/ambulo-report/data/report/style.json";
import type { PageSide } from "../contract";

/** Colours of the view in one theme. */
export interface Palette {
  dark: boolean;
  /** Trunk and other bodies without a side. */
  neutral: Color;
  right: Color;
  left: Color;
  /** Limbs: the side's colour mixed with the neutral colour. */
  rightLimb: Color;
  leftLimb: Color;
  measured: Color;
  infeasible: Color;
  paper: Color;
  text: Color;
  grid: Color;
  plate: Color;
  obstacle: Color;
  /** A muscle at rest and a fully active one: different in hue and lightness, for colour-blind eyes too. */
  rest: Color;
  active: Color;
  sessions: Color[];
}

interface Pair {
  color: string;
  dark: string;
}

/** Share of a side's colour in its limbs. */
const TINT = 0.75;
/** The same share for the left limbs if both sides have the session's colour. */
const PALE = 0.35;

/** The colours of a theme. In a comparison, the figure has the colour of its session's curves, and its left side is paler. */
export function palette(dark: boolean, compared: boolean): Palette {
  const of = (pair: Pair): Color => new Color(dark ? pair.dark : pair.color);
  const neutral = new Color(dark ? "#b9c1ca" : "#d3d8de");
  const own = looks.sessions[0] ?? looks.right;
  const right = of(compared ? own : looks.right);
  const left = of(compared ? own : looks.left);
  return {
    dark,
    neutral,
    right,
    left,
    rightLimb: neutral.clone().lerp(right, TINT),
    leftLimb: neutral.clone().lerp(left, compared ? PALE : TINT),
    measured: of(looks.measured),
    infeasible: of(looks.infeasible),
    paper: of(looks.paper),
    text: of(looks.quiet),
    grid: new Color(dark ? "#4c545d" : "#a3adb8"),
    plate: new Color(dark ? "#6f7b88" : "#8d99a6"),
    obstacle: new Color(dark ? "#a58b52" : "#c9a968"),
    rest: new Color(dark ? "#5c7c9c" : "#7d98b5"),
    active: new Color(dark ? "#ff4b3e" : "#c8001e"),
    sessions: looks.sessions.map(of),
  };
}

/** Full colour of a side. */
export function sideColor(colors: Palette, side: PageSide | null): Color {
  if (side === "r") return colors.right;
  return side === "l" ? colors.left : colors.text;
}

/** Colour of a limb. */
export function limbColor(colors: Palette, side: PageSide | null): Color {
  if (side === "r") return colors.rightLimb;
  return side === "l" ? colors.leftLimb : colors.neutral;
}
