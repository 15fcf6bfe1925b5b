// Makes the pages of the documents: README.md, docs/, and everything that they link to. A link that leads nowhere is an
// error.
//
// Pages have the places of their files, with the ending .html; README.html is index.html. Folders become one page with
// all of their files; other files are copied. The addresses of headings are those of GitHub, so that a link works there
// and here. A paragraph that is only a link `[Table: ..](file#heading)` shows the first table of that part above the
// link, so that no number is copied. Further pages are the search, the reference of the Python package and the gallery,
// if its pictures were made (gallery.mjs).
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, extname, join, posix } from "node:path";
import { fileURLToPath } from "node:url";
import { colours } from "../style.mjs";
import { pythonPage } from "./python_page.mjs";
import { searchIndex } from "./search.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "../..");
const MarkdownIt = createRequire(join(root, "viewer/package.json"))("markdown-it");
const FIRST = ["README.md", "CHANGELOG.md", "docs/README.md"];
/** What a page may load. */
const POLICY = "default-src 'none'; style-src 'self'; img-src 'self' data:; base-uri 'none'; form-action 'self'";
/** The search page has a script and an index. */
const SEARCH_POLICY = `${POLICY}; script-src 'self'; connect-src 'self'`;
const [, VERSION] = /^version = "(.+)"$/m.exec(readFileSync(join(root, "Cargo.toml"), "utf8"));

const markdown = new MarkdownIt({ html: false });
markdown.renderer.rules.table_open = () => '<div class="table" tabindex="0"><table>\n';
markdown.renderer.rules.table_close = () => "</table></div>\n";
// A reader with a keyboard scrolls what has the focus.
for (const kind of ["fence", "code_block"]) {
  const usual = markdown.renderer.rules[kind];
  markdown.renderer.rules[kind] = (...all) => usual.apply(null, all).replace("<pre", '<pre tabindex="0"');
}

// The policy allows no style in a page, so the side of a column is a class.
for (const kind of ["th_open", "td_open"]) {
  markdown.renderer.rules[kind] = (tokens, index) => {
    const [tag, style] = [tokens[index].tag, tokens[index].attrGet("style") ?? ""];
    return style === "text-align:right" ? `<${tag} class="right">` : `<${tag}>`;
  };
}

const isOutside = (link) => /^[a-z][a-z+.-]*:/i.test(link);

/** The address of a heading. */
export function slug(heading) {
  const kept = heading.toLowerCase().replace(/[^\p{L}\p{N}\p{M}_\- ]/gu, "");
  return kept.replaceAll(" ", "-");
}

/** The text of a heading without marks. */
const textOf = (token) => (token.children ?? []).map((child) => child.content).join("");

/** The file of a page or copy of a path in the repository. */
export function placeOf(path) {
  const name = posix.basename(path);
  if (name === "README.md") {
    return posix.join(posix.dirname(path), "index.html");
  }
  if (path.endsWith(".md")) {
    return path.replace(/\.md$/, ".html");
  }
  if (statSync(join(root, path)).isDirectory()) {
    return posix.join(path, "index.html");
  }
  // Without an ending, a host does not know that a file is text.
  return extname(name) === "" ? `${path}.txt` : path;
}

/** All links and pictures of a document, as tokens with the name of their attribute. */
function* linksIn(tokens) {
  for (const token of tokens) {
    if (token.type === "link_open") {
      yield [token, "href"];
    } else if (token.type === "image") {
      yield [token, "src"];
    }
    yield* linksIn(token.children ?? []);
  }
}

/** A document before its links are made. */
function read(path, text = readFileSync(join(root, path), "utf8")) {
  const tokens = markdown.parse(text, {});
  const ids = new Set();
  const headings = [];
  tokens.forEach((token, index) => {
    if (token.type !== "heading_open") {
      return;
    }
    const text = textOf(tokens[index + 1]);
    const own = slug(text);
    let id = own;
    for (let count = 1; ids.has(id); count++) {
      id = `${own}-${count}`;
    }
    ids.add(id);
    token.attrSet("id", id);
    headings.push({ level: Number(token.tag.slice(1)), text, id });
  });
  return { path, tokens, ids, headings };
}

