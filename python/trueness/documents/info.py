"""The document of `info`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from .._document import Record, TaskDocument
from ._common import (
    InputRecord as InputRecord,
)


class PartRecord(Record):
    """A part of a CAD model."""
    name: str
    """The name of its product; may be empty."""
    instances: int
    """How often it stands in the assembly."""
    faces: int
    """Faces of one instance."""
    solids: int
    """Solids of one instance."""
    wires: int
    """Curves and points that bound no face."""


class PlacementRecord(Record):
    """Where a part stands."""
    path: str
    """Names from the root of the assembly down to the part, joined by `/`."""
    part: int
    """Its part: the place in `parts`, from 0."""
    matrix: list[list[float]]
    """Rows of the matrix from coordinates of the part to those of the assembly, mm."""


class TolerancesRecord(Record):
    """Numbers of tolerances that a CAD model carries."""
    datums: int
    """Datums."""
    dimensions: int
    """Sizes, distances and angles."""
    geometric: dict[str, int]
    """Tolerances of form, attitude, place and run-out, by their kind."""


class RefusedRecord(Record):
    """A face that could not be read."""
    face: int
    """The number of its entity in the file."""
    keyword: str
    """Its keyword."""
    why: str
    """Why."""


class UnreadRecord(Record):
    """Entities that were not read and hold no face."""
    keyword: str
    """Their keyword."""
    count: int
    """How many."""
    why: str
    """Why."""


class InfoDocument(TaskDocument):
    """The whole document. Keys that do not belong to the content are absent."""
    schema: str
    """`trueness/info/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`: the unit of this document's numbers."""
    inputs: list[InputRecord]
    """The file read."""
    content: str
    """What it holds."""
    unit: str
    """The unit of its own numbers."""
    bounds: list[list[float]] | None
    """Least and greatest coordinates, mm; `null` where there is nothing. Those of a CAD model are exact."""
    points: int | None
    """Points of a cloud, or vertices of a mesh."""
    facets: int | None
    """Facets of a mesh."""
    area: float | None
    """Area of the facets or faces, mm²."""
    faces: dict[str, int] | None
    """Faces by the kind of their surface; kinds that do not occur are absent."""
    edges: int | None
    """Edges."""
    vertices: int | None
    """Vertices of edges."""
    shells: int | None
    """Shells."""
    solids: int | None
    """Solids."""
    volume: float | None
    """Volume of all solids, mm³; `null` without solids, or where one cannot be told."""
    volume_reason: str | None
    """Why there is no volume."""
    volumes: list[float | None]
    """Volume of each solid, mm³."""
    parts: list[PartRecord] | None
    """The parts, each once."""
    instances: int | None
    """Parts where they stand."""
    depth: int | None
    """Levels of the assembly; 0 for a single part."""
    placements: list[PlacementRecord] | None
    """Where each instance stands."""
    coloured_faces: int | None
    """Faces with a color of their own."""
    uncertainty: float | None
    """The uncertainty that the file states for its lengths, mm."""
    tolerances: TolerancesRecord | None
    """The tolerances that the model carries, if it does: `trueness plan init` makes a plan of them."""
    refused: list[RefusedRecord] | None
    """Faces that could not be read: what is not read of a nominal leaves its verdict undecided."""
    unread: list[UnreadRecord] | None
    """Other entities that were not read, by keyword and reason."""

    _nested = {"inputs": "[InputRecord]", "parts": "[PartRecord]", "placements": "[PlacementRecord]", "tolerances": "TolerancesRecord", "refused": "[RefusedRecord]", "unread": "[UnreadRecord]"}
