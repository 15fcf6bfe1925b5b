// Bundles the viewer into crates/ambulo-report/data/report/viewer.js and viewer.css; with `--check` compares instead of writing.
//
// The first line of the script has a hash of all its sources, so that a Rust test can check without npm whether the
// committed bundle belongs to the sources (crates/ambulo-report/tests/viewer_bundle.rs computes the same hash).
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, relative, sep } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const repository = join(here, "..");
const target = join(repository, "crates/ambulo-report/data/report");

/** Source files of the bundle, as sorted paths from the repository's root with `/`. */
function sources() {
  const files = readdirSync(join(here, "src"), { withFileTypes: true, recursive: true })
    .filter((entry) => entry.isFile())
    .map((entry) =>
      relative(repository, join(entry.parentPath ?? entry.path, entry.name))
        .split(sep)
        .join("/"),
    );
  const others = ["viewer/build.mjs", "viewer/package-lock.json", "viewer/tsconfig.json"];
  return [...files, ...others, "crates/ambulo-report/data/report/style.json"].sort();
}

/** FNV-1a of 64 bits over path, zero byte, contents, zero byte of every source. */
function hash() {
  let state = 0xcbf29ce484222325n;
  const feed = (bytes) => {
    for (const byte of bytes) {
      state = BigInt.asUintN(64, (state ^ BigInt(byte)) * 0x100000001b3n);
    }
  };
  for (const path of sources()) {
    feed(Buffer.from(`${path}\0`));
    feed(readFileSync(join(repository, path)));
    feed([0]);
  }
  return state.toString(16).padStart(16, "0");
}

/** The licence text of a package, as a comment. */
function notice(name) {
  const text = readFileSync(join(here, "node_modules", name, "LICENSE"), "utf8").trim();
  return `/*! ${name}\n\n${text}\n*/\n`;
}

/** Escapes text for a script or style element: no end tag, no comment start. */
function embeddable(text) {
  return text.replace(/<\/(script|style)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
}

async function bundle() {
  const result = await build({
    absWorkingDir: here,
    entryPoints: { viewer: "src/main.ts" },
    outdir: "out",
    write: false,
    bundle: true,
    minify: true,
    format: "iife",
    target: ["es2022"],
    charset: "utf8",
    legalComments: "none",
    loader: { ".css": "css" },
  });
  const text = (end) => result.outputFiles.find((file) => file.path.endsWith(end))?.text.trim() ?? "";
  const notices = notice("three") + notice("uplot");
  const first = `// Built from viewer/ by \`npm run build\`; do not edit. Sources: fnv1a64 ${hash()}`;
  return {
    "viewer.js": embeddable(`${first}\n${text(".js")}\n${notices}`),
    "viewer.css": embeddable(`${text(".css")}\n`),
  };
}

const files = await bundle();
for (const [name, text] of Object.entries(files)) {
  const path = join(target, name);
  if (!process.argv.includes("--check")) {
    writeFileSync(path, text);
  } else if (readFileSync(path, "utf8") !== text) {
    console.error(`${name} differs from its sources; run \`npm run build\` in viewer/ and commit it`);
    process.exitCode = 1;
  }
}
