"""The document of `check`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from .._document import Record, TaskDocument
from ._common import (
    Bounds as Bounds,
    Defects as Defects,
    InputRecord as InputRecord,
)


class Tolerances(Record):
    """From where on something counts."""
    gap: float
    """Distance, mm, up to which two places may have been meant as one; of a CAD model, up to which edges may
    be off."""
    sliver_angle: float | None
    """Facets with a smaller angle, radians, are slivers. Absent for a CAD model."""
    island_share: float | None
    """Shells with a smaller share of the whole diagonal are islands. Absent for a CAD model."""


class CheckDocument(TaskDocument):
    """The whole document. Vertices are distinct positions (bit for bit, −0 being 0). Facets with a repeated
    vertex are degenerate and left out of edges and shells. Shells are facets connected through edges."""
    schema: str
    """`trueness/check/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """The file read."""
    facets: int
    """Facets in the file, those with a coordinate that is not finite among them."""
    vertices: int
    """Vertices that a facet uses."""
    edges: int
    """Edges."""
    shells: int
    """Parts connected through edges."""
    bounds: Bounds | None
    """Box of the vertices; `null` where there are none."""
    dimensions: list[float] | None
    """Sides of that box, mm."""
    area: float
    """Area of the surface, mm²."""
    volume: float | None
    """Volume enclosed, mm³; negative where the facets look inwards. `null` unless the mesh is closed and
    consistently oriented."""
    volume_reason: str | None
    """Why there is no volume."""
    volume_note: str | None
    """What the volume counts otherwise than one might think: where bodies cross or lie in each other, the
    places they have in common count as often as there are bodies."""
    centre_of_mass: list[float] | None
    """Center of mass of that volume."""
    centre_of_mass_reason: str | None
    """Why there is none."""
    euler_characteristic: int
    """Vertices − edges + facets."""
    genus: int | None
    """Handles of all shells together; `null` unless the mesh is a closed, consistently oriented surface."""
    genus_reason: str | None
    """Why there is no genus."""
    of_drawing: list[str] | None
    """Of a CAD model, the keys whose numbers are those of the facets that draw it, within
    `inputs[].cad.facets_within`. All other numbers are those of its faces and edges. Absent for a mesh."""
    sound: bool
    """No defect of severity `error`."""
    precondition: bool
    """The rule on which statistics of deviations rest: two facets at every edge, a closed fan at every
    vertex, no coincident facets, all looking outwards. Self-intersections and facets without area do not
    break it."""
    tolerances: Tolerances
    """What only a tolerance decides."""
    defects: dict[str, Defects]
    """The defects by kind."""

    _nested = {"inputs": "[InputRecord]", "bounds": "Bounds", "tolerances": "Tolerances", "defects": "{Defects}"}
