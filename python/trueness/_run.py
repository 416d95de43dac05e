"""Requests: what a task is asked, from Python's values to JSON and bytes under names."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from . import _trueness
from ._document import Json, TaskDocument
from ._errors import UsageError
from ._geometry import Cloud, Mesh, Model, points_of
from ._progress import Progress, callback

Path: TypeAlias = "str | os.PathLike[str]"
#: A file by its path, or an object in memory; of an array the rows are points.
Source: TypeAlias = "Path | Mesh | Cloud | Model | NDArray[np.float64] | NDArray[np.float32] | Sequence[Sequence[float]] | ProposedPlan"
#: A text of the command line, or the number or numbers that it stands for: `0.1`, `(-0.1, 0.2)`, `(0, 0, 1)`.
Text: TypeAlias = "str | float | Sequence[float] | Sequence[str]"

Document = TypeVar("Document", bound=TaskDocument)


class ProposedPlan(TaskDocument):
    """A plan that was proposed: ``text`` is TOML, to be edited and given to `trueness.inspect`."""

    text: str

    def save(self, path: str | os.PathLike[str], *, language: object = None) -> None:
        """Writes the text of the plan."""
        from ._document import whole_file

        whole_file(path, self.text.encode())

    def __str__(self) -> str:
        return self.text


def run(
    task: str,
    document: type[Document],
    given: Mapping[str, object],
    progress: Progress,
    unknown: Mapping[str, object],
) -> Document:
    """Runs a task with these arguments."""
    for name in unknown:
        from difflib import get_close_matches

        nearest = get_close_matches(name, given, 1)
        hint = f"; did you mean {nearest[0]!r}?" if nearest else f"; it has {', '.join(given)}"
        raise TypeError(f"{task}() has no argument {name!r}{hint}")
    memory: dict[str, bytes] = {}
    request = {name: _value(name, value, memory) for name, value in given.items() if value is not None}
    answer = _trueness.run(task, json.dumps(request), memory, callback(progress))
    return document._of(answer)


def text(value: Text | None) -> str | None:
    """The text of the command line that a number or several stand for."""
    if value is None or isinstance(value, str):
        return value
    return ",".join(map(str, value)) if isinstance(value, Sequence) else repr(float(value))


def limits(tolerance: Text | None) -> str | None:
    """The text of a tolerance: two numbers carry their signs."""
    if tolerance is None or isinstance(tolerance, str) or not isinstance(tolerance, Sequence):
        return text(tolerance)
    return ",".join(f"{float(limit):+}" for limit in tolerance)


def several(values: object) -> list[object]:
    """Sources as a list; one by itself is a list of one."""
    if isinstance(values, (list, tuple)) and not _holds_rows(cast("object", values)):
        return list(cast("Sequence[object]", values))
    return [values]


def _value(name: str, value: object, memory: dict[str, bytes]) -> Json:
    """A value of a request; what is in memory goes to `memory` under a name that stands for it."""
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, os.PathLike):
        return os.fsdecode(cast("os.PathLike[str]", value))
    if isinstance(value, np.generic):
        return _value(name, cast("object", value.item()), memory)
    content = _bytes(name, value)
    if content is not None:
        memory[f"<{name}>"] = content
        return f"<{name}>"
    if isinstance(value, (int, float)):
        return value
    if isinstance(value, np.ndarray):
        return _value(name, cast("object", value.tolist()), memory)
    if isinstance(value, Sequence):
        return _list(name, cast("Sequence[object]", value), memory)
    raise UsageError(f"{name}: a {type(value).__name__} is nothing that it takes")


#: Arguments that are files, where rows of numbers are points.
FILES = {"measured", "reference", "references", "mesh", "input", "points", "file", "nominal"}


def _bytes(name: str, value: object) -> bytes | None:
    """The bytes of what stands for a file; None for other values."""
    if isinstance(value, (Mesh, Cloud, Model)):
        return value._bytes()
    if isinstance(value, ProposedPlan):
        return value.text.encode()
    if isinstance(value, TaskDocument):
        return value.json.encode()
    if name not in FILES:
        return None
    if isinstance(value, np.ndarray) or _holds_rows(value):
        return Cloud(points_of(np.asarray(value)))._bytes()
    return None


def _holds_rows(value: object) -> bool:
    """Whether it is a list of rows of numbers."""
    if not isinstance(value, Sequence) or not value:
        return False
    first = cast("Sequence[object]", value)[0]
    if not isinstance(first, Sequence) or isinstance(first, str) or not first:
        return False
    return isinstance(cast("Sequence[object]", first)[0], (int, float))


def _list(name: str, values: Sequence[object], memory: dict[str, bytes]) -> Json:
    one = name.removesuffix("s")
    shown = [one] if len(values) == 1 else [f"{one} {i + 1}" for i in range(len(values))]
    return [_item(own, name, value, memory) for own, value in zip(shown, values, strict=True)]


def _item(shown: str, name: str, value: object, memory: dict[str, bytes]) -> Json:
    content = _bytes(name, value)
    if content is None:
        return _value(name, value, memory)
    memory[f"<{shown}>"] = content
    return f"<{shown}>"
