import type { Fact, Page, PageQuality, PageSource, PageVerdict, Session } from "./contract";
import { element } from "./element";
import { LOOKS } from "./feasibility";
import { tableElement } from "./table";

const SOURCES: Readonly<Record<PageSource, string>> = {
  measured: "Ground forces: measured",
  mixed: "Ground forces: measured, in part predicted",
  predicted: "Ground forces: predicted",
  simulated: "Ground forces: simulated",
  none: "No ground forces",
};

/** Mark, look and words of the quality of the data. */
const QUALITIES: Readonly<Record<PageQuality, readonly [string, string, string]>> = {
  good: ["✓", "good", "Data good"],
  doubtful: ["?", "unsure", "Data doubtful"],
  bad: ["✗", "bad", "Data bad: do not use these results"],
};

const VERDICTS: Readonly<Record<PageVerdict, string>> = {
  feasible: "Movement feasible",
  infeasible: "Movement infeasible",
  not_judged: "Movement not judged",
};

/** The top of the page: title and source of the ground forces. */
export function header(page: Page): HTMLElement {
  const badges = [...new Set(page.sessions.map((session) => session.source))].map((source) =>
    element("span", { class: `badge ${source}` }, SOURCES[source]),
  );
  return element("header", { class: "header" }, element("h1", {}, page.title), ...badges);
}

/** For each session: how far the figures of a scene came, whether its data can be used, with the strongest reasons, whether a person could make the movement, and what to know first. */
function answers(page: Page): HTMLElement[] {
  return page.sessions.flatMap((session) => {
    const outcome = session.outcome.map((sentence) => element("p", { class: "answer" }, sentence));
    const lines = [...outcome, ...dataLines(session), ...verdictLines(session), ...glanceLines(session)];
    const name = page.sessions.length > 1 ? [element("h3", { class: "answer-name" }, session.name)] : [];
    return lines.length > 0
      ? [element("section", { class: "answers", "aria-label": "Answers" }, ...name, ...lines)]
      : [];
  });
}

function dataLines(session: Session): HTMLElement[] {
  if (session.data === null) {
    return [];
  }
  const { state, reasons } = session.data;
  const [sign, look, words] = QUALITIES[state];
  const list = element("ul", {}, ...reasons.map((reason) => element("li", {}, reason)));
  return [answer(sign, look, words), ...(reasons.length > 0 ? [list] : [])];
}

function verdictLines(session: Session): HTMLElement[] {
  if (session.feasibility === null) {
    return [];
  }
  const [sign, look] = LOOKS[session.feasibility.state];
  return [answer(sign, look, VERDICTS[session.feasibility.state])];
}

function glanceLines(session: Session): HTMLElement[] {
  if (session.glance === null) {
    return [];
  }
  const { facts, deviations, norm } = session.glance;
  const list = element("ol", {}, ...deviations.map((deviation) => element("li", {}, deviation)));
  const heading = element("p", { class: "answer-name" }, "Largest differences from normal");
  return [factGrid(facts), ...(deviations.length > 0 ? [heading, list] : []), element("p", { class: "origin" }, norm)];
}

function answer(sign: string, look: string, words: string): HTMLElement {
  const mark = element("span", { class: "mark", "aria-hidden": "true" }, sign);
  return element("p", { class: `answer ${look}` }, mark, words);
}

/** The answers; subject, model and settings, folded, next to a picture of the figure for print; then the data that the page cannot show. */
export function about(page: Page, still: HTMLImageElement): HTMLElement {
  const [first] = page.sessions;
  const facts = page.sessions.length === 1 && first ? factGrid(first.header) : factTable(page.sessions);
  const details = element("details", { class: "settings" }, element("summary", {}, "Subject and settings"), facts);
  return element(
    "div",
    { class: "about" },
    ...answers(page),
    element("div", { class: "subject-row" }, details, still),
    ...missing(page.sessions),
  );
}

function factGrid(facts: readonly Fact[]): HTMLElement {
  return element(
    "dl",
    { class: "facts" },
    ...facts.map((fact) => {
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

/** Lists the data that the page cannot show. */
function missing(sessions: readonly Session[]): HTMLElement[] {
  const all = [...new Set(sessions.flatMap((session) => session.missing))];
  const sentences = all.map((sentence) => {
    const own = sessions.filter((session) => session.missing.includes(sentence));
    return own.length === sessions.length ? sentence : `${own.map((session) => session.name).join(", ")}: ${sentence}`;
  });
  if (sentences.length === 0) {
    return [];
  }
  const list = element("ul", {}, ...sentences.map((sentence) => element("li", {}, sentence)));
  return [element("section", { class: "missing", "aria-label": "Not shown" }, list)];
}
