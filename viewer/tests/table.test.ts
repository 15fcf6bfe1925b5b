import assert from "node:assert/strict";
import { test } from "node:test";
import type { Table } from "../src/contract";
import { sideBySide } from "../src/table";

const table = (rows: string[][]): Table => ({
  id: "t",
  title: "T",
  note: null,
  columns: ["", "Right", "Normal"],
  rows: rows.map((row) => row.map((text) => ({ text, value: null, outside: false }))),
  empty: null,
});

test("one table stays as it is", () => {
  const own = table([["step", "0.7", "0.6-0.8"]]);
  assert.deepEqual(sideBySide([own], ["a"]), { spans: [], heads: own.columns, rows: own.rows });
});

test("columns of two sessions stand side by side, common ones once", () => {
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

test("a row that only one session has is empty in the other", () => {
  const made = sideBySide([table([["a", "1", "n"]]), table([["b", "2", "n"]])], ["x", "y"]);
  assert.deepEqual(
    made.rows.map((row) => row.map((cell) => cell.text)),
    [
      ["a", "1", "n", "", ""],
      ["b", "", "", "2", "n"],
    ],
  );
});
