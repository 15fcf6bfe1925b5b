import { abreast, chapter } from "./chapter";
import type { Context } from "./context";
import type { Judged, PageFinding, Session } from "./contract";
import { element } from "./element";
import { groups } from "./groups";
import type { Panels } from "./panels";
import { tables } from "./table";

/** The quality section: how far the numbers can be trusted. */
export function quality(context: Context, panels: Panels): HTMLElement[] {
  const { sessions } = context.page;
  const facts = sessions.flatMap((session) => judged(session, sessions.length > 1));
  return chapter("quality", "Quality", [
    ...facts,
    ...groups(context, panels, (session) => session.quality.groups),
    ...abreast(tables(sessions, (session) => session.quality.tables)),
    ...sessions.flatMap((session) => remarks(session, sessions.length > 1)),
  ]);
}

function judged(session: Session, named: boolean): HTMLElement[] {
  const { facts } = session.quality;
  if (facts.length === 0) {
    return [];
  }
  const name = named ? [element("h3", {}, session.name)] : [];
  return [...name, element("dl", { class: "facts judged" }, ...facts.map(fact))];
}

function fact({ label, value, allowed, good }: Judged): HTMLElement {
  const mark = good === null ? "" : good ? "✓" : "✗";
  const word = good === null ? "" : good ? "good: " : "not good: ";
  const kind = good === null ? "open" : good ? "good" : "bad";
  return element(
    "div",
    { class: kind },
    element("dt", {}, label),
    element(
      "dd",
      {},
      element("span", { class: "mark", "aria-hidden": "true" }, mark),
      element("span", { class: "spoken" }, word),
      value,
      ...(allowed ? [" ", element("span", { class: "origin" }, allowed)] : []),
    ),
  );
}

function remarks(session: Session, named: boolean): HTMLElement[] {
  const { findings, assumptions } = session.quality;
  const of = named ? ` (${session.name})` : "";
  const list = (title: string, items: readonly HTMLElement[]): HTMLElement[] =>
    items.length > 0
      ? [element("section", { class: "remarks" }, element("h3", {}, title + of), element("ul", {}, ...items))]
      : [];
  return [
    ...list("Warnings and notes", findings.map(finding)),
    ...list(
      "Assumptions",
      assumptions.map((sentence) => element("li", {}, sentence)),
    ),
  ];
}

function finding({ code, severity, message, count }: PageFinding): HTMLElement {
  const often = count > 1 ? [element("span", { class: "origin" }, ` ${count} times`)] : [];
  const word = element("span", { class: `severity ${severity}` }, severity);
  return element("li", {}, word, ` ${message}`, ...often, " ", element("code", {}, code));
}
