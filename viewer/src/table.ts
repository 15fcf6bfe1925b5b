import type { Cell, Session, Table } from "./contract";
import { element } from "./element";
import { foldButton, MANY } from "./fold";

/** A table as it is shown: heads over groups of columns, heads, rows. */
export interface Columns {
  /** Sessions over their columns; none of one session. */
  readonly spans: readonly { readonly name: string; readonly columns: number }[];
  readonly heads: readonly string[];
  readonly rows: readonly (readonly Cell[])[];
}

/** Tables of all sessions, those of the same name side by side. */
export function tables(sessions: readonly Session[], tablesOf: (session: Session) => readonly Table[]): HTMLElement[] {
  const ids = [...new Set(sessions.flatMap((session) => tablesOf(session).map((table) => table.id)))];
  return ids.map((id) => {
    const own = sessions.map((session) => tablesOf(session).find((table) => table.id === id) ?? null);
    return tableSection(
      own,
      sessions.map((session) => session.name),
    );
  });
}

/** One table of one or more sessions, with its heading. */
export function tableSection(own: readonly (Table | null)[], names: readonly string[]): HTMLElement {
  const first = own.find((table) => table !== null);
  const heading = element("h3", {}, first?.title ?? "");
  const note = first?.note ? [element("p", { class: "note" }, first.note)] : [];
  if (!first || own.every((table) => !table || table.rows.length === 0)) {
    const why = own.find((table) => table?.empty)?.empty ?? "There are no values.";
    return element("section", { class: "table" }, heading, element("p", { class: "empty" }, why));
  }
  const body = tableElement(sideBySide(own, names), first.title);
  const fold = first.rows.length > MANY ? [foldButton(body, first.rows.length, "rows")] : [];
  const scroll = element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": first.title }, body);
  return element("section", { class: "table" }, heading, scroll, ...fold, ...note);
}

/** Columns of all sessions in turn; words that all sessions have in common, as normal ranges, stand once, at the end. */
export function sideBySide(own: readonly (Table | null)[], names: readonly string[]): Columns {
  const present = own.flatMap((table, i) => (table && table.rows.length > 0 ? [{ table, name: names[i] ?? "" }] : []));
  const [first] = present;
  if (!first || present.length === 1) {
    return { spans: [], heads: first?.table.columns ?? [], rows: first?.table.rows ?? [] };
  }
  const keys = [...new Set(present.flatMap(({ table }) => table.rows.map(keyOf)))];
  const heads = first.table.columns;
  const cell = (table: Table, key: string, column: number): Cell =>
    table.rows.find((row) => keyOf(row) === key)?.[column] ?? { text: "", value: null, outside: false };
  const indices = heads.map((_, i) => i).slice(1);
  const common = indices.filter((column) =>
    keys.every((key) =>
      present.every(({ table }) => {
        const { text, value } = cell(table, key, column);
        return value === null && text === cell(first.table, key, column).text;
      }),
    ),
  );
  const single = indices.filter((column) => !common.includes(column));
  const rows = keys.map((key) => [
    { text: key, value: null, outside: false },
    ...present.flatMap(({ table }) => single.map((column) => cell(table, key, column))),
    ...common.map((column) => cell(first.table, key, column)),
  ]);
  const word = (column: number): string => heads[column] ?? "";
  return {
    spans: [
      { name: "", columns: 1 },
      ...present.map(({ name }) => ({ name, columns: single.length })),
      ...(common.length > 0 ? [{ name: "", columns: common.length }] : []),
    ].filter(({ columns }) => columns > 0),
    heads: [word(0), ...present.flatMap(() => single.map(word)), ...common.map(word)],
    rows,
  };
}

/** A table element; its caption is for screen readers, who see no heading beside it. */
export function tableElement({ spans, heads, rows }: Columns, caption: string): HTMLTableElement {
  const kinds = heads.map((_, column) => (rows.every((row) => isNumber(row[column])) ? "number" : "words"));
  const head = element("thead");
  if (spans.length > 0) {
    head.append(element("tr", { class: "spans" }, ...spans.map(spanHead)));
  }
  head.append(element("tr", {}, ...heads.map((word, i) => headCell(word, kinds[i] ?? "words"))));
  const body = element("tbody", {}, ...rows.map((row) => rowElement(row, kinds)));
  return element("table", {}, element("caption", { class: "spoken" }, caption), head, body);
}

function headCell(word: string, kind: string): HTMLElement {
  return word === "" ? element("td") : element("th", { scope: "col", class: kind }, word);
}

function spanHead({ name, columns }: { readonly name: string; readonly columns: number }): HTMLElement {
  return name === ""
    ? element("td", { colspan: columns })
    : element("th", { scope: "colgroup", colspan: columns }, name);
}

/** Whether a cell may stand in a column of numbers, which is aligned to the right. */
function isNumber(cell: Cell | undefined): boolean {
  return !cell || cell.value !== null || /^([−-]?[\d.]+( .*)?|–?)$/.test(cell.text);
}

function rowElement(row: readonly Cell[], kinds: readonly string[]): HTMLElement {
  const [first, ...others] = row;
  const cells = others.map((cell, i) => cellElement(cell, kinds[i + 1] ?? "words"));
  return element("tr", {}, element("th", { scope: "row" }, first?.text ?? ""), ...cells);
}

function cellElement(cell: Cell, kind: string): HTMLElement {
  const made = element("td", { class: `${kind}${cell.outside ? " outside" : ""}` }, cell.text);
  if (cell.outside) {
    made.append(element("span", { class: "spoken" }, " (outside)"));
  }
  if (cell.value !== null) {
    made.title = String(cell.value);
  }
  return made;
}

function keyOf(row: readonly Cell[]): string {
  return row[0]?.text ?? "";
}
