import assert from "node:assert/strict";
import { test } from "node:test";
import { FORMAT } from "../src/contract";
import { pageOf } from "../src/read_page";

test("a page of this format is read", () => {
  assert.equal(pageOf(`{"format": ${FORMAT}, "title": "x"}`).title, "x");
});

test("another format is rejected with a message", () => {
  assert.throws(() => pageOf('{"format": 999}'), new RegExp(`format 999, but this viewer expects ${FORMAT}`));
});

test("an incomplete file is rejected with a message", () => {
  assert.throws(() => pageOf('{"format": 1, "ti'), /incomplete or changed/);
});
