import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { run } from "../../src/wasi";

/** What the command does with files, as a program whose output is known from the same program on the disk. */
const PROGRAM = `
use std::fs;
use std::io::{Read, Seek, SeekFrom, Write};
fn main() {
    let word = std::env::args().nth(1).unwrap();
    println!("{}", fs::read_to_string(&word).unwrap());
    println!("{:?}", fs::read("missing").unwrap_err().kind());
    fs::create_dir_all("out/inner").unwrap();
    println!("{:?}", fs::create_dir("out").unwrap_err().kind());
    let mut file = fs::File::create("out/inner/a").unwrap();
    for line in 0..10_000 { writeln!(file, "{line}").unwrap(); }
    file.sync_all().unwrap();
    println!("{}", fs::metadata("out/inner/a").unwrap().len());
    let mut file = fs::File::open("out/inner/a").unwrap();
    file.seek(SeekFrom::End(-5)).unwrap();
    let mut end = String::new();
    file.read_to_string(&mut end).unwrap();
    println!("{end:?}");
    fs::rename("out/inner/a", "out/b").unwrap();
    println!("{:?}", fs::remove_dir("out").unwrap_err().kind() != std::io::ErrorKind::NotFound);
    fs::write("out/b", "short").unwrap();
    for name in 0..300 { fs::write(format!("out/inner/{name:03}"), "x").unwrap(); }
    let mut names: Vec<_> = fs::read_dir("out/inner").unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    println!("{} {:?}", names.len(), names.last());
    fs::remove_dir_all("out/inner").unwrap();
    println!("{:?} {:?}", fs::metadata("out").unwrap().is_dir(), fs::metadata("out/inner").is_err());
    println!("{:?}", fs::File::create("out").is_err());
    // A function that this system does not have.
    println!("{:?}", fs::hard_link("missing", "link").is_err());
    eprintln!("done");
    std::process::exit(3);
}
`;

test("a program finds files in memory as it finds them on the disk", async (context) => {
  const folder = mkdtempSync(join(tmpdir(), "ambulo-wasi-"));
  context.after(() => rmSync(folder, { recursive: true }));
  writeFileSync(join(folder, "main.rs"), PROGRAM);
  writeFileSync(join(folder, "given"), "größe");
  const compile = (target: string[], name: string): boolean => {
    const compiled = spawnSync("rustc", ["--edition=2024", ...target, "main.rs", "-o", name], { cwd: folder });
    return compiled.status === 0;
  };
  const { stdout } = spawnSync("rustc", ["--print", "target-libdir", "--target", "wasm32-wasip1"], {
    encoding: "utf8",
  });
  const hasTarget = spawnSync("ls", [stdout?.trim() ?? ""]).status === 0;
  if (!hasTarget || !compile(["--target", "wasm32-wasip1"], "main.wasm") || !compile([], "native")) {
    context.skip("the target wasm32-wasip1 is not installed");
    return;
  }
  const native = spawnSync("./native", ["given"], { cwd: folder, encoding: "utf8" });
  const given = new Map([["given", new TextEncoder().encode("größe")]]);
  const module = await WebAssembly.compile(readFileSync(join(folder, "main.wasm")));
  const ended = await run(module, ["main", "given"], given);
  assert.equal(ended.printed, native.stdout);
  assert.equal(ended.complained, "done\n");
  assert.equal(ended.code, 3);
  assert.deepEqual([...ended.files.keys()].sort(), ["given", "out/b"]);
  assert.equal(new TextDecoder().decode(ended.files.get("out/b")), "short");
  assert.equal(new TextDecoder().decode(given.get("given")), "größe");
});
