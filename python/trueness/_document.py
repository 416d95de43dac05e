"""Result documents: the JSON of the program with attributes."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar, Literal, Self, TypeAlias

from ._errors import UsageError

if TYPE_CHECKING:
    from . import _trueness

#: What JSON can say.
Json: TypeAlias = "None | bool | int | float | str | list[Json] | dict[str, Json]"
Verdict: TypeAlias = Literal["pass", "fail", "undecided", "not_measured"]
Language: TypeAlias = Literal["en", "de", "ru", "zh"]

#: Size of a page that is aimed at, bytes.
PAGE_BYTES = 10_000_000


class Record:
    """An object of a document: its keys are attributes, and items as well.

    A key that the document leaves out is None. ``to_dict()`` gives the plain JSON.
    """

    #: How values are wrapped: the name of a class, or one in brackets (list) or braces (values of a dict).
    _nested: ClassVar[dict[str, str]] = {}
    _data: dict[str, Json]

    def __init__(self, data: dict[str, Json]) -> None:
        self._data = data

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> object:
            if name.startswith("__") or name == "_data":
                raise AttributeError(name)
            key = name[:-1] if name.endswith("_") else name
            if key in self._data:
                return _wrapped(self._data[key], type(self)._nested.get(key), type(self))
            known = _keys(type(self))
            if name in known:
                return None
            from difflib import get_close_matches

            nearest = get_close_matches(name, [*known, *self._data], 1)
            hint = f"; did you mean {nearest[0]!r}?" if nearest else ""
            raise AttributeError(f"{type(self).__name__} has no {name!r}{hint}")

    def __getitem__(self, key: str) -> Json:
        return self._data[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __contains__(self, key: object) -> bool:
        return key in self._data

    def __len__(self) -> int:
        return len(self._data)

    def keys(self) -> list[str]:
        """The keys of the JSON object."""
        return list(self._data)

    def to_dict(self) -> dict[str, Json]:
        """The plain JSON object."""
        return self._data

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Record) and self._data == other._data

    __hash__ = None  # type: ignore[assignment]

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *(key for key in self._data if key.isidentifier())})

    def __repr__(self) -> str:
        text = ", ".join(f"{key}={_short(value)}" for key, value in list(self._data.items())[:8])
        return f"{type(self).__name__}({text}{', …' if len(self._data) > 8 else ''})"


def _short(value: Json) -> str:
    if isinstance(value, list):
        return f"[{len(value)} items]"
    if isinstance(value, dict):
        return "{…}"
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "…'"


def _keys(cls: type) -> set[str]:
    return {key for base in cls.__mro__ for key in getattr(base, "__annotations__", {}) if not key.startswith("_")}


def _wrapped(value: Json, nested: str | None, owner: type) -> object:
    if nested is None or value is None:
        return value
    if nested.startswith("[") and isinstance(value, list):
        return [_wrapped(item, nested[1:-1], owner) for item in value]
    if nested.startswith("{") and isinstance(value, dict):
        return {key: _wrapped(item, nested[1:-1], owner) for key, item in value.items()}
    cls: object = vars(sys.modules[owner.__module__]).get(nested)
    return cls(value) if isinstance(cls, type) and isinstance(value, dict) else value


class TaskDocument(Record):
    """The document of a task: the very JSON of the program, its exit status and its report."""

    _answer: _trueness.Answer | None
    _text: str
    #: The exit status of the program: 0 conforming, 1 not, 2 and 3 for what has no answer.
    exit_status: int

    def __init__(self, text: str, exit_status: int, answer: _trueness.Answer | None = None) -> None:
        data: dict[str, Json] = json.loads(text)
        super().__init__(data)
        self._text, self.exit_status, self._answer = text, exit_status, answer

    @classmethod
    def _of(cls, answer: _trueness.Answer) -> Self:
        return cls(answer.json, answer.status, answer)

    @property
    def conforms(self) -> bool:
        """Whether the exit status is 0."""
        return self.exit_status == 0

    @property
    def verdict(self) -> Verdict | None:
        """The verdict; None where the task gives none, or was asked for none."""
        own = self._data.get("verdict")
        for verdict in ("pass", "fail", "undecided", "not_measured"):
            if own == verdict:
                return verdict
        return None

    @property
    def json(self) -> str:
        """The text of the document, byte for byte as ``trueness … --json`` writes it."""
        return self._text

    def report(
        self,
        *,
        language: Language = "en",
        budget: int = PAGE_BYTES,
        title: str | None = None,
        part: str | None = None,
        serial: str | None = None,
        operator: str | None = None,
    ) -> bytes:
        """The report, one self-contained HTML page of about `budget` bytes at most."""
        if self._answer is None:
            raise UsageError("a document that was copied or unpickled has no report; run the task again")
        head = {"title": title, "part": part, "serial": serial, "operator": operator}
        return self._answer.report(language, budget, {name: text for name, text in head.items() if text is not None})

    def save(self, path: str | os.PathLike[str], *, language: Language = "en") -> None:
        """Writes the document (``.json``) or the report (``.html``). The file appears whole or not at all."""
        ending = os.path.splitext(path)[1].lower()
        if ending == ".json":
            whole_file(path, self._text.encode())
        elif ending in (".html", ".htm"):
            whole_file(path, self.report(language=language))
        else:
            raise UsageError(f"{os.fspath(path)}: the ending must be .json or .html; other files are arguments of the task, as out=")

    def __reduce__(self) -> tuple[type[Self], tuple[str, int]]:
        return type(self), (self._text, self.exit_status)

    def _repr_html_(self) -> str:
        plain = {key: value for key, value in self._data.items() if not isinstance(value, (list, dict)) and value is not None}
        rows = "".join(row(key, f"{value:.6g}" if isinstance(value, float) else str(value)) for key, value in plain.items())
        size = f"document of {len(self._text.encode()) / 1000:.0f} kB; <code>save(&quot;report.html&quot;)</code> writes its page"
        return f"<table>{rows}</table><small>{size}</small>"


def row(name: str, value: str) -> str:
    """A row of a table of HTML."""
    import html

    return f"<tr><th style='text-align:left'>{html.escape(name)}</th><td>{html.escape(value)}</td></tr>"


def whole_file(path: str | os.PathLike[str], content: bytes) -> None:
    """Writes a file that appears whole or not at all."""
    import tempfile

    target: str = os.fspath(path)
    folder, own = os.path.split(target)
    number, name = tempfile.mkstemp(prefix=f".{own}.", dir=folder or ".")
    try:
        with os.fdopen(number, "wb") as file:
            file.write(content)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(name, 0o666 & ~mask)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise
