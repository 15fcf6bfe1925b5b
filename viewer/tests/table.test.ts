import assert from "node:assert/strict";
import { test } from "node:test";
import type { Table } from "../src/contract";
import { sentences, sideBySide } from "../src/table";

const table = (rows: string[][]): Table => ({
  id: "t",
  title: "T",
  note: null,
  columns: ["", "Right", "Normal"],
  rows: rows.map((row) => row.map((text) => ({ text, value: null, outside: false }))),
  empty: null,
});

test("a single table is unchanged", () => {
  const own = table([["step", "0.7", "0.6-0.8"]]);
  assert.deepEqual(sideBySide([own], ["a"]), { spans: [], heads: own.columns, rows: own.rows });
});

test("columns of two sessions are side by side, common columns appear once", () => {
  const made = sideBySide([table([["step", "0.7", "0.6-0.8"]]), table([["step", "0.5", "0.6-0.8"]])], ["a", "b"]);
  assert.deepEqual(made.heads, ["", "Right", "Right", "Normal"]);
  assert.deepEqual(
    made.spans.map((span) => `${span.name}${span.columns}`),
    ["1", "a1", "b1", "1"],
  );
  assert.deepEqual(
    made.rows.map((row) => row.map((cell) => cell.text)),
    [["step", "0.7", "0.5", "0.6-0.8"]],
  );
});

test("a row of one session only is empty in the other", () => {
  const made = sideBySide([table([["a", "1", "n"]]), table([["b", "2", "n"]])], ["x", "y"]);
  assert.deepEqual(
    made.rows.map((row) => row.map((cell) => cell.text)),
    [
      ["a", "1", "n", "", ""],
      ["b", "", "", "2", "n"],
    ],
  );
});

/** Cell texts of all rows. */
function rowsOf(...tables: string[][][]): string[][] {
  const made = tables.map((rows) => table(rows));
  const names = tables.map((_, i) => String(i));
  return sideBySide(made, names).rows.map((row) => row.map((cell) => cell.text));
}

test("rows with the same first column are distinguished by the next columns", () => {
  const own = (a: string, b: string): string[][] => [
    ["right", "up", a],
    ["right", "ahead", b],
  ];
  assert.deepEqual(rowsOf(own("1", "2"), own("3", "4")), [
    ["right", "up", "1", "3"],
    ["right", "ahead", "2", "4"],
  ]);
});

test("indistinguishable rows keep their order, and none is lost", () => {
  const more = [
    ["strike", "0.1", "n"],
    ["strike", "1.1", "n"],
    ["strike", "2.1", "n"],
  ];
  assert.deepEqual(rowsOf(more, [["strike", "0.2", "n"]]), [
    ["strike", "0.1", "0.2", "n"],
    ["strike", "1.1", "", "n"],
    ["strike", "2.1", "", "n"],
  ]);
});

test("a session without rows does not remove the names of the others", () => {
  const made = sideBySide([table([]), table([["a", "1", "n"]])], ["x", "y"]);
  assert.deepEqual(
    made.spans.map((span) => `${span.name}${span.columns}`),
    ["1", "y2"],
  );
});

test("sessions with different columns keep their own heads", () => {
  const other: Table = { ...table([["a", "1"]]), columns: ["", "Left"] };
  const made = sideBySide([table([["a", "1", "n"]]), other], ["x", "y"]);
  assert.deepEqual(made.heads, ["", "Right", "Normal", "Left"]);
  assert.deepEqual(
    made.rows.map((row) => row.map((cell) => cell.text)),
    [["a", "1", "n", "1"]],
  );
});

test("different notes carry the names of their sessions", () => {
  const noted = (note: string | null): Table => ({ ...table([["a", "1", "n"]]), note });
  assert.deepEqual(sentences([noted("N"), noted("N")], ["x", "y"]), ["N"]);
  assert.deepEqual(sentences([noted("N"), noted("M")], ["x", "y"]), ["x: N", "y: M"]);
  assert.deepEqual(sentences([noted("N"), { ...table([]), empty: "no cycles" }], ["x", "y"]), ["x: N", "y: no cycles"]);
});