/**
 * The documents that are reached from the first ones and from all of docs/, and the other files and folders that they
 * link to.
 */
export function collect() {
  const documents = new Map();
  const others = new Set();
  const dead = [];
  const inDocs = readdirSync(join(root, "docs"), { recursive: true, encoding: "utf8" });
  const waiting = [...FIRST, ...inDocs.filter((name) => name.endsWith(".md")).map((name) => posix.join("docs", name))];
  while (waiting.length > 0) {
    const path = waiting.pop();
    if (documents.has(path)) {
      continue;
    }
    const document = read(path);
    documents.set(path, document);
    for (const [token, attribute] of linksIn(document.tokens)) {
      const link = token.attrGet(attribute);
      const file = decodeURI(link).split("#")[0];
      if (isOutside(link) || file === "") {
        continue;
      }
      const target = posix.normalize(posix.join(posix.dirname(path), file)).replace(/\/$/, "");
      if (!existsSync(join(root, target))) {
        dead.push(`${path}: ${link}`);
      } else if (target.endsWith(".md")) {
        waiting.push(target);
      } else {
        others.add(target);
      }
    }
  }
  return { documents, others, dead };
}

/** The address of a link from a document; a missing heading is added to `dead`. */
function address(link, document, documents, dead) {
  if (isOutside(link)) {
    return link;
  }
  const [file, heading] = decodeURI(link).split("#");
  const { path } = document;
  const target = file === "" ? path : posix.normalize(posix.join(posix.dirname(path), file)).replace(/\/$/, "");
  const ids = documents.get(target)?.ids;
  if (heading && ids && !ids.has(heading)) {
    dead.push(`${path}: ${link}`);
  }
  if (!existsSync(join(root, target))) {
    return link;
  }
  const from = posix.dirname(placeOf(path));
  const place = file === "" ? "" : posix.relative(from, placeOf(target));
  return heading ? `${place}#${heading}` : place;
}

const escaped = (text) => markdown.utils.escapeHtml(text);

/** A page; `place` is its file. */
function page(place, title, content, has, policy = POLICY) {
  const up = posix.relative(posix.dirname(place), ".") || ".";
  const links = [
    ["index.html", "Ambulo"],
    ["docs/index.html", "Documents"],
    ...(has.gallery ? [["gallery.html", "Gallery"]] : []),
    ["docs/BENCHMARKS.html", "Benchmarks"],
    ["python.html", "Python"],
    ...(has.api ? [["../api/ambulo/index.html", "Rust"]] : []),
    ["../index.html", "Compute in the browser"],
  ].map(([to, name]) => `<a href="${up}/${to}">${name}</a>`);
  return `<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta http-equiv="Content-Security-Policy" content="${policy}" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="light dark" />
    <title>${escaped(title)} - Ambulo</title>
    <link rel="icon" href="data:," />
    <link rel="stylesheet" href="${up}/style.css" />
  </head>
  <body>
    <a class="skip" href="#content">Skip to the content</a>
    <header>
      <nav aria-label="Site">${links.join(" ")}
        <form action="${up}/search.html" role="search"><input type="search" name="q" aria-label="Search the documents" placeholder="Search" /></form>
      </nav>
    </header>
    <main id="content" tabindex="-1">
${content}
    </main>
    <footer>Ambulo ${VERSION} · <a href="${up}/CHANGELOG.html">changes</a> · <a href="${up}/docs/RELEASES.html">what is stable</a></footer>
  </body>
</html>
`;
}

/** The list of the parts of a long document, after its title. */
function contents({ headings }) {
  const parts = headings.filter(({ level }) => level === 2);
  if (parts.length < 4) {
    return "";
  }
  const items = parts.map(({ text, id }) => `<li><a href="#${id}">${escaped(text)}</a></li>`);
  return `<details><summary>On this page</summary><ul>${items.join("")}</ul></details>\n`;
}

