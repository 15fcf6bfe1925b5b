import { abreast, chapter } from "./chapter";
import { Clock } from "./clock";
import type { Context, Stage } from "./context";
import { pageControls, playControls } from "./controls";
import { Display } from "./display";
import { element } from "./element";
import { feasibility } from "./feasibility";
import { groups } from "./groups";
import { about, header } from "./header";
import { helpDialog } from "./help";
import { listenToKeys } from "./keyboard";
import { legend } from "./legend";
import { live, livePage } from "./live";
import { machines } from "./machines";
import { Panels } from "./panels";
import { prepareForPaper } from "./paper";
import { cycleAt, timeAt } from "./phase";
import { quality } from "./quality";
import { readPage } from "./read_page";
import { followSystem } from "./style";
import { tables } from "./table";
import { createView, type View3D } from "./view3d";
import "uplot/dist/uPlot.min.css";
import "./css/page.css";
import "./css/stage.css";
import "./css/panel.css";
import "./css/table.css";
import "./css/machines.css";
import "./css/print.css";

/** Percent of a right cycle at which the page opens: the leg is loaded, so the first picture shows forces. */
const BEGIN_PERCENT = 15;
/** The figure is drawn after this time even if the rest is not yet on the screen. */
const LONGEST_PAINT_MS = 100;

/** Draws the page, or shows why that is not possible. */
async function main(root: HTMLElement): Promise<void> {
  followSystem();
  const { page, numbers } = await readPage();
  const [first] = page.sessions;
  if (!first) {
    throw new Error("This report contains no motion. Make the report again with `ambulo report`.");
  }
  const arriving = livePage();
  if (arriving) {
    live(root, page, numbers, arriving);
    return ready();
  }
  document.documentElement.toggleAttribute("data-compared", page.sessions.length > 1);
  const context: Context = { page, first, numbers, clock: new Clock(first.time), display: new Display() };
  if (page.sessions.every((session) => session.cycles.length === 0)) {
    context.display.axis = "time";
  }
  const panels = new Panels(context);
  const host = element("div", { class: "view" });
  const still = element("img", { class: "still", alt: "The figure at the chosen time" });
  const aside = element("section", { class: "stage", "aria-label": "Figure and time" }, host);
  const nav = element("nav", { class: "bar", "aria-label": "Page" });
  const report = content(context, panels);
  report.prepend(about(page, still), nav);
  const footer = element(
    "footer",
    {},
    `Ambulo ${page.program}. This file is complete and loads nothing from the network.`,
  );
  root.replaceChildren(header(page), element("main", { class: "columns" }, aside, report), footer);
  panels.start();
  await painted();
  const view = figure(host, context);
  const stage: Stage = { ...context, view };
  const { dialog, open } = helpDialog();
  const { bar, actions } = playControls(stage);
  aside.append(bar);
  nav.append(contents(report), pageControls(stage, open));
  root.append(dialog);
  listenToKeys(context, { ...actions, help: open });
  prepareForPaper(panels, view, still);
  begin(context);
  Object.defineProperty(window, "ambulo", {
    value: {
      page,
      numbers,
      clock: context.clock,
      display: context.display,
      view,
      get panels() {
        return panels.drawings();
      },
    },
  });
  requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(ready)));
}

/** The report: curves, tables, quality and feasibility. */
function content(context: Context, panels: Panels): HTMLElement {
  const { sessions } = context.page;
  const curves = groups(context, panels, (session) => session.groups);
  const numbers = tables(sessions, (session) => session.tables);
  return element(
    "div",
    { class: "content" },
    ...chapter(
      "curves",
      "Curves",
      curves.length > 0
        ? [legend(context, panels), ...cycleless(context), ...curves, ...machines(context), sources(context, panels)]
        : [],
    ),
    ...feasibility(context, panels),
    ...chapter("tables", "Numbers", abreast(numbers)),
    ...quality(context, panels),
  );
}

/** Full sources of the grey bands that are drawn now. */
function sources(context: Context, panels: Panels): HTMLElement {
  const list = element("ul", {});
  const made = element("section", { class: "sources" }, element("h3", {}, "Normative bands"), list);
  const fill = (): void => {
    const all = panels.citations();
    made.hidden = all.length === 0;
    list.replaceChildren(...all.map((citation) => element("li", {}, citation)));
  };
  fill();
  context.display.subscribe(fill);
  return made;
}

/** Names the compared sessions that have no gait cycles. */
function cycleless({ page }: Context): HTMLElement[] {
  const without = page.sessions.filter((session) => session.cycles.length === 0);
  if (without.length === 0 || without.length === page.sessions.length) {
    return [];
  }
  const names = without.map((session) => session.name).join(", ");
  const verb = without.length > 1 ? "have" : "has";
  return [element("p", { class: "note" }, `${names} ${verb} no gait cycles: see the curves over time.`)];
}

function contents(report: HTMLElement): HTMLElement {
  const chapters = [...report.querySelectorAll<HTMLElement>(".chapter")];
  const links = chapters.map((one) =>
    element("a", { href: `#${one.id}` }, one.querySelector("h2")?.textContent ?? one.id),
  );
  return element("div", { class: "links" }, ...links);
}

/** The figure, or the reason why it cannot be shown. */
function figure(host: HTMLElement, context: Context): View3D | null {
  if (context.page.sessions.every((session) => session.view === null)) {
    host.replaceChildren(element("p", { class: "empty" }, "The report contains no body to show in 3-D."));
    return null;
  }
  try {
    return createView(host, context.page, context.numbers, context.clock);
  } catch {
    host.replaceChildren(
      element("p", { class: "empty" }, "This browser cannot draw in 3-D (WebGL is missing or switched off)."),
    );
    return null;
  }
}

/** Waits until text and curves are on the screen, but not in a hidden window. */
function painted(): Promise<void> {
  return new Promise((done) => {
    requestAnimationFrame(() => setTimeout(done));
    setTimeout(done, LONGEST_PAINT_MS);
  });
}

function begin({ clock, first }: Context): void {
  const times = first.cycles.filter(({ side }) => side === "r").map((cycle) => timeAt(cycle, BEGIN_PERCENT));
  const inBoth = times.find((time) => cycleAt(first.cycles, "l", time));
  clock.seek(inBoth ?? times[0] ?? clock.start);
}

function ready(): void {
  document.documentElement.dataset["ready"] = "true";
}

const root = document.getElementById("ambulo");
if (root) {
  main(root).catch((error: unknown) => {
    const message = error instanceof Error ? error.message : String(error);
    root.replaceChildren(element("p", { class: "failure", role: "alert" }, message));
    ready();
  });
}
