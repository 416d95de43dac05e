"""Writes `trueness/documents/` and `trueness/tasks.py` from the schemas of `docs/schema/`.

    python generate.py            writes them
    python generate.py --check    fails where they are not what the schemas say
"""

from __future__ import annotations

import json
import keyword
import re
import sys
import textwrap
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
SCHEMAS = HERE.parent / "docs" / "schema"
PACKAGE = HERE / "trueness"
HEAD = '"""{about}\n\nWritten by `generate.py` from the schemas of `docs/schema/`."""\n\nfrom __future__ import annotations\n\n'
WIDTH = 110

# The names of what each task measures, which are given by position; all others by keyword.
POSITIONAL = {
    "align": ["measured", "reference"],
    "check": ["mesh"],
    "compare": ["measured", "references"],
    "convert": ["input", "out"],
    "curvature": ["input"],
    "fit": ["points"],
    "info": ["file"],
    "inspect": ["plan"],
    "plan_init": ["nominal"],
    "repair": ["mesh"],
    "section": ["input"],
    "segment": ["input"],
    "surface": ["points"],
    "trend": ["results"],
}
# What may be an object in memory instead of a path.
SOURCES = {"measured", "reference", "references", "mesh", "input", "points", "file", "nominal", "plan", "regions", "scale"}
OUTPUTS = {"out", "csv", "junit", "qif", "dxf", "svg", "step", "iges", "obj", "knots"}
# Texts that are numbers as well: `0.1`, `-0.1,+0.2`, `0,0,1`.
NUMBERS = {"tolerance", "along", "coverage", "fairness", "noise", "degree", "spans", "columns", "normals"}


def title(name: str) -> str:
    return "".join(part[0].upper() + part[1:] for part in re.split(r"[_-]", name))


def attribute(name: str) -> str:
    return name + "_" if keyword.iskeyword(name) else name


def is_null(schema: dict[str, Any]) -> bool:
    return schema.get("type") == "null"


