import style from "../../crates/ambulo-report/data/report/style.json";
import type { PageSide } from "./contract";

/** Dark or light ground. */
export type Theme = "light" | "dark";

/** A colour on light and on dark ground. */
interface Colour {
  readonly color: string;
  readonly dark: string;
}

/** Names of the colours. */
export type ColourName = "right" | "left" | "band" | "infeasible" | "measured" | "text" | "quiet" | "grid" | "paper";

/** Everything that style.json says. */
export const STYLE = style;

const listeners = new Set<(theme: Theme) => void>();
let chosen: Theme | null = null;
let printing = false;

/** The theme of now: light on paper, what the reader chose, or what the system prefers. */
export function theme(): Theme {
  if (printing) {
    return "light";
  }
  return chosen ?? (systemIsDark().matches ? "dark" : "light");
}

/** Chooses the other theme. */
export function switchTheme(): void {
  chosen = theme() === "dark" ? "light" : "dark";
  applyTheme();
}

/** Light for as long as the page is printed. */
export function setPrinting(now: boolean): void {
  printing = now;
  applyTheme();
}

/** Colour by its name, on the ground of now. */
export function colour(name: ColourName): string {
  return onGround(style[name]);
}

/** Colour of a side; of what has no side that of text. */
export function sideColour(side: PageSide | null): string {
  return side === null ? colour("text") : colour(side === "r" ? "right" : "left");
}

/** Colour of a session compared with others. */
export function sessionColour(session: number): string {
  return onGround(style.sessions[session % style.sessions.length] ?? style.text);
}

/** Calls the listener after every change of theme; the returned function ends that. */
export function onThemeChange(listener: (theme: Theme) => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** Sets the CSS variables `--right`, `--left`, `--paper`, ..., `--own` of the first session compared, and tells the listeners. */
export function applyTheme(): void {
  const root = document.documentElement;
  const now = theme();
  root.dataset["theme"] = now;
  root.style.colorScheme = now;
  const names: ColourName[] = ["right", "left", "band", "infeasible", "measured", "text", "quiet", "grid", "paper"];
  for (const name of names) {
    root.style.setProperty(`--${name}`, colour(name));
  }
  root.style.setProperty("--own", sessionColour(0));
  for (const listener of listeners) {
    listener(now);
  }
}

/** Follows the system's preference as long as nothing was chosen. */
export function followSystem(): void {
  systemIsDark().addEventListener("change", applyTheme);
  applyTheme();
}

function systemIsDark(): MediaQueryList {
  return matchMedia("(prefers-color-scheme: dark)");
}

function onGround(both: Colour): string {
  return theme() === "dark" ? both.dark : both.color;
}
