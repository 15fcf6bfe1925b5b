// Builds the page and the documents into a folder that any static host can serve: `node web/build.mjs PROGRAM.wasm FOLDER [API]`. API is the folder
// of cargo's documentation, which becomes part of it, with a gallery if AMBULO names the program that draws it. The tools are those of viewer/.
//
// Every file but three has a hash of its content in its name, so a browser never mixes two versions: index.html, the manifest and the
// service worker keep theirs.
import { createHash } from "node:crypto";
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, extname, join, relative, sep } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { writeDocuments } from "./documents/documents.mjs";
import { drawGallery } from "./documents/gallery.mjs";
import { colours, REPORT } from "./style.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const { build } = createRequire(join(here, "../viewer/package.json"))("esbuild");

const [program, folder, api] = process.argv.slice(2);
if (!folder) {
  throw new Error("usage: node web/build.mjs PROGRAM.wasm FOLDER [API]");
}

/** Files of the page by name. */
const files = new Map();

/** Adds a file under a name with its hash; returns the name. */
function add(name, content) {
  const hash = createHash("sha256").update(content).digest("hex").slice(0, 12);
  const end = extname(name);
  const full = `${name.slice(0, name.length - end.length)}-${hash}${end}`;
  files.set(full, content);
  return full;
}

/** One script with the sources that it imports; `define` gives its constants. */
async function script(entry, define = {}, format = "iife") {
  const result = await build({
    absWorkingDir: here,
    entryPoints: [`src/${entry}.ts`],
    write: false,
    bundle: true,
    minify: true,
    format,
    target: ["es2022"],
    define: Object.fromEntries(Object.entries(define).map(([name, value]) => [name, JSON.stringify(value)])),
  });
  return Buffer.from(result.outputFiles[0].contents);
}

/** How a policy names a script. */
const named = (script) => `'sha256-${createHash("sha256").update(script).digest("base64")}'`;
/** The script that is added to pages of results that have none. */
const links = await script("links");

/** What the page may do until the program is loaded; engine.ts forbids the rest then. Scripts in pages of results are known by their hash. */
function policy() {
  const report = readFileSync(join(REPORT, "viewer.js"));
  return [
    "default-src 'none'",
    `script-src 'self' 'wasm-unsafe-eval' ${named(report)} ${named(links)}`,
    "style-src 'self' 'unsafe-inline'",
    "img-src 'self' data: blob:",
    "font-src data:",
    "connect-src 'self'",
    "manifest-src 'self'",
    "worker-src 'self' blob:",
    "frame-src blob:",
    "form-action 'none'",
    "base-uri 'none'",
  ].join("; ");
}

const drawing = readFileSync(join(here, "icon.svg"));
const icon = add("icon.svg", drawing);
const manifest = {
  name: "Ambulo",
  description: "Motion in, forces out: computed in the browser.",
  start_url: "./",
  display: "standalone",
  background_color: "#ffffff",
  icons: [{ src: icon, sizes: "any", type: "image/svg+xml" }],
};
files.set("manifest.webmanifest", JSON.stringify(manifest));
const names = {
  PROGRAM: add("ambulo.wasm", readFileSync(program)),
  WORKER: add("worker.js", await script("worker")),
  FAMILY: add("walks.json", readFileSync(join(here, "family/walks.json"))),
  OFFLINE: "offline.js",
  LINKS: links.toString(),
  LINKS_NAME: named(links),
};
const places = {
  policy: policy(),
  // Inside the page: the browser may ask for it only when connections are forbidden already.
  icon: `data:image/svg+xml;base64,${drawing.toString("base64")}`,
  manifest: "manifest.webmanifest",
  style: add("style.css", colours() + readFileSync(join(here, "src/style.css"), "utf8")),
  script: add("main.js", await script("main", names, "esm")),
};
const html = readFileSync(join(here, "index.html"), "utf8").replace(/\{(\w+)\}/g, (_, name) => places[name]);
files.set("index.html", html);

rmSync(folder, { recursive: true, force: true });
const gallery = process.env.AMBULO ? await drawGallery(process.env.AMBULO, join(folder, "documents")) : undefined;
const documents = writeDocuments(join(folder, "documents"), { api: api !== undefined, gallery });
/** What is kept in the browser, so that page and documents work offline; not the gallery, which is large. */
const readable = readdirSync(join(folder, "documents"), { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => relative(folder, join(entry.parentPath, entry.name)).split(sep).join("/"))
  .filter((path) => !path.startsWith("documents/gallery/"))
  .sort();
const version = createHash("sha256")
  .update([...files.keys()].join())
  .update(html);
for (const path of readable) {
  version.update(path).update(readFileSync(join(folder, path)));
}
const kept = ["./", ...files.keys(), ...readable.map((path) => path.split("/").map(encodeURIComponent).join("/"))];
const cache = `ambulo-${version.digest("hex").slice(0, 12)}`;
files.set("offline.js", await script("offline", { CACHE: cache, FILES: kept }));
mkdirSync(folder, { recursive: true });
let bytes = 0;
for (const [name, content] of files) {
  writeFileSync(join(folder, name), content);
  const packed = gzipSync(content, { level: 9 }).length;
  bytes += packed;
  process.stdout.write(`${name}: ${(packed / 1e3).toFixed(1)} kB compressed\n`);
}
process.stdout.write(`${folder}: ${files.size} files, ${(bytes / 1e6).toFixed(2)} MB compressed\n`);
if (api) {
  cpSync(api, join(folder, "api"), { recursive: true });
}
process.stdout.write(`${join(folder, "documents")}: ${documents} files\n`);
