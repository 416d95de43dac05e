"""The document of `repair`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from .._document import Record, TaskDocument
from ._common import (
    InputRecord as InputRecord,
)


class OutputRecord(Record):
    """The file written."""
    path: str
    """As given on the command line."""
    rounded_vertices: int
    """Vertices that the format could not hold exactly, or that were rounded because shells could not be
    united otherwise."""
    rounding: float
    """Greatest change of a coordinate by that, mm."""
    sound: bool | None
    """The file written, read again, is sound. `null` where it could not be read again."""
    sound_reason: str | None
    """Why it was not read again."""
    defects: dict[str, int]
    """Defects found in the file when it was read again, by kind; kinds without a finding are left out."""
    at_least: list[str] | None
    """Kinds of which there are more than `defects` says: they were not counted to the end."""


class State(Record):
    """A mesh in numbers."""
    facets: int
    """Facets."""
    vertices: int
    """Vertices that a facet uses."""
    shells: int
    """Parts connected through edges."""
    closed: bool
    """No edge has one facet only."""
    sound: bool
    """No defect of severity `error`."""
    area: float
    """Area of the surface, mm²."""
    volume: float | None
    """Volume enclosed, mm³: before, that of the places with winding number 1 or more, after neighbors were
    turned to run the same way round; after, the signed volume. `null` unless the mesh is closed and
    consistently oriented."""
    volume_reason: str | None
    """Why there is no volume."""
    defects: dict[str, int]
    """Defects by kind; kinds without a finding are left out."""
    at_least: list[str] | None
    """Kinds of which there are more than `defects` says: they were not counted to the end."""


class VertexCounts(Record):
    """Vertices that stayed, came and went."""
    kept: int
    """At their old place, bit for bit; where vertices were rounded to single precision first, at the rounded
    one."""
    moved: int
    """Rounded although the format could have held them, because shells could not be united otherwise. No
    other vertex moves."""
    added: int
    """New."""
    removed: int
    """No longer used by a facet."""


class FacetCounts(Record):
    """Facets that stayed, came and went."""
    kept: int
    """With the same three vertices as before, in whichever direction."""
    added: int
    """New."""
    removed: int
    """Gone."""


class Effect(Record):
    """What became of the part. What is changed beyond a limit is no mended part but another one."""
    changed: bool
    """Volume or surface went beyond a limit."""
    bodies_before: int
    """Closed shells that look outwards, before."""
    bodies_after: int
    """And after."""
    volume_error: float | None
    """What the volume before may be off by, mm³; `null` where there is none."""
    volume_inverted: float | None
    """Volume of the places with winding number −1 or less before, mm³: bodies that looked inwards."""
    volume_change: float | None
    """Volume after less volume before, mm³, bodies that looked inwards being counted if that makes the change
    smaller; `null` where either is not known, and where the mesh is still not sound."""
    surface: float | None
    """Largest distance that counts, mm: from the surface that bounded the volume to the new one, and from the
    new surface to the old one. Where no volume was enclosed, of what was torn out, and of more than a trifle
    of fins and loose sheets, to the new surface; `null` where nothing was."""
    limit: float
    """The limits as a share of the diagonal and of the volume."""
    surface_limit: float
    """That of the surface, mm."""
    volume_limit: float | None
    """That of the volume, mm³; `null` where there is no volume."""


class Deviation(Record):
    """How far the surface went."""
    removed: Distances
    """From the old surface to the new one: what is missing. Facets of which a part lay inside a body count in
    the greatest, not in the mean."""
    added: Distances
    """From the new surface to the old one: what was added."""

    _nested = {"removed": "Distances", "added": "Distances"}


class Distances(Record):
    """Distances of one surface from another, mm."""
    max: float
    """The greatest."""
    mean: float
    """Mean over the area."""


class Change(Record):
    """Something that was changed."""
    step: str
    """The step that did it."""
    what: str
    """What was done."""
    position: list[float]
    """Where, mm."""
    facets: int
    """Facets concerned."""
    size: float
    """How big: mm for vertices and edges, mm² for facets, mm³ for shells."""


class RepairDocument(TaskDocument):
    """The whole document."""
    schema: str
    """`trueness/repair/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """The file read."""
    output: OutputRecord
    """The file written."""
    sound: bool
    """The mesh is sound now, still is when the file written is read again, the part was not changed, and all
    faces of a CAD model were read."""
    before: State
    """Size and defects before."""
    after: State
    """Size and defects after, in memory."""
    vertices: VertexCounts
    """Vertices that stayed, came and went."""
    facets: FacetCounts
    """Facets that stayed, came and went."""
    effect: Effect
    """What became of the part."""
    deviation: Deviation | None
    """How far the surface went; `null` where nothing can be measured."""
    deviation_reason: str | None
    """Why nothing was measured."""
    steps: list[str]
    """Names of the steps that were allowed, in their order."""
    taken_back: list[str]
    """Steps that were not done, because with them some defect would have become more frequent, or surface
    would have been removed and the mesh still not been sound."""
    not_united: str | None
    """Why closed shells that meet were not united, where they were not."""
    hole_limit: float | None
    """Holes were filled up to this share of the area of their shell; `null`: all."""
    rounds: int
    """How often the steps were gone through."""
    change_count: int
    """Number of changes."""
    changes: list[Change]
    """The first changes, in the order in which they were made."""
    truncated: bool
    """Not all changes are listed."""

    _nested = {"inputs": "[InputRecord]", "output": "OutputRecord", "before": "State", "after": "State", "vertices": "VertexCounts", "facets": "FacetCounts", "effect": "Effect", "deviation": "Deviation", "changes": "[Change]"}
