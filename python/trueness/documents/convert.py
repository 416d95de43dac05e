"""The document of `convert`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from .._document import TaskDocument
from ._common import (
    InputRecord as InputRecord,
)


class ConvertDocument(TaskDocument):
    """The whole document."""
    schema: str
    """`trueness/convert/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`: the unit of the file written."""
    inputs: list[InputRecord]
    """The file read."""
    output: str
    """The file written."""
    written: str
    """What was written."""
    points: int
    """Points, or vertices of the mesh."""
    facets: int | None
    """Facets of the mesh."""
    farthest_moved: float | None
    """How far the format moved a coordinate at most, mm; 0 where it kept all digits, `null` where that is not
    known."""
    lost: list[str]
    """What the file written does not hold, a sentence each."""

    _nested = {"inputs": "[InputRecord]"}