/** Puts the tables that a document only links to above their links. */
function withTables(document, documents) {
  const tokens = [];
  document.tokens.forEach((token, index) => {
    const inline = document.tokens[index + 1];
    const link = token.type === "paragraph_open" && inline?.children?.length === 3 ? inline.children[0] : undefined;
    if (link?.type === "link_open" && inline.content.startsWith("[Table: ")) {
      const [file, heading] = link.attrGet("href").split("#");
      const from = documents.get(posix.normalize(posix.join(posix.dirname(document.path), file)));
      const begin =
        from?.tokens.findIndex(
          (one) => one.type === "heading_open" && (heading === undefined || one.attrGet("id") === heading),
        ) ?? -1;
      const open = from?.tokens.findIndex((one, place) => place > begin && one.type === "table_open") ?? -1;
      const close = from?.tokens.findIndex((one, place) => place > open && one.type === "table_close") ?? -1;
      if (begin < 0 || open < 0) {
        throw new Error(`${document.path}: ${link.attrGet("href")} has no table`);
      }
      tokens.push(...from.tokens.slice(open, close + 1));
    }
    tokens.push(token);
  });
  return tokens;
}

function rendered(document, documents, dead) {
  document.tokens = withTables(document, documents);
  for (const [token, attribute] of linksIn(document.tokens)) {
    token.attrSet(attribute, address(token.attrGet(attribute), document, documents, dead));
  }
  const html = markdown.renderer.render(document.tokens, markdown.options, {});
  return html.replace("</h1>\n", `</h1>\n${contents(document)}`);
}

/** All text files of a folder on one page. */
function folderPage(path) {
  const names = readdirSync(join(root, path), { recursive: true, encoding: "utf8" }).sort();
  const files = names.filter((name) => statSync(join(root, path, name)).isFile());
  const parts = files.map((name) => {
    const text = readFileSync(join(root, path, name), "utf8");
    return `<h2 id="${slug(name)}">${escaped(name)}</h2>\n<pre tabindex="0"><code>${escaped(text)}</code></pre>`;
  });
  return `<h1>${escaped(path)}</h1>\n${parts.join("\n")}`;
}

/** The search page; the form asks it, and its script answers. */
const SEARCH = `<h1>Search</h1>
<p><input type="search" id="question" aria-label="Words" /></p>
<p id="count" role="status"></p>
<ol id="found"></ol>
<noscript><p>The search needs scripts. <a href="docs/index.html">All documents by reader and by kind</a> work without.</p></noscript>
<script src="search.js"></script>`;

/** Writes the pages into a folder; returns how many files it has. `has` tells which other parts the site has. */
export function writeDocuments(folder, has) {
  const { documents, others, dead } = collect();
  const python = read("python.md", pythonPage());
  const all = [...documents.values(), python];
  const files = new Map();
  files.set("search-index.json", searchIndex(all.map((document) => [document, placeOf(document.path)])));
  files.set("search.js", readFileSync(join(here, "search.js"), "utf8"));
  files.set("search.html", page("search.html", "Search", SEARCH, has, SEARCH_POLICY));
  if (has.gallery) {
    files.set("gallery.html", page("gallery.html", "Gallery", has.gallery, has));
  }
  for (const document of all) {
    const place = placeOf(document.path);
    const title = document.headings[0]?.text ?? document.path;
    files.set(place, page(place, title, rendered(document, documents, dead), has));
  }
  for (const path of others) {
    const place = placeOf(path);
    if (statSync(join(root, path)).isDirectory()) {
      files.set(place, page(place, path, folderPage(path), has));
    } else {
      mkdirSync(dirname(join(folder, place)), { recursive: true });
      cpSync(join(root, path), join(folder, place));
    }
  }
  if (dead.length > 0) {
    throw new Error(`links that lead nowhere:\n${dead.join("\n")}`);
  }
  files.set("style.css", colours() + readFileSync(join(here, "style.css"), "utf8"));
  for (const [name, content] of files) {
    mkdirSync(dirname(join(folder, name)), { recursive: true });
    writeFileSync(join(folder, name), content);
  }
  return files.size + others.size;
}
