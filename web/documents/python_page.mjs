// The reference page of the Python package, from its stubs and documentation (python_api.py).
import { spawnSync } from "node:child_process";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

function read() {
  for (const program of ["python3", "python"]) {
    const run = spawnSync(program, [join(here, "python_api.py")], { encoding: "utf8" });
    if (run.status === 0) {
      return JSON.parse(run.stdout);
    }
    if (run.error === undefined) {
      throw new Error(run.stderr);
    }
  }
  throw new Error("Python was not found; the reference of the Python package needs Python 3.10 or later");
}

/** Documentation in the style of NumPy as Markdown: titles with a line below them become bold, examples become code. */
function markdownOf(doc) {
  const lines = doc.split("\n");
  const out = [];
  let isCode = false;
  lines.forEach((line, index) => {
    const isTitle = /^-{3,}$/.test(lines[index + 1] ?? "") && line.trim() !== "";
    if (/^-{3,}$/.test(line)) {
      return;
    }
    const startsCode = line.startsWith(">>> ");
    if (startsCode && !isCode) {
      out.push("", "```python");
      isCode = true;
    } else if (isCode && line.trim() === "") {
      out.push("```");
      isCode = false;
    }
    const parameter = /^([\w*][\w, *]*) : (.+)$/.exec(line);
    if (isTitle) {
      out.push("", `**${line.trim()}**`, "");
    } else if (!isCode && parameter) {
      out.push("", `- \`${parameter[1]}\` (${parameter[2]}):`);
    } else {
      out.push(isCode ? line : line.replaceAll("``", "`"));
    }
  });
  return [...out, ...(isCode ? ["```"] : [])].join("\n");
}

/** Where the list of arguments ends. */
function end(signature) {
  let depth = 0;
  return (
    [...signature].findIndex((letter) => {
      depth += { "(": 1, "[": 1, ")": -1, "]": -1 }[letter] ?? 0;
      return depth === 0;
    }) + 1
  );
}

/** The arguments of a signature. */
function inside(signature) {
  const parts = [""];
  let depth = 0;
  for (const letter of signature.slice(1, end(signature) - 1)) {
    depth += { "(": 1, "[": 1, ")": -1, "]": -1 }[letter] ?? 0;
    if (letter === "," && depth === 0) {
      parts.push("");
    } else {
      parts.push(parts.pop() + letter);
    }
  }
  return parts.map((part) => part.trim());
}

function heading(level, owner, { name, kind, signature }) {
  const title = name === "__init__" ? `${owner}(..)` : `${owner}${owner ? "." : ""}${name}`;
  const word = kind === "class" ? "class " : "";
  // A long signature has a line per argument.
  const call = name === "__init__" ? owner : name;
  const long = signature.length > 90 && kind !== "attribute";
  const shown = long
    ? `(${inside(signature).map((part) => `\n    ${part}`)}\n)${signature.slice(end(signature))}`
    : signature;
  return `${"#".repeat(level)} ${title}\n\n\`\`\`python\n${word}${call}${shown}\n\`\`\`\n`;
}

/** The page as Markdown. */
export function pythonPage() {
  const { doc, names } = read();
  const one = (value, owner, level) => `${heading(level, owner, value)}\n${markdownOf(value.doc)}\n`;
  const parts = names.map((value) => {
    return [one(value, "", 2), ...(value.members ?? []).map((member) => one(member, value.name, 3))].join("\n");
  });
  const kinds = (kind) =>
    names.filter((value) => (value.kind === "class") === kind).map(({ name }) => `[${name}](#${name.toLowerCase()})`);
  const lists = `**Functions**: ${kinds(false).join(" · ")}\n\n**Classes**: ${kinds(true).join(" · ")}`;
  return `# Python package: reference\n\n${markdownOf(doc)}\n\n[How to use it](docs/PYTHON.md). ${lists}\n\n${parts.join("\n")}`;
}
