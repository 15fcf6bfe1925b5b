import type { Cell, Session, Table } from "./contract";
import { element } from "./element";
import { foldButton, MANY } from "./fold";

/** A table as shown: heads over groups of columns, column heads, rows. */
export interface Columns {
  /** Session names above their columns; empty for one session. */
  readonly spans: readonly { readonly name: string; readonly columns: number }[];
  readonly heads: readonly string[];
  readonly rows: readonly (readonly Cell[])[];
}

/** Tables of all sessions; equal names are merged into one table. */
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
  const notes = sentences(own, names).map((sentence) => element("p", { class: "note" }, sentence));
  if (!first || own.every((table) => !table || table.rows.length === 0)) {
    const why = own.find((table) => table?.empty)?.empty ?? "No values.";
    return element("section", { class: "table" }, heading, element("p", { class: "empty" }, why));
  }
  const columns = sideBySide(own, names);
  const body = tableElement(columns, first.title);
  const fold = columns.rows.length > MANY ? [foldButton(body, columns.rows.length, "rows")] : [];
  const scroll = element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": first.title }, body);
  return element("section", { class: "table" }, heading, scroll, ...fold, ...notes);
}

/** Notes of the tables, and why a session has no rows; notes that not all sessions share carry the session's name. */
export function sentences(own: readonly (Table | null)[], names: readonly string[]): string[] {
  const said = own.map((table) => {
    const empty = table && table.rows.length > 0 ? null : (table?.empty ?? "No values.");
    return [table?.note, empty].flatMap((sentence) => (sentence ? [sentence] : []));
  });
  return [...new Set(said.flat())].map((sentence) => {
    const from = names.filter((_, i) => said[i]?.includes(sentence));
    return from.length === own.length ? sentence : `${from.join(", ")}: ${sentence}`;
  });
}

/** Columns of all sessions in turn; columns with equal text in all sessions, such as normal ranges, appear once, at the end. */
export function sideBySide(own: readonly (Table | null)[], names: readonly string[]): Columns {
  const present = own.flatMap((table, i) => (table && table.rows.length > 0 ? [{ table, name: names[i] ?? "" }] : []));
  const [first] = present;
  if (!first || own.length === 1) {
    return { spans: [], heads: first?.table.columns ?? [], rows: first?.table.rows ?? [] };
  }
  const titles = titleColumns(present.map(({ table }) => table));
  const parts = present.map(({ table, name }) => ({ table, name, rows: rowsByKey(table, titles) }));
  const keys = [...new Set(parts.flatMap(({ rows }) => [...rows.keys()]))];
  const same = parts.length > 1 && parts.every(({ table }) => sameWords(table.columns, first.table.columns));
  const shared = keys.some((key) => parts.every(({ rows }) => rows.has(key)));
  const isCommon = (column: number): boolean =>
    same &&
    shared &&
    keys.every((key) => {
      const cells = parts.flatMap(({ rows }) => rows.get(key)?.[column] ?? []);
      return cells.every((cell) => cell.value === null && cell.text === cells[0]?.text);
    });
  const common = indicesFrom(titles, first.table.columns).filter(isCommon);
  const single = parts.map(({ table }) => indicesFrom(titles, table.columns).filter((i) => !common.includes(i)));
  const rows = keys.map((key) => {
    const any = parts.find(({ rows }) => rows.has(key))?.rows.get(key) ?? [];
    const ofPart = parts.flatMap(({ rows }, i) =>
      (single[i] ?? []).map((column) => rows.get(key)?.[column] ?? NOTHING),
    );
    return [...any.slice(0, titles), ...ofPart, ...common.map((column) => any[column] ?? NOTHING)];
  });
  const words = (columns: readonly number[] | undefined, table: Table): string[] =>
    (columns ?? []).map((column) => table.columns[column] ?? "");
  return {
    spans: [
      { name: "", columns: titles },
      ...parts.map(({ name }, i) => ({ name, columns: single[i]?.length ?? 0 })),
      { name: "", columns: common.length },
    ].filter(({ columns }) => columns > 0),
    heads: [
      ...first.table.columns.slice(0, titles),
      ...parts.flatMap(({ table }, i) => words(single[i], table)),
      ...words(common, first.table),
    ],
    rows,
  };
}

const NOTHING: Cell = { text: "", value: null, outside: false };

/** Smallest number of leading text columns that identify a row. */
function titleColumns(tables: readonly Table[]): number {
  const wordy = (column: number): boolean =>
    tables.every(({ columns, rows }) => column < columns.length && rows.every((row) => !isNumber(row[column])));
  const isUnique = (count: number): boolean =>
    tables.every(({ rows }) => new Set(rows.map((row) => keyOf(row, count))).size === rows.length);
  let count = 1;
  while (!isUnique(count) && wordy(count)) {
    count += 1;
  }
  return count;
}

/** Rows by their identifying columns; rows that do not differ there are numbered. */
function rowsByKey(table: Table, titles: number): Map<string, readonly Cell[]> {
  const found = new Map<string, readonly Cell[]>();
  const counts = new Map<string, number>();
  for (const row of table.rows) {
    const key = keyOf(row, titles);
    const count = counts.get(key) ?? 0;
    counts.set(key, count + 1);
    found.set(JSON.stringify([key, count]), row);
  }
  return found;
}

function keyOf(row: readonly Cell[], titles: number): string {
  return JSON.stringify(row.slice(0, titles).map(({ text }) => text));
}

function indicesFrom(start: number, columns: readonly string[]): number[] {
  return columns.map((_, i) => i).slice(start);
}

function sameWords(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((word, i) => word === b[i]);
}

/** A table element; the caption is for screen readers, which do not connect it with the heading. */
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

/** Whether a cell fits a column of numbers, which is right-aligned. */
function isNumber(cell: Cell | undefined): boolean {
  return !cell || cell.value !== null || /^([−-]?[\d.]+( .*)?|[–-]?)$/.test(cell.text);
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
