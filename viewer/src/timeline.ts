import type { Context } from "./context";
import type { PageSide } from "./contract";
import { element } from "./element";

/** The whole recording as a strip: stances of both feet, infeasible spans, and a slider for the time. */
export function timeline(context: Context): HTMLElement {
  const { clock, first } = context;
  const length = Math.max(clock.end - clock.start, clock.step);
  const part = (time: number): number => Math.min(Math.max((100 * (time - clock.start)) / length, 0), 100);
  const bar = (kind: string, from: number, to: number): HTMLElement => {
    const made = element("div", { class: `stance ${kind}` });
    made.style.left = `${part(from)}%`;
    made.style.width = `${Math.max(part(to) - part(from), 0.3)}%`;
    return made;
  };
  const strip = element("div", { class: "strip", "aria-hidden": "true" });
  for (const side of ["r", "l"] as const) {
    strip.append(...stances(context, side).map(([from, to]) => bar(side, from, to)));
  }
  strip.append(...(first.feasibility?.red ?? []).map((span) => bar("red", span.from_s, span.to_s)));
  const slider = element("input", {
    type: "range",
    "aria-label": "Time",
    min: clock.start,
    max: clock.end,
    step: "any",
  });
  slider.addEventListener("input", () => {
    // Pausing calls all listeners, and the one below resets the slider to the clock's time.
    const wanted = Number(slider.value);
    clock.pause();
    clock.seek(wanted);
  });
  clock.subscribe(() => {
    slider.value = String(clock.time);
    slider.setAttribute("aria-valuetext", `${clock.time.toFixed(2)} seconds`);
  });
  return element("div", { class: "timeline" }, strip, slider);
}

/** Stances from foot strike to foot off, cut at the ends of the recording. */
function stances(context: Context, side: PageSide): [number, number][] {
  const found: [number, number][] = [];
  const own = context.first.events.filter((event) => event.side === side);
  let from: number | null = own[0]?.strike === false ? context.clock.start : null;
  for (const event of own) {
    if (event.strike) {
      from = event.time_s;
    } else if (from !== null) {
      found.push([from, event.time_s]);
      from = null;
    }
  }
  return from === null ? found : [...found, [from, context.clock.end]];
}