class Module:
    """The classes of one schema, or of several that share them."""

    def __init__(self, shared: dict[str, Any]) -> None:
        self.shared = shared
        self.used: set[str] = set()
        self.classes: list[str] = []

    def words(self, schema: dict[str, Any]) -> list[str] | None:
        """The words of an enumeration."""
        if "enum" in schema:
            return [w for w in schema["enum"] if isinstance(w, str)]
        if "const" in schema:
            return [schema["const"]]
        variants = schema.get("oneOf", [])
        if variants and all("const" in v or ("enum" in v and v.get("type") == "string") for v in variants):
            return [w for v in variants for w in (self.words(v) or [])]
        return None

    def kind(self, schema: Any, defs: dict[str, Any]) -> tuple[str, str | None]:
        """The type of a value for the type checker, and how it is wrapped."""
        if not isinstance(schema, dict) or not schema:
            return "Json", None
        if "$ref" in schema:
            name = schema["$ref"].split("/")[-1]
            words = self.words(defs[name])
            if words is not None:
                return f"Literal[{', '.join(map(json.dumps, words))}]", None
            if not self.is_record(defs[name]):
                return self.kind(defs[name], defs)
            if name in self.shared:
                self.used.add(name)
            return name, name
        words = self.words(schema)
        if words is not None:
            return f"Literal[{', '.join(map(json.dumps, words))}]", None
        for key in ("anyOf", "oneOf"):
            if key in schema:
                own = [v for v in schema[key] if not is_null(v)]
                kinds = [self.kind(v, defs) for v in own]
                wraps = {w for _, w in kinds if w}
                text = " | ".join(dict.fromkeys(k for k, _ in kinds))
                return text + (" | None" if len(own) < len(schema[key]) else ""), wraps.pop() if len(wraps) == 1 else None
        types = schema.get("type")
        types = types if isinstance(types, list) else [types]
        null = " | None" if "null" in types else ""
        main = [t for t in types if t != "null"]
        if main == ["array"]:
            item, wrap = self.kind(schema.get("items", {}), defs)
            return f"list[{item}]{null}", f"[{wrap}]" if wrap else None
        if main == ["object"]:
            item, wrap = self.kind(schema.get("additionalProperties", {}), defs)
            return f"dict[str, {item}]{null}", "{" + wrap + "}" if wrap else None
        plain = {"string": "str", "integer": "int", "number": "float", "boolean": "bool"}
        return " | ".join(plain.get(t, "Json") for t in main) + null, None

    @staticmethod
    def is_record(schema: dict[str, Any]) -> bool:
        return bool(schema.get("properties")) or any(v.get("properties") for v in schema.get("oneOf", []))

    def record(self, name: str, schema: dict[str, Any], defs: dict[str, Any], base: str = "Record") -> None:
        """The class of an object; of one that comes in several forms the attributes of all."""
        variants = [v for v in schema.get("oneOf", []) if v.get("properties")]
        fields: dict[str, list[tuple[str, str | None]]] = {}
        about: dict[str, str] = {}
        always = set(schema.get("required", []))
        if variants:
            always |= set.intersection(*(set(v.get("required", [])) for v in variants))
        for part in [schema, *variants]:
            for key, value in part.get("properties", {}).items():
                fields.setdefault(key, []).append(self.kind(value, defs))
                if isinstance(value, dict):
                    about.setdefault(key, value.get("description", ""))
        lines = [f"class {name}({base}):", *docstring(schema.get("description", title(name)), 1)]
        wraps = {}
        for key, kinds in fields.items():
            words = {w for k, _ in kinds if k.startswith("Literal[") for w in re.findall(r'"[^"]*"', k)}
            text = f"Literal[{', '.join(sorted(words))}]" if words else " | ".join(dict.fromkeys(k for k, _ in kinds))
            if key not in always and "None" not in text:
                text += " | None"
            if kinds[0][1]:
                wraps[key] = kinds[0][1]
            if key.isidentifier() and not (base == "TaskDocument" and key == "verdict"):
                lines += [f"    {attribute(key)}: {text}", *docstring(about.get(key, ""), 1)]
        if wraps:
            lines += ["", f"    _nested = {json.dumps(wraps)}"]
        self.classes.append("\n".join(lines))


def docstring(text: str, depth: int) -> list[str]:
    """A docstring, with its lines broken; nothing for nothing."""
    text = " ".join(text.split("```")[0].split()).replace("\\", "\\\\")
    if not text:
        return []
    text = re.sub(r"\[`([^`]*)`\](\([^)]*\))?", r"`\1`", text)
    lines = textwrap.wrap(f'"""{text}"""', WIDTH - 4 * depth)
    return [" " * 4 * depth + line for line in lines]


def documents() -> dict[str, str]:
    """The files of `documents/`."""
    schemas = {p.stem: json.loads(p.read_text()) for p in sorted(SCHEMAS.glob("*.json")) if p.stem != "plan"}
    seen: dict[str, list[Any]] = {}
    for schema in schemas.values():
        for name, own in schema.get("$defs", {}).items():
            seen.setdefault(name, []).append(own)
    equal = {n: v[0] for n, v in seen.items() if len(v) > 1 and all(o == v[0] for o in v) and Module.is_record(v[0])}
    # What others need must be there as well.
    shared = {n: v for n, v in equal.items() if all(r not in seen or r in equal or not any(Module.is_record(o) for o in seen[r]) for r in refs(v))}
    while True:
        rest = {n: v for n, v in shared.items() if all(r in shared or not any(Module.is_record(o) for o in seen[r]) for r in refs(v))}
        if len(rest) == len(shared):
            break
        shared = rest
    all_defs = {n: v[0] for n, v in seen.items()}
    files = {"_common.py": write("What several documents have.", Module({}), [(n, v, "Record") for n, v in shared.items()], all_defs)}
    for stem, schema in schemas.items():
        defs = schema.get("$defs", {})
        own = [(n, v, "Record") for n, v in defs.items() if n not in shared and Module.is_record(v)]
        own.append((f"{title(stem)}Document", schema, "TaskDocument"))
        files[f"{stem}.py"] = write(f"The document of `{stem}`.", Module(shared), own, defs)
    exports = [f"from .{s} import {title(s)}Document as {title(s)}Document" for s in schemas]
    files["__init__.py"] = HEAD.format(about="The documents of the tasks, with types.") + "\n".join(exports) + "\n"
    return files


