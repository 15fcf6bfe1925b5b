import style from "../../crates/ambulo-report/data/report/style.json";
import type { PageSide } from "./contract";

/** Dark or light background. */
export type Theme = "light" | "dark";

/** A colour for the light and the dark theme. */
interface Colour {
  readonly color: string;
  readonly dark: string;
}

/** Names of the colours. */
export type ColourName = "right" | "left" | "band" | "infeasible" | "measured" | "text" | "quiet" | "grid" | "paper";

/** Contents of style.json. */
export const STYLE = style;

const listeners = new Set<(theme: Theme) => void>();
let chosen: Theme | null = null;
let printing = false;

/** The current theme: light in print, otherwise the reader's choice or the system's preference. */
export function theme(): Theme {
  if (printing) {
    return "light";
  }
  return chosen ?? (systemIsDark().matches ? "dark" : "light");
}

/** Switches to the other theme. */
export function switchTheme(): void {
  chosen = theme() === "dark" ? "light" : "dark";
  applyTheme();
}

/** Uses the light theme while the page is printed. */
export function setPrinting(now: boolean): void {
  printing = now;
  applyTheme();
}

/** A colour by name, in the current theme. */
export function colour(name: ColourName): string {
  return onGround(style[name]);
}

/** Colour of a side; without a side, the colour of text. */
export function sideColour(side: PageSide | null): string {
  return side === null ? colour("text") : colour(side === "r" ? "right" : "left");
}

/** Colour of a session in a comparison. */
export function sessionColour(session: number): string {
  return onGround(style.sessions[session % style.sessions.length] ?? style.text);
}

/** Calls the listener after every change of theme; the returned function removes it. */
export function onThemeChange(listener: (theme: Theme) => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** Sets the CSS variables `--right`, `--left`, `--paper`, ... and, for the first compared session, `--own`; then calls the listeners. */
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

/** Follows the system's preference until the reader chooses a theme. */
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
