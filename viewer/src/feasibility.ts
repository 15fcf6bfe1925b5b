import { chapter } from "./chapter";
import type { Context } from "./context";
import type { Feasibility, PageVerdict, RedSpan, Session } from "./contract";
import { sideName } from "./drawing";
import { button, element } from "./element";
import { foldButton, MANY } from "./fold";
import type { Panels } from "./panels";
import { tableSection } from "./table";

/** Mark and look of a verdict. */
export const LOOKS: Readonly<Record<PageVerdict, readonly [string, string]>> = {
  feasible: ["✓", "good"],
  infeasible: ["✗", "bad"],
  not_judged: ["?", "unsure"],
};

/** The feasibility section: verdict, red spans over the recording, and reasons as text. */
export function feasibility(context: Context, panels: Panels): HTMLElement[] {
  const judged = context.page.sessions.filter((session) => session.feasibility !== null);
  if (judged.length === 0) {
    return [];
  }
  const parts = judged.flatMap((session) =>
    session.feasibility ? one(context, panels, session, session.feasibility) : [],
  );
  const closest = tableSection(
    judged.map((session) => session.feasibility?.closest ?? null),
    judged.map((session) => session.name),
  );
  return chapter("feasibility", "Feasibility", [...parts, closest]);
}

function one(context: Context, panels: Panels, session: Session, verdict: Feasibility): HTMLElement[] {
  const name = context.page.sessions.length > 1 ? [element("h3", {}, session.name)] : [];
  const [sign, look] = LOOKS[verdict.state];
  const mark = element("span", { class: "mark", "aria-hidden": "true" }, sign);
  const sentence = element("p", { class: `verdict ${look}` }, mark, verdict.sentence);
  const seek = (span: RedSpan): void => {
    context.clock.pause();
    context.clock.seek(span.from_s + context.first.time.start_s - session.time.start_s);
  };
  const show = (span: RedSpan): void => {
    seek(span);
    if (span.panel) {
      panels.show(span.panel);
    }
  };
  const red = verdict.red.length > 0 ? [lanes(context, session, verdict.red, seek), ...reasons(verdict.red, show)] : [];
  return [...name, sentence, ...red];
}

/** One lane per check, over the whole recording. */
function lanes(context: Context, session: Session, red: readonly RedSpan[], go: (span: RedSpan) => void): HTMLElement {
  const { start_s, step_s, frames } = session.time;
  const length = step_s * Math.max(frames - 1, 1);
  const part = (time: number): number => Math.min(Math.max((100 * (time - start_s)) / length, 0), 100);
  const checks = [...new Set(red.map((span) => span.check))];
  const lane = (check: string): HTMLElement[] => {
    const spans = red
      .filter((span) => span.check === check)
      .map((span) => {
        const made = button(`${spanTime(span)}: ${span.sentence}`, "", () => go(span));
        made.className = "span";
        // The list of reasons below offers the same to keyboard users.
        made.tabIndex = -1;
        made.style.left = `${part(span.from_s)}%`;
        made.style.width = `max(4px, ${part(span.to_s) - part(span.from_s)}%)`;
        return made;
      });
    return [element("span", { class: "lane-name" }, check), element("div", { class: "lane" }, ...spans)];
  };
  const ends = element(
    "div",
    { class: "lane-ends" },
    element("span", {}, `${start_s.toFixed(2)} s`),
    element("span", {}, `${(start_s + length).toFixed(2)} s`),
  );
  const now = element("div", { class: "lane-now", "aria-hidden": "true" });
  const made = element("div", { class: "lanes" }, ...checks.flatMap(lane), element("span"), ends, now);
  if (session === context.first) {
    context.clock.subscribe((clock) => made.style.setProperty("--now", String(part(clock.time) / 100)));
  } else {
    now.remove();
  }
  return made;
}

function reasons(red: readonly RedSpan[], go: (span: RedSpan) => void): HTMLElement[] {
  const items = red.map((span) => {
    const time = button(`Go to ${spanTime(span)}`, spanTime(span), () => go(span));
    const side = span.side ? ` (${sideName(span.side)})` : "";
    const why = element("span", {}, element("strong", {}, span.check + side), ` ${span.sentence}`);
    return element("li", {}, time, why);
  });
  const list = element("ol", { class: "reasons" }, ...items);
  return items.length > MANY ? [list, foldButton(list, items.length, "reasons")] : [list];
}

function spanTime(span: RedSpan): string {
  return `${span.from_s.toFixed(2)}–${span.to_s.toFixed(2)} s`;
}
