"""Print the public names of the Python package as JSON: `python web/documents/python_api.py`.

The sources are read, not run: functions and classes that `ambulo.__all__` lists, with signature and documentation, and
the public methods and attributes of the classes. The reference page (documents.mjs) and the record of the surface
(docs/surface/python.txt) are made from it.
"""

from __future__ import annotations

import ast
import json
import re
from pathlib import Path

CRATE = Path(__file__).resolve().parents[2] / "crates/ambulo-py"
PACKAGE = CRATE / "python/ambulo"
Definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef


def definitions(path: Path) -> dict[str, Definition]:
    """Functions and classes of a file, by name."""
    body = ast.parse(path.read_text("utf-8")).body
    return {node.name: node for node in body if isinstance(node, Definition)}


def signature(node: ast.FunctionDef | ast.AsyncFunctionDef) -> str:
    """`(a, b=1) -> int`, without the object of a method."""
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    words = ast.unparse(node.args)
    for own in ("self, ", "cls, ", "self", "cls"):
        if words == own.strip(", ") or words.startswith(own) and own.endswith(" "):
            words = words[len(own) :]
            break
    return f"({words}){result}"


def marks(node: ast.FunctionDef | ast.AsyncFunctionDef) -> set[str]:
    return {ast.unparse(mark).split(".")[-1] for mark in node.decorator_list}


def compiled_documentation(name: str) -> str:
    """The comment above a method of the compiled class `Model`, whose stub has none."""
    lines = (CRATE / "src/model.rs").read_text("utf-8").splitlines()
    at = next((i for i, line in enumerate(lines) if re.match(rf"\s*(pub )?fn {name}\b", line)), 0)
    comment = []
    for line in reversed(lines[:at]):
        text = line.strip()
        if text.startswith("///"):
            comment.insert(0, text.removeprefix("///").removeprefix(" "))
        elif comment or not text or text == "}":
            break
    return "\n".join(comment)


def described(name: str, node: Definition) -> dict:
    """Name, kind, signature, documentation, members."""
    doc = ast.get_docstring(node) or ""
    if not isinstance(node, ast.ClassDef):
        kind = "attribute" if marks(node) & {"property", "cached_property"} else "function"
        result = f": {ast.unparse(node.returns)}" if node.returns else ""
        return {"name": name, "kind": kind, "signature": result if kind == "attribute" else signature(node), "doc": doc}
    members = []
    for part in node.body:
        if isinstance(part, ast.FunctionDef | ast.AsyncFunctionDef) and "overload" not in marks(part):
            if part.name == "__init__" or not part.name.startswith("_"):
                members.append(described(part.name, part))
        elif isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name):
            text = f": {ast.unparse(part.annotation)}"
            if not part.target.id.startswith("_"):
                members.append({"name": part.target.id, "kind": "attribute", "signature": text, "doc": ""})
    bases = ", ".join(ast.unparse(base) for base in node.bases)
    return {"name": name, "kind": "class", "signature": f"({bases})" if bases else "", "doc": doc, "members": members}


def public() -> dict:
    """The package's documentation and its public names in the order of `__all__`."""
    tree = ast.parse((PACKAGE / "__init__.py").read_text("utf-8"))
    listed, sources = [], {}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and node.module:
            sources |= {alias.asname or alias.name: (node.module, alias.name) for alias in node.names}
        elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            listed = ast.literal_eval(node.value)
    names = []
    for name in listed:
        module, original = sources[name]
        stem = module.removeprefix("ambulo.")
        path = next(path for path in (PACKAGE / f"{stem}.pyi", PACKAGE / f"{stem}.py") if path.is_file())
        names.append(described(name, definitions(path)[original]))
    for member in (member for name in names if name["name"] == "Model" for member in name["members"]):
        member["doc"] = member["doc"] or compiled_documentation(member["name"])
    return {"doc": ast.get_docstring(tree) or "", "names": names}


if __name__ == "__main__":
    print(json.dumps(public(), indent=1))
