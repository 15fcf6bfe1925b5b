import type { Page, PageSource, Session } from "./contract";
import { element } from "./element";
import { tableElement } from "./table";

const SOURCES: Readonly<Record<PageSource, string>> = {
  measured: "Ground forces: measured",
  predicted: "Ground forces: predicted",
  simulated: "Ground forces: simulated",
  none: "No ground forces",
};

/** Who, with what, how: the top of the page. */
export function header(page: Page): HTMLElement {
  const title = element("h1", {}, page.title);
  const badges = [...new Set(page.sessions.map((session) => session.source))].map((source) =>
    element("span", { class: `badge ${source}` }, SOURCES[source]),
  );
  const top = element(
    "div",
    { class: "top" },
    title,
    ...badges,
    element("span", { class: "program" }, `Ambulo ${page.program}`),
  );
  const [first] = page.sessions;
  const facts = page.sessions.length === 1 && first ? factList(first) : factTable(page.sessions);
  return element("header", { class: "header" }, top, facts, ...missing(page.sessions));
}

function factList(session: Session): HTMLElement {
  return element(
    "dl",
    { class: "facts" },
    ...session.header.map((fact) => {
      const note = fact.note ? [" ", element("span", { class: "origin" }, fact.note)] : [];
      return element("div", {}, element("dt", {}, fact.label), element("dd", {}, fact.value, ...note));
    }),
  );
}

function factTable(sessions: readonly Session[]): HTMLElement {
  const labels = [...new Set(sessions.flatMap((session) => session.header.map((fact) => fact.label)))];
  const cell = (text: string): { text: string; value: null; outside: false } => ({ text, value: null, outside: false });
  const rows = labels.map((label) => [
    cell(label),
    ...sessions.map((session) => cell(session.header.find((fact) => fact.label === label)?.value ?? "")),
  ]);
  const heads = ["", ...sessions.map((session) => session.name)];
  const body = tableElement({ spans: [], heads, rows }, "Subjects and settings");
  return element(
    "div",
    { class: "scroll facts-table", tabindex: 0, role: "region", "aria-label": "Subjects and settings" },
    body,
  );
}

/** What the page cannot show. */
function missing(sessions: readonly Session[]): HTMLElement[] {
  const sentences = sessions.flatMap((session) =>
    session.missing.map((sentence) => (sessions.length > 1 ? `${session.name}: ${sentence}` : sentence)),
  );
  if (sentences.length === 0) {
    return [];
  }
  const list = element("ul", {}, ...sentences.map((sentence) => element("li", {}, sentence)));
  return [element("section", { class: "missing", "aria-label": "Not shown" }, list)];
}
