import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { test } from "node:test";
import { crc32, zip } from "../../src/zip";
import { unzip } from "./archive";

test("the checksum is CRC-32", () => {
  // The check value of CRC-32/ISO-HDLC.
  assert.equal(crc32(new TextEncoder().encode("123456789")), 0xcbf43926);
});

test("an archive has the files that were put in, and Python reads it", async () => {
  const bytes = Uint8Array.from({ length: 5000 }, (_, index) => (index * index) % 251);
  const files = new Map([
    ["tables/größe.csv", bytes],
    ["empty", new Uint8Array()],
  ]);
  const archive = Buffer.from(await (await zip(files)).arrayBuffer());
  const read = unzip(archive);
  assert.deepEqual([...read.keys()], [...files.keys()]);
  assert.deepEqual(new Uint8Array(read.get("tables/größe.csv") ?? []), bytes);
  const script =
    "import sys,io,zipfile; z=zipfile.ZipFile(io.BytesIO(sys.stdin.buffer.read())); print(z.testzip(), z.namelist()[1])";
  const python = spawnSync("python3", ["-c", script], { input: archive, encoding: "utf8" });
  if (!python.error) {
    assert.equal(python.stdout.trim(), "None empty");
  }
});
