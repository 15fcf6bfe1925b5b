import type { Context } from "./context";
import type { PageSide } from "./contract";
import { element, svgElement } from "./element";
import { citations } from "./groups";
import { pixels, type Scheme, sideLook } from "./look";
import { colour, onThemeChange, STYLE } from "./style";

/** What colours and dashes mean; follows theme and choices. */
export function legend(context: Context): HTMLElement {
  const list = element("ul", { class: "legend", "aria-label": "Legend" });
  const fill = (): void => list.replaceChildren(...entries(context).map((entry) => element("li", {}, ...entry)));
  fill();
  onThemeChange(fill);
  context.display.subscribe(fill);
  return list;
}

function entries(context: Context): (Node | string)[][] {
  const { sessions } = context.page;
  const { sides } = context.display;
  const scheme: Scheme = { sessions: sessions.length, sides };
  const entry = (word: string, side: PageSide | null, session: number): (Node | string)[] => {
    const { colour, dash } = sideLook({ side, session }, scheme);
    return [sample(colour, dash), word];
  };
  const band = citations(sessions).length > 0 ? [[swatch(), "normal, mean ± 1 SD"]] : [];
  if (sessions.length === 1) {
    const lines = sides.map((side) => entry(side === "r" ? "right" : "left", side, 0));
    return [...lines, ["thin: each cycle, thick: mean"], ...band, ["ticks below: toe-off"]];
  }
  const ofSession = sessions.map((session, i) => entry(session.name, sides.length === 1 ? (sides[0] ?? null) : "r", i));
  const words = sides.length > 1 ? ["solid: right, dashed: left"] : [sides[0] === "r" ? "right side" : "left side"];
  return [...ofSession, words, ["means of the cycles"], ...band];
}

function sample(ink: string, dash: readonly number[]): SVGElement {
  const line = svgElement("line", {
    x1: 0,
    x2: 26,
    y1: 5,
    y2: 5,
    stroke: ink,
    "stroke-width": pixels(STYLE.lines_pt.mean),
    ...(dash.length > 0 ? { "stroke-dasharray": dash.join(" ") } : {}),
  });
  return svgElement("svg", { width: 26, height: 10, "aria-hidden": "true" }, line);
}

function swatch(): SVGElement {
  const box = svgElement("rect", { width: 18, height: 10, fill: colour("band") });
  return svgElement("svg", { width: 18, height: 10, "aria-hidden": "true" }, box);
}
