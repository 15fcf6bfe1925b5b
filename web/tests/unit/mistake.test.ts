import assert from "node:assert/strict";
import { test } from "node:test";
import { aboutMass, aboutOptions, aboutStature, inWordsOfThePage, nameOf } from "../../src/mistake";

const NO_MASS = "error: walk.bvh: a BVH contains no body mass; expected one in kg\n  hint: `--mass KG`";
const TALL =
  "error: walk.bvh: the height is 175 m; expected 0.4 to 2.5 m.\n  hint: metres, not centimetres; `--height M`";
const UNKNOWN =
  "error: unexpected argument '--nonsense' found\n\n  tip: to pass '--nonsense' as a value, use '-- --nonsense'\n\nUsage: ambulo forces";

test("an error is about the field that can mend it", () => {
  assert.deepEqual([NO_MASS, TALL, UNKNOWN].map(aboutMass), [true, false, false]);
  assert.deepEqual([NO_MASS, TALL, UNKNOWN].map(aboutStature), [false, true, false]);
  assert.deepEqual(
    [NO_MASS, TALL, UNKNOWN].map((message) => aboutOptions(message, "--nonsense 3")),
    [false, false, true],
  );
  assert.deepEqual(
    [nameOf(NO_MASS), nameOf("error: visit/a.c3d: no"), nameOf("error: no")],
    ["walk.bvh", "a.c3d", undefined],
  );
});

test("a hint names the field of the page", () => {
  assert.equal(
    inWordsOfThePage(NO_MASS),
    'walk.bvh: a BVH contains no body mass; expected one in kg\n  hint: fill in the field "Body mass"',
  );
  assert.equal(inWordsOfThePage(UNKNOWN), "unexpected argument '--nonsense' found");
  assert.match(inWordsOfThePage("error: a\n  hint: `--from` chooses"), /Options are typed under "More options"\.$/);
});
