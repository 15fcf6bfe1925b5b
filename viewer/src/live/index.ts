import { Clock } from "../clock";
import type { LiveFrame, LivePage, LiveState, Page } from "../contract";
import { button, element } from "../element";
import type { Numbers } from "../numbers";
import { switchTheme } from "../style";
import { type CameraKind, createView, type View3D } from "../view3d";
import { CurvePanel, SPAN_S } from "./curves";
import { LiveFigure } from "./figure";
import "../css/live.css";

/** The data of a live page; null on a report page. */
export function livePage(): LivePage | null {
  const text = document.getElementById("ambulo-live")?.textContent;
  return text ? (JSON.parse(text) as LivePage) : null;
}

/** State of the connection in a sentence, for each event of it. */
const LOST = "The connection to the program is lost. Trying again.";

const CAMERAS: readonly (readonly [string, CameraKind, string])[] = [
  ["1", "side", "Side"],
  ["2", "front", "Front"],
  ["3", "free", "Free"],
];

/** Draws the page of a motion that is arriving. */
export function live(root: HTMLElement, page: Page, numbers: Numbers, live: LivePage): void {
  const session = page.sessions[0] as Page["sessions"][number];
  const host = element("div", { class: "view" });
  const status = element("p", { class: "live-status", role: "status" });
  const facts = element("p", { class: "live-facts" });
  const panels = live.panels.map((panel) => new CurvePanel(panel));
  const aside = element("section", { class: "live-figure", "aria-label": "Figure" }, host);
  const curves = element("div", { class: "live-curves" }, ...panels.map((panel) => panel.element));
  const nav = element("nav", { class: "live-controls", "aria-label": "View" });
  root.replaceChildren(
    element("header", { class: "live-header" }, element("h1", {}, session.name), status, facts, nav),
    element("main", { class: "live-columns" }, aside, curves),
    element(
      "footer",
      {},
      `Ambulo ${page.program}. Curves of the last ${SPAN_S} s: right solid, left dashed; areas are one standard deviation.`,
    ),
  );
  const clock = new Clock(session.time);
  const figure = new LiveFigure(session.view, numbers, live);
  const view = createView(host, page, figure, clock);
  view.setOptions({ trail: false });
  controls(nav, view);
  const shown = new Shown(status, facts, live);
  connect(shown, (frame) => {
    figure.show(frame);
    for (const panel of panels) {
      panel.add(frame);
    }
    // The clock has one instant; setting it draws the figure again.
    clock.seek(clock.start);
  });
  Object.defineProperty(window, "ambulo", { value: { page, live, view, panels, shown } });
}

/** Buttons and keys of the camera and the theme. */
function controls(nav: HTMLElement, view: View3D): void {
  nav.append(
    ...CAMERAS.map(([, kind, word]) => button(word, word, () => view.setCamera(kind))),
    button("Light or dark", "Light or dark", switchTheme),
  );
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const camera = CAMERAS.find(([key]) => key === event.key);
    if (camera) {
      view.setCamera(camera[1]);
    } else if (event.key === "t" || event.key === "T") {
      switchTheme();
    }
  });
}

/** The words about the stream. */
class Shown {
  /** Frames that came, for tests. */
  frames = 0;

  constructor(
    private readonly status: HTMLElement,
    private readonly facts: HTMLElement,
    private readonly live: LivePage,
  ) {
    this.state({ state: "waiting", message: "connecting" });
    this.count(0, 0);
  }

  state({ state, message }: LiveState): void {
    this.status.dataset["state"] = state;
    this.status.textContent = `${message.charAt(0).toUpperCase()}${message.slice(1)}${message.endsWith(".") ? "" : "."}`;
  }

  count(time: number, lost: number): void {
    const { delay_ms, rate_hz } = this.live;
    this.facts.textContent = `${time.toFixed(1)} s; delay ${Math.round(delay_ms)} ms at ${rate_hz} Hz; ${lost} ${lost === 1 ? "frame" : "frames"} lost`;
  }
}

/** Listens to the program; the browser connects again by itself. */
function connect(shown: Shown, take: (frame: LiveFrame) => void): void {
  const source = new EventSource("events");
  let newest: LiveFrame | null = null;
  source.addEventListener("state", (event) => shown.state(JSON.parse(event.data) as LiveState));
  source.addEventListener("frame", (event) => {
    const frame = JSON.parse(event.data) as LiveFrame;
    shown.frames += 1;
    if (newest === null) {
      requestAnimationFrame(() => {
        if (newest) shown.count(newest.time_s, newest.lost);
        newest = null;
      });
    }
    newest = frame;
    take(frame);
  });
  source.addEventListener("error", () => shown.state({ state: "lost", message: LOST }));
}
