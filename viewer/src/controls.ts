import type { Stage } from "./context";
import type { PageSide } from "./contract";
import type { Axis } from "./drawing";
import { button, choice, element } from "./element";
import { icon } from "./icon";
import { hasSide } from "./legend";
import { cycleAt, percentAt } from "./phase";
import { switchTheme } from "./style";
import { timeline } from "./timeline";

/** Playback speeds; 1 is real time. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 2] as const;

/** Camera of the 3-D view. */
export type Camera = "side" | "front" | "free";

/** Actions that the keyboard can trigger too. */
export interface Actions {
  camera(kind: Camera): void;
  faster(steps: number): void;
  help(): void;
}

/** Controls below the figure: playback, speed, time, cameras. */
export function playControls(stage: Stage): {
  readonly bar: HTMLElement;
  readonly actions: Pick<Actions, "camera" | "faster">;
} {
  const { clock, view } = stage;
  const cameras = choice<Camera>(
    "Camera",
    [
      ["side", "Side"],
      ["front", "Front"],
      ["free", "Free"],
    ],
    "side",
    (kind) => view?.setCamera(kind),
  );
  const speeds = speedSelect(stage);
  const camera = (kind: Camera): void => {
    cameras.choose(kind);
    view?.setCamera(kind);
  };
  const row = element(
    "div",
    { class: "row" },
    playButton(stage),
    speeds,
    readout(stage),
    ...(view ? [cameras.group] : []),
  );
  const bar = element("div", { class: "controls", role: "group", "aria-label": "Time" }, timeline(stage), row);
  const faster = (steps: number): void => {
    const now = SPEEDS.findIndex((speed) => speed >= clock.speed);
    clock.speed = SPEEDS[Math.min(Math.max(now + steps, 0), SPEEDS.length - 1)] ?? 1;
  };
  return { bar, actions: { camera, faster } };
}

/** Controls at the top: content of the panels, theme, print, help. */
export function pageControls(stage: Stage, help: () => void): HTMLElement {
  const { display } = stage;
  const axes = choice<Axis>(
    "Horizontal axis",
    [
      ["cycle", "Gait cycle"],
      ["time", "Time"],
    ],
    display.axis,
    (axis) => {
      display.axis = axis;
    },
  );
  const sides = choice<"rl" | PageSide>(
    "Sides",
    [
      ["rl", "Both"],
      ["r", "Right"],
      ["l", "Left"],
    ],
    "rl",
    (which) => {
      display.sides = which === "rl" ? ["r", "l"] : [which];
    },
  );
  display.subscribe(() => axes.choose(display.axis));
  return element(
    "div",
    { class: "page-controls" },
    ...(stage.page.sessions.some((session) => session.cycles.length > 0) ? [axes.group] : []),
    ...(hasSide(stage.page.sessions, "r") && hasSide(stage.page.sessions, "l") ? [sides.group] : []),
    button("Dark or light", icon("theme"), switchTheme),
    button("Print", icon("print"), () => print()),
    button("Help", icon("help"), help),
  );
}

function playButton({ clock }: Stage): HTMLElement {
  const made = button("Play", icon("play"), () => clock.toggle());
  made.className = "play";
  let playing = false;
  clock.subscribe(() => {
    if (playing !== clock.playing) {
      playing = clock.playing;
      made.replaceChildren(icon(playing ? "pause" : "play"));
      made.setAttribute("aria-label", playing ? "Pause" : "Play");
      made.title = playing ? "Pause" : "Play";
    }
  });
  return made;
}

function speedSelect({ clock }: Stage): HTMLElement {
  const options = SPEEDS.map((speed) => element("option", { value: speed }, `${speed}×`));
  const made = element("select", { "aria-label": "Speed", title: "Speed" }, ...options);
  made.value = String(clock.speed);
  made.addEventListener("change", () => {
    clock.speed = Number(made.value);
  });
  clock.subscribe(() => {
    if (made.value !== String(clock.speed)) {
      made.value = String(clock.speed);
    }
  });
  return made;
}

/** Current time, and the percentage of the gait cycle of each side. */
function readout({ clock, first }: Stage): HTMLElement {
  const time = element("span", { class: "time" });
  const sides = (["r", "l"] as const).filter((side) => first.cycles.some((cycle) => cycle.side === side));
  const percents = sides.map((side) => [side, element("span", { class: `percent ${side}` })] as const);
  const fill = (): void => {
    time.textContent = `${clock.time.toFixed(2)} s`;
    for (const [side, text] of percents) {
      const cycle = cycleAt(first.cycles, side, clock.time);
      text.textContent = cycle ? `${Math.round(percentAt(cycle, clock.time))} %` : "–";
      text.title = side === "r" ? "Right gait cycle" : "Left gait cycle";
    }
  };
  fill();
  clock.subscribe(fill);
  return element("span", { class: "now", "aria-hidden": "true" }, time, ...percents.map(([, text]) => text));
}
