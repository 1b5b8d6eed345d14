#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the parts of the documentation that are made from the program, the schemas and the headers.

    docs_reference.py NOLI FOLDER

FOLDER gets commands.md (each `--help`), scene.md and results.md (schemas/), cpp.md (include/noli, for Breathe) and python.md (the
docstrings of python/noli).
"""
import ast
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def help_of(noli, words):
    done = subprocess.run([noli, *words, "--help"], check=True, capture_output=True, text=True)
    return done.stdout


def subcommands(text):
    """The names below the line "Commands:"."""
    block = re.search(r"^Commands:\n((?:  .*\n)+)", text, re.MULTILINE)
    return re.findall(r"^  ([a-z][a-z-]*) ", block.group(1), re.MULTILINE) if block else []


def commands(noli, words=()):
    text = help_of(noli, words)
    title = " ".join(["noli", *words])
    parts = [f"## `{title}`\n\n```text\n{text.strip()}\n```\n"]
    for name in subcommands(text):
        parts += commands(noli, (*words, name))
    return parts


def all_commands(noli):
    parts = commands(noli)
    if len(parts) < 10:  # the help has another form
        sys.exit(f"docs_reference.py: {noli} --help names {len(parts) - 1} commands; expected a list below \"Commands:\"")
    return "\n".join(parts)


def cell(text):
    """Text that stays within one cell of a table; names in backticks stay code."""
    return re.sub(r"[*<>\[\]]", lambda match: "\\" + match[0], str(text).replace("|", "\\|").replace("\n", " "))


def literal(value):
    return f"`{json.dumps(value, ensure_ascii=False)}`".replace("|", "\\|")


def reference_name(schema):
    return schema["$ref"].rsplit("/", 1)[-1]


def type_of(schema, link):
    if "$ref" in schema:
        name = reference_name(schema)
        return f"[{name}](#{anchor(name)})" if link else f"`{name}`"
    if "const" in schema:
        return literal(schema["const"])
    if "enum" in schema:
        return ", ".join(literal(value) for value in schema["enum"])
    for several in ("oneOf", "anyOf"):
        if several in schema:
            return " or ".join(dict.fromkeys(type_of(part, link) for part in schema[several]))
    kind = schema.get("type", "any")
    if isinstance(kind, list):
        return " or ".join(kind)
    if kind == "array" and isinstance(schema.get("items"), dict):
        kind = "array of " + type_of(schema["items"], link)
    def number(value):
        return str(value) if isinstance(value, int) else f"{value:g}"

    low = schema.get("minimum", schema.get("exclusiveMinimum"))
    high = schema.get("maximum", schema.get("exclusiveMaximum"))
    if low is not None:
        kind += f", {'at least' if 'minimum' in schema else 'above'} {number(low)}"
    if high is not None:
        kind += f", {'at most' if 'maximum' in schema else 'below'} {number(high)}"
    return kind


def anchor(name):
    """As MyST makes the anchor of the heading `name`."""
    return name.lower()


def description_of(schema):
    parts = [schema.get("description", "")]
    if "unit" in schema:
        parts.append(f"[{schema['unit']}]")
    return " ".join(part for part in parts if part)


def members(schema, link, defaults):
    required = schema.get("required", [])
    head = ["member", "value", "meaning"] + (["default"] if defaults else [])
    rows = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for name, member in schema.get("properties", {}).items():
        row = [f"`{name}`", type_of(member, link), cell(description_of(member))]
        if defaults:
            default = literal(member["default"]) if "default" in member else ""
            row.append("required" if name in required else default)
        rows.append("| " + " | ".join(row) + " |")
    return "\n".join(rows) + "\n"


def forms(schema):
    """The schema itself, or what it may be one of."""
    return next((schema[several] for several in ("oneOf", "anyOf") if several in schema), [schema])


def objects_in(schema):
    """Objects that are described in place: what a member holds, or each entry of its array."""
    for form in forms(schema):
        if "properties" in form:
            yield form
        elif isinstance(form.get("items"), dict):
            yield from objects_in(form["items"])


def with_inner_objects(schema, path):
    """A table of members, and a table for each of them that is an object without a name of its own."""
    parts = [members(schema, True, True)]
    for name, member in schema.get("properties", {}).items():
        inner = f"{path}/{name}"
        for form in objects_in(member):
            parts += [f"Members of `{inner}`:\n", with_inner_objects(form, inner)]
    return "\n".join(parts)


def definition(name, schema):
    parts = [f"### {name}\n"]
    if "description" in schema:
        parts.append(cell(description_of(schema)) + "\n")
    if "properties" in schema:
        parts.append(with_inner_objects(schema, name))
    else:
        parts.append("Value: " + type_of(schema, True) + ".\n")
        for form in objects_in(schema):
            parts.append("Members of an object:\n\n" + with_inner_objects(form, name))
    return "\n".join(parts)


def scene():
    schema = json.loads((ROOT / "schemas/scene.json").read_text(encoding="utf-8"))
    parts = ["## The scene\n", with_inner_objects(schema, "scene"), "## Its parts\n"]
    parts += [definition(name, part) for name, part in schema["$defs"].items()]
    return "\n".join(parts)


def results():
    parts = []
    for path in sorted((ROOT / "schemas").glob("*.json")):
        if path.stem == "scene":
            continue
        schema = json.loads(path.read_text(encoding="utf-8"))
        parts.append(f"## {path.stem}\n")
        parts.append(cell(schema.get("description", schema.get("title", ""))) + "\n")
        parts.append(members(schema, False, False))
    return "\n".join(parts)


def intro(path):
    """The comment at the head of a header, without the line of the licence."""
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines()[1:]:
        if line.startswith(("#pragma", "#include", "/* NOLINT")):
            break
        lines.append(re.sub(r"^(//|/\*| \*/?) ?", "", line))
    return "\n".join(lines).strip()


def cpp():
    parts = []
    for path in sorted((ROOT / "include/noli").glob("*.h")):
        parts.append(f"## noli/{path.name}\n")
        if path.name == "ccd_plugin.h":  # C, with comments that Doxygen does not read
            parts.append(f"```{{literalinclude}} /../include/noli/{path.name}\n:language: c\n```\n")
        else:
            parts.append(f"```text\n{intro(path)}\n```\n")
            parts.append(f"```{{doxygenfile}} {path.name}\n```\n")
    return "\n".join(parts)


def signature(function):
    """As it is called: an argument a line if there are many."""
    if function.args.posonlyargs or function.args.vararg or function.args.kwarg:
        sys.exit(f"docs_reference.py: {function.name} has arguments of a kind that is not described here")
    arguments = [ast.unparse(argument) for argument in _with_defaults(function.args) if argument.args[0].arg != "self"]
    result = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    line = f"{function.name}({', '.join(arguments)}){result}"
    return line if len(line) <= 100 else f"{function.name}(\n    " + ",\n    ".join(arguments) + f",\n){result}"


def _with_defaults(arguments):
    """The arguments one by one, each with its annotation and default; a bare star as it is."""
    defaults = [None] * (len(arguments.args) - len(arguments.defaults)) + arguments.defaults
    for argument, default in zip(arguments.args, defaults):
        yield ast.arguments([], [argument], None, [], [], None, [default] if default else [])
    if arguments.kwonlyargs:
        yield ast.arguments([], [ast.arg("*")], None, [], [], None, [])
    for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults):
        yield ast.arguments([], [argument], None, [], [], None, [default] if default else [])


def described(node, text):
    """Code, and below it the docstring, if there is one."""
    words = ast.get_docstring(node)
    return f"```python\n{text}\n```\n" + (f"```text\n{words}\n```\n" if words else "")


def head_of(node):
    """Of a class that people make, what makes it; of an exception, what it is."""
    for member in node.body:
        if getattr(member, "name", None) == "__init__" and "Parameters\n" in (ast.get_docstring(node) or ""):
            return "noli." + signature(member).replace("__init__", node.name).removesuffix(" -> None")
    bases = ", ".join(map(ast.unparse, node.bases))
    return f"class {node.name}({bases})" if bases else f"class {node.name}"


def python_class(node):
    parts = [described(node, head_of(node))]
    for member in node.body:
        if not isinstance(member, ast.FunctionDef) or member.name.startswith("_") or ast.get_docstring(member) is None:
            continue
        is_property = any(ast.unparse(one) == "property" for one in member.decorator_list)
        type_ = f": {ast.unparse(member.returns)}" if member.returns else ""
        parts.append(described(member, f"{node.name}.{member.name}{type_}" if is_property else f"{node.name}.{signature(member)}"))
    return "\n".join(parts)


def python():
    """What `import noli` offers, in alphabetical order."""
    package = ROOT / "python/noli"
    public, parts = [], []
    for line in ast.parse((package / "__init__.py").read_text(encoding="utf-8")).body:
        if isinstance(line, ast.Assign) and ast.unparse(line.targets[0]) == "__all__":
            public = ast.literal_eval(line.value)
    for path in sorted(package.glob("_*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if getattr(node, "name", None) not in public:
                continue
            text = python_class(node) if isinstance(node, ast.ClassDef) else described(node, "noli." + signature(node))
            parts.append((node.name, f"## {node.name}\n\n{text}"))
    missing = set(public) - {name for name, _ in parts}
    if missing or not parts:
        sys.exit(f"docs_reference.py: python/noli has no {sorted(missing)}; expected all of noli.__all__")
    types = ast.parse((package / "_types.py").read_text(encoding="utf-8")).body
    names = "\n".join(ast.unparse(line) for line in types if isinstance(line, ast.Assign))
    parts.sort(key=lambda part: part[0].lower())
    return "\n".join(text for _, text in parts) + f"\n## Types\n\n```python\n{names}\n```\n"


def main():
    noli, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in {
        "commands": all_commands(noli),
        "scene": scene(),
        "results": results(),
        "cpp": cpp(),
        "python": python(),
    }.items():
        (folder / f"{name}.md").write_text(text, encoding="utf-8")


main()
