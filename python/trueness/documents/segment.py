"""The document of `segment`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from typing import Literal

from .._document import Record, TaskDocument
from ._common import (
    Bounds as Bounds,
    InputRecord as InputRecord,
    SharedNoise as SharedNoise,
)


class RegionRecord(Record):
    """One element and what belongs to it."""
    number: int
    """Its number, from 0; the label of its facets or points."""
    shape: str
    """`plane`, `cylinder`, `cone`, `sphere` or `torus`."""
    parameters: dict[str, float | list[float]]
    """The element by least squares, by names, as in a fit."""
    uncertainty: dict[str, float | list[float]] | None
    """Standard uncertainty of each parameter; of places and directions, coordinate by coordinate."""
    uncertainty_reason: str | None
    """Why there is none."""
    pieces: int
    """Number of facets, or of points of a cloud."""
    area: float | None
    """Area of the facets, mm²; `null` for a cloud."""
    area_reason: str | None
    """Why there is none."""
    share: float
    """Share of the area of all facets, or of all points of a cloud."""
    points: int
    """Points that the element was fitted to: those inside the region, not on its edges, where there are
    enough."""
    rms: float
    """Root mean square of their distances."""
    max: float
    """Greatest magnitude of the distances of all points of the region's facets, or of its points: within the
    tolerance."""
    form_error: float
    """Of the points that it was fitted to, greatest less least signed distance."""
    bounds: Bounds
    """Box around the region."""
    members: list[int] | None
    """The numbers of its facets or points in the file, from 0, where they were asked for."""

    _nested = {"bounds": "Bounds"}


class SegmentDocument(TaskDocument):
    """The whole document. Lengths in millimeters, angles in radians."""
    schema: str
    """`trueness/segment/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """The file read."""
    pieces: Literal["facets", "points"]
    """What was put into regions: `facets` or `points`."""
    count: int
    """How many there are."""
    unassigned: int
    """How many belong to no region."""
    noise: float
    """Standard deviation of the noise found in the data."""
    shared_noise: SharedNoise | None
    """The noise of the points about their elements, and how far neighbors share it: the uncertainties take it
    into account."""
    shared_noise_reason: str | None
    """Why none is told: the uncertainties are those of independent points."""
    tolerance: float
    """Distance up to which points belong to an element: no point of a region lies farther off."""
    tolerance_given: bool
    """Whether that distance was given, not found."""
    crease: float
    """Angle between neighboring pieces from which on there is an edge between them."""
    min_share: float
    """Least share of the area, or of the points, that a region must have."""
    seed: int
    """Seed of everything random."""
    regions: list[RegionRecord]
    """The regions, largest first."""

    _nested = {"inputs": "[InputRecord]", "shared_noise": "SharedNoise", "regions": "[RegionRecord]"}