def refs(schema: Any) -> set[str]:
    if isinstance(schema, dict):
        own = {schema["$ref"].split("/")[-1]} if "$ref" in schema else set()
        return own.union(*(refs(v) for v in schema.values()))
    if isinstance(schema, list):
        return set().union(*(refs(v) for v in schema))
    return set()


def write(about: str, module: Module, classes: list[tuple[str, Any, str]], defs: dict[str, Any]) -> str:
    for name, schema, base in classes:
        module.record(name, schema, defs, base)
    body = "\n\n\n".join(module.classes) + "\n"
    imports = []
    if "Literal[" in body:
        imports.append("from typing import Literal\n")
    names = [n for n in ("Json", "Record", "TaskDocument") if re.search(rf"\b{n}\b", body)]
    imports.append(f"from .._document import {', '.join(names)}")
    if module.used:
        imports.append("from ._common import (" + "".join(f"\n    {n} as {n}," for n in sorted(module.used)) + "\n)")
    return HEAD.format(about=about) + "\n".join(imports) + "\n\n\n" + body


def argument(task: str, name: str, schema: dict[str, Any], defs: dict[str, Any]) -> str:
    """The type of an argument."""
    if name == "results":
        return "Sequence[Source | TaskDocument]"
    if name == "references":
        return "Source | Sequence[Source]"
    if task == "inspect" and name == "measured":
        return "Source | Sequence[Source]"
    is_path = "string" in schema.get("type", [])
    if name in SOURCES and is_path and not (task == "align" and name == "points"):
        return "Source"
    if name in OUTPUTS or (task == "align" and name == "points"):
        return "Path"
    if name in NUMBERS and is_path:
        return "Text"
    text, _ = Module({}).kind(schema, defs)
    return text.replace(" | None", "").replace("list[", "Sequence[")


def passed(key: str, schema: dict[str, Any]) -> str:
    """How an argument is handed on: one source stands for a list of one, numbers for their text."""
    if key in SOURCES | {"results"} and schema.get("type") == "array":
        return f"several({attribute(key)})"
    if key in NUMBERS and "string" in schema.get("type", []):
        return f"{'limits' if key == 'tolerance' else 'text'}({attribute(key)})"
    return attribute(key)


def default(schema: dict[str, Any], name: str) -> str:
    value = True if name == "view" else schema.get("default")
    if isinstance(value, list):
        return "()" if not value else repr(tuple(value))
    return repr(value) if not isinstance(value, str) else json.dumps(value)


def task(stem: str) -> str:
    """The function of a task."""
    schema = json.loads((SCHEMAS / "requests" / f"{stem}.json").read_text())
    name, defs = stem.replace("-", "_"), schema.get("$defs", {})
    first = POSITIONAL[name]
    result = "ProposedPlan" if name == "plan_init" else f"{title(stem)}Document"
    lines, given, about = [], [], []
    for key in first:
        kind = argument(name, key, schema["properties"][key], defs)
        optional = name == "convert" and key == "out"
        lines.append(f"    {key}: {kind},")
        given.append(key)
        about += described(key, kind, schema["properties"][key])
    lines.append("    *,")
    for key, value in schema["properties"].items():
        if key in first:
            continue
        kind, start = argument(name, key, value, defs), default(value, key)
        kind += " | None" if start == "None" else ""
        lines.append(f"    {attribute(key)}: {kind} = {start},")
        given.append(key)
        about += described(attribute(key), kind, value)
    lines += ["    progress: Progress = None,", "    **unknown: Never,"]
    text = [f"def {name}(", *lines, f") -> {result}:", f'    """{SUMMARIES[name]}', ""]
    text += ["    Parameters", "    ----------", *about]
    text += ["    progress : callable or bool, optional", "        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm."]
    text += ["", "    Returns", "    -------", f"    {result}", *example(name), '    """']
    origin = "_run" if name == "plan_init" else f"documents.{stem}"
    text.append(f"    from .{origin} import {result}")
    text.append("")
    text += ["    given: dict[str, object] = {", *(f'        "{key}": {passed(key, schema["properties"][key])},' for key in given), "    }"]
    text.append(f'    return run("{name}", {result}, given, progress, unknown)')
    return "\n".join(text)


def described(name: str, kind: str, schema: dict[str, Any]) -> list[str]:
    text = " ".join(schema.get("description", "").split())
    return [f"    {name} : {kind}", *textwrap.wrap(text, WIDTH - 8, initial_indent=" " * 8, subsequent_indent=" " * 8)]


SUMMARIES = {
    "align": "Brings a scan onto its reference.",
    "check": "Finds what is wrong with a mesh.",
    "compare": "Deviations of a scan from one or several references, with statistics and verdict.",
    "convert": "Writes a file or an object in another format.",
    "curvature": "Principal, mean and Gaussian curvatures.",
    "fit": "Fits an element, such as a plane or a cylinder, to points.",
    "info": "What is in a file.",
    "inspect": "Runs an inspection plan.",
    "plan_init": "Proposes a plan from the nominal.",
    "repair": "Mends what `check` finds.",
    "section": "Lines, arcs and curves of a profile, or of a mesh or cloud in planes.",
    "segment": "Finds planes, cylinders and other elements in a scan.",
    "surface": "A B-spline surface through points.",
    "trend": "One plan over many parts: course, spread, capability.",
}
EXAMPLES = {
    "check": """
>>> found = t.check("corpus/bunny/zipper_res4.ply")
>>> found.facets, found.sound, found.exit_status
(948, False, 1)
>>> found.defects["holes"].count
3""",
    "compare": """
>>> scan, nominal = "corpus/bunny/zipper_res3.ply", "corpus/bunny/zipper_res4.ply"
>>> found = t.compare(scan, nominal, tolerance=5, inside=90)
>>> found.comparisons[0].deviation.all.count, found.verdict
(1889, 'pass')""",
    "fit": """
>>> found = t.fit([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], shape="circle")
>>> round(found.parameters["radius"], 12)
1.0""",
}


def example(name: str) -> list[str]:
    """The section of the docstring with an example, where there is one."""
    lines = EXAMPLES.get(name, "").split("\n")[1:]
    head = ["", "Examples", "--------", ">>> import trueness as t"] if lines else []
    return [f"    {line}" if line else "" for line in [*head, *lines]]


TASKS_HEAD = '''from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, Never

from ._progress import Progress
from ._run import Path, Source, Text, limits, run, several, text

if TYPE_CHECKING:
    from ._document import TaskDocument
    from ._run import ProposedPlan
{imports}


'''


def tasks() -> str:
    stems = sorted(p.stem for p in (SCHEMAS / "requests").glob("*.json"))
    imports = [f"    from .documents.{s} import {title(s)}Document" for s in stems if s != "plan-init"]
    head = HEAD.format(about="The tasks: a function for each command of the program.") + TASKS_HEAD.format(imports="\n".join(imports))
    return head + "\n\n\n".join(task(s) for s in stems) + "\n"


def main() -> int:
    files = {PACKAGE / "documents" / name: text for name, text in documents().items()}
    files[PACKAGE / "tasks.py"] = tasks()
    stale = [path for path, text in files.items() if not path.is_file() or path.read_text() != text]
    if "--check" in sys.argv:
        for path in stale:
            print(f"{path.name} is not what the schemas say: run generate.py")
        return 1 if stale else 0
    for path in stale:
        path.write_text(files[path])
    return 0


if __name__ == "__main__":
    sys.exit(main())
