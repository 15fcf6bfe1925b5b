import type { Context } from "./context";
import type { PageSide, Session } from "./contract";
import { element } from "./element";
import { pixels, predictedDash, type Scheme, sideLook } from "./look";
import type { Panels } from "./panels";
import { areaSample, lineSample } from "./sample";
import { colour, onThemeChange, STYLE, sessionColour } from "./style";

/** The legend of colours and dashes; follows the theme and the reader's choices. */
export function legend(context: Context, panels: Panels): HTMLElement {
  const list = element("ul", { class: "legend", "aria-label": "Legend" });
  const fill = (): void =>
    list.replaceChildren(...entries(context, panels).map((entry) => element("li", {}, ...entry)));
  fill();
  onThemeChange(fill);
  context.display.subscribe(fill);
  return list;
}

function entries(context: Context, panels: Panels): (Node | string)[][] {
  const { sessions } = context.page;
  const sides = context.display.sides.filter((side) => hasSide(sessions, side));
  const scheme: Scheme = { sessions: sessions.length, sides };
  const entry = (word: string, side: PageSide | null, session: number): (Node | string)[] => {
    const { colour, dash } = sideLook({ side, session }, scheme);
    return [lineSample(colour, dash), word];
  };
  const lines =
    sessions.length === 1
      ? sides.map((side) => entry(side === "r" ? "right" : "left", side, 0))
      : [
          ...sessions.map((one, i) => entry(one.name, sides.length === 1 ? (sides[0] ?? null) : "r", i)),
          ...(sides.length > 0 ? [[sideWords(sides)]] : []),
        ];
  const red = sessions.some((session) =>
    session.groups.some((group) => group.panels.some((panel) => panel.red.length > 0)),
  );
  const wrong = red ? [[lineSample(colour("infeasible"), [], pixels(STYLE.lines_pt.infeasible)), "not feasible"]] : [];
  return [...lines, ...(context.display.axis === "cycle" ? overCycle(context, panels) : overTime(context)), ...wrong];
}

/** Whether any curve of a side is drawn. */
export function hasSide(sessions: readonly Session[], side: PageSide): boolean {
  const groups = sessions.flatMap((session) => [...session.groups, ...session.quality.groups]);
  return groups.some((group) =>
    group.panels.some((panel) => [...panel.means, ...panel.traces].some((curve) => curve.side === side)),
  );
}

function sideWords(sides: readonly PageSide[]): string {
  return sides.length > 1 ? "solid: right, dashed: left" : sides[0] === "r" ? "right side" : "left side";
}

function overCycle({ page }: Context, panels: Panels): (Node | string)[][] {
  const curves = page.sessions.length === 1 ? "thin: each cycle, thick: mean" : "means of the cycles";
  const band = panels.citations().length > 0 ? [[areaSample(colour("band"), 1), "normative, mean ± 1 SD"]] : [];
  const bySession = page.sessions.map((session) =>
    session.groups.flatMap((group) => group.panels.flatMap((panel) => panel.activity ?? [])),
  );
  const activities = bySession.flat();
  // Where several sessions share a panel, electromyograms are left out.
  const alone = bySession.filter((own) => own.length > 0).length === 1;
  const measured = alone && activities.some((activity) => activity.measured.length > 0);
  const usual = activities.some((activity) => activity.usual.length > 0);
  return [
    [curves],
    ...band,
    ...(measured
      ? [[lineSample(colour("measured"), [], pixels(STYLE.lines_pt.axis)), "measured (electromyogram)"]]
      : []),
    ...(usual ? [[areaSample(colour("quiet"), 1), "grey bars: usually active"]] : []),
    ...(alone && activities.some((activity) => activity.recorded.length > 0)
      ? [[areaSample(colour("right"), 1), areaSample(colour("left"), 1), "bars: electromyogram is on"]]
      : []),
    ["ticks below: foot off"],
  ];
}

function overTime({ page }: Context): (Node | string)[][] {
  const traces = page.sessions.flatMap((session) =>
    [...session.groups, ...session.quality.groups].flatMap((group) => group.panels.flatMap((panel) => panel.traces)),
  );
  const measured = traces.some((trace) => trace.role === "measured");
  const uncertain = traces.some((trace) => trace.sd !== null);
  const predicted = traces.some((trace) => trace.predicted.length > 0);
  return [
    ...(predicted ? [[lineSample(colour("text"), predictedDash()), "predicted ground forces"]] : []),
    ...(measured ? [[lineSample(colour("measured"), [], pixels(STYLE.lines_pt.axis)), "measured"]] : []),
    ...(uncertain
      ? [
          [
            areaSample(page.sessions.length > 1 ? sessionColour(0) : colour("right"), STYLE.uncertainty_opacity),
            "± 1 SD of the value",
          ],
        ]
      : []),
    ...(page.sessions.length === 1 && page.sessions.some((one) => one.events.length > 0)
      ? [["ticks below: foot strike (short), foot off (long)"]]
      : []),
  ];
}
