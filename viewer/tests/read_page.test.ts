import assert from "node:assert/strict";
import { test } from "node:test";
import { FORMAT } from "../src/contract";
import { pageOf } from "../src/read_page";

test("a page of this format is read", () => {
  assert.equal(pageOf(`{"format": ${FORMAT}, "title": "x"}`).title, "x");
});

test("another format is refused in words", () => {
  assert.throws(() => pageOf('{"format": 999}'), new RegExp(`format 999, its viewer needs ${FORMAT}`));
});

test("a file cut off is refused in words", () => {
  assert.throws(() => pageOf('{"format": 1, "ti'), /cut off or changed/);
});
