import type { Context } from "./context";
import type { Group, Session } from "./contract";
import type { PanelSource } from "./drawing";
import { element } from "./element";
import { PanelView } from "./panel";
import type { Panels } from "./panels";

/** A grid of panels with the data of each session. */
interface MergedGroup {
  readonly group: Group;
  readonly panels: Map<string, PanelSource[]>;
}

/** Grids of panels for all sessions; equal names share a panel. `level` is the heading level. */
export function groups(
  context: Context,
  panels: Panels,
  groupsOf: (session: Session) => readonly Group[],
): HTMLElement[] {
  return [...merged(context.page.sessions, groupsOf).values()].map((one) => section(context, panels, one));
}

function section(context: Context, panels: Panels, { group, panels: sources }: MergedGroup): HTMLElement {
  const heading = `group-${group.id}`;
  const grid = element("div", { class: "grid", style: `--columns: ${group.columns}` });
  for (const [id, own] of sources) {
    const view = new PanelView(context, id, own);
    panels.add(view);
    grid.append(view.figure);
  }
  const note = group.note ? [element("p", { class: "note" }, group.note)] : [];
  return element(
    "section",
    { class: "group", "aria-labelledby": heading },
    element("h3", { id: heading }, group.title),
    ...note,
    grid,
  );
}

function merged(
  sessions: readonly Session[],
  groupsOf: (session: Session) => readonly Group[],
): Map<string, MergedGroup> {
  const all = new Map<string, MergedGroup>();
  sessions.forEach((session, index) => {
    for (const group of groupsOf(session)) {
      const one = all.get(group.id) ?? { group, panels: new Map<string, PanelSource[]>() };
      all.set(group.id, one);
      for (const panel of group.panels) {
        one.panels.set(panel.id, [...(one.panels.get(panel.id) ?? []), { index, session, panel }]);
      }
    }
  });
  return all;
}
