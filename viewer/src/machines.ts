import type { Context } from "./context";
import type { PageMachine, PagePeriod } from "./contract";
import { element } from "./element";

/** Number of colours of states; a machine with more states uses them again. */
const COLOURS = 6;
/** Largest number of marks of the time axis. */
const MARKS = 8;

/** The states of all machines over time: one band per machine. Pointing at a band sets the clock; the state at the clock's time is shown. */
export function machines(context: Context): HTMLElement[] {
  const all = context.first.machines;
  if (all.length === 0) {
    return [];
  }
  const heading = "group-machines";
  const note =
    "State of each state machine of the gait over time. Point at a band, or tap it, to show the states at that time.";
  const several = context.page.sessions.length > 1 ? ` These are the machines of ${context.first.name}.` : "";
  const rows = all.map((machine) => row(context, machine));
  return [
    element(
      "section",
      { class: "group machines", "aria-labelledby": heading },
      element("h3", { id: heading }, "State machines"),
      element("p", { class: "note" }, `${note}${several}`),
      ...rows,
      axis(context),
    ),
  ];
}

function row(context: Context, machine: PageMachine): HTMLElement {
  const { clock } = context;
  const now = element("span", { class: "now" });
  const cursor = element("div", { class: "cursor both" });
  const bars = machine.periods.map((period) => bar(context, machine, period));
  const band = element("div", { class: "band", role: "img", "aria-label": summary(machine) }, ...bars, cursor);
  const key = machine.states.map((state, place) => element("li", { class: colourOf(place) }, state));
  const show = (): void => {
    const period = machine.periods.find((one) => clock.time < one.to_s) ?? machine.periods.at(-1);
    const state = period ? (machine.states[period.state] ?? "") : "";
    if (now.textContent !== state) {
      now.textContent = state;
      now.className = `now ${colourOf(period?.state ?? 0)}`;
    }
    cursor.style.transform = "none";
    cursor.style.left = `${percent(context, clock.time).toFixed(2)}%`;
  };
  show();
  clock.subscribe(show);
  seekByPointer(context, band);
  return element(
    "div",
    { class: "machine" },
    element("p", { class: "machine-name" }, element("b", {}, machine.name), " ", now),
    band,
    element("ul", { class: "states", "aria-label": `States of ${machine.name}` }, ...(key.length > 1 ? key : [])),
  );
}

function bar(context: Context, machine: PageMachine, { state, from_s, to_s }: PagePeriod): HTMLElement {
  const [from, to] = [percent(context, from_s), percent(context, to_s)];
  const name = machine.states[state] ?? "";
  const title = `${machine.name}: ${name}, ${from_s.toFixed(2)} to ${to_s.toFixed(2)} s`;
  // The style sheet hides a name that does not fit.
  const made = element("span", { class: `period ${colourOf(state)}`, title }, element("span", {}, name));
  made.style.left = `${from.toFixed(2)}%`;
  made.style.width = `${(to - from).toFixed(2)}%`;
  return made;
}

/** Marks of the time axis at round times. */
function axis(context: Context): HTMLElement {
  const { start, end } = context.clock;
  const step =
    [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60].find((one) => (end - start) / one <= MARKS) ?? (end - start) / MARKS;
  const marks: HTMLElement[] = [];
  for (let time = Math.ceil(start / step - 1e-9) * step; time <= end + 1e-9; time += step) {
    const mark = element("span", {}, `${Number(time.toFixed(2))}`);
    mark.style.left = `${percent(context, time).toFixed(2)}%`;
    marks.push(mark);
  }
  marks.at(-1)?.append(" s");
  return element("div", { class: "machine-axis", "aria-hidden": "true" }, ...marks);
}

/** The pointer sets the clock as in a panel: when it presses or drags, and when it hovers while playback is paused. */
function seekByPointer({ clock }: Context, band: HTMLElement): void {
  const seek = (event: PointerEvent): void => {
    const box = band.getBoundingClientRect();
    clock.seek(clock.start + ((event.clientX - box.left) / Math.max(box.width, 1)) * (clock.end - clock.start));
  };
  band.addEventListener("pointerdown", (event) => {
    clock.pause();
    band.setPointerCapture(event.pointerId);
    seek(event);
  });
  band.addEventListener("pointermove", (event) => {
    if ((event.pointerType === "mouse" && !clock.playing) || event.buttons > 0) {
      seek(event);
    }
  });
}

function percent({ clock }: Context, time: number): number {
  const part = (time - clock.start) / Math.max(clock.end - clock.start, clock.step);
  return 100 * Math.min(Math.max(part, 0), 1);
}

function colourOf(state: number): string {
  return `state-${state % COLOURS}`;
}

/** Text alternative of a band: each state with the number of times that it was entered. */
function summary({ name, states, periods }: PageMachine): string {
  const counts = states.map((state, place) => {
    const count = periods.filter((period) => period.state === place).length;
    return `${state} ${count === 1 ? "once" : `${count} times`}`;
  });
  return `${name} over time: ${counts.join(", ")}`;
}
