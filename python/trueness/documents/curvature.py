"""The document of `curvature`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from typing import Literal

from .._document import Record, TaskDocument
from ._common import (
    Histogram as Histogram,
    InputRecord as InputRecord,
    Range as Range,
    Scale as Scale,
    SharedNoise as SharedNoise,
    Statistics as Statistics,
)


class Neighborhood(Record):
    """What was taken into a neighborhood."""
    kind: Literal["count", "radius"]
    neighbors: int | None
    """How many."""
    radius: float | None
    """That distance, millimeters."""


class Quantity(Record):
    """One of the curvatures over all places."""
    statistics: Statistics
    """Over the places, each counting once."""
    histogram: Histogram | None
    """Counts of the values."""
    maximum: CurvaturePlace
    """Where it is greatest."""
    minimum: CurvaturePlace
    """Where it is least."""
    scale: Scale
    """Its colors."""

    _nested = {"statistics": "Statistics", "histogram": "Histogram", "maximum": "CurvaturePlace", "minimum": "CurvaturePlace", "scale": "Scale"}


class CurvaturePlace(Record):
    """A vertex or point with its curvatures."""
    index: int
    """Its number in the file, from 0."""
    position: list[float]
    """Where it lies."""
    normal: list[float]
    """Unit normal."""
    k1: float
    """Greater principal curvature, 1/mm."""
    k2: float
    """Lesser principal curvature."""
    k1_direction: list[float]
    """Unit tangent in which the surface bends by the greater one."""
    k2_direction: list[float]
    """And by the lesser one."""
    mean: float
    """Mean curvature."""
    gaussian: float
    """Gaussian curvature, 1/mm²."""
    uncertainty: float
    """Standard uncertainty of the mean curvature."""
    residual: float
    """Standard deviation of the neighbors from the polynomial, millimeters."""
    condition: float
    """Condition of the least-squares system."""
    neighbors: int
    """Neighbors."""


class CurvatureDocument(TaskDocument):
    """The whole document. Lengths in millimeters, curvatures in their reciprocal."""
    schema: str
    """`trueness/curvature/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """The file read."""
    places: str
    """What has curvatures: `vertices` of a mesh or `points` of a cloud."""
    degree: int
    """Degree of the polynomials fitted to the neighborhoods."""
    neighborhood: Neighborhood
    """What was taken into a neighborhood."""
    boundary: bool
    """Whether places on a boundary have values."""
    sign: str
    """Always `positive towards the normal`: a curvature is positive where the surface bends towards its
    normal, negative on a convex body whose normals point outward."""
    normals: str
    """Where the side of the normals comes from: `facets`, or `neighbors` in a cloud."""
    parts: int
    """Of a cloud: parts that hang together, each with its normals to one side; 0 of a mesh."""
    total: int
    """All vertices or points."""
    count: int
    """Those that have curvatures."""
    without: dict[str, int]
    """Those that have none, by reason: `not_finite`, `unused`, `not_a_surface`, `boundary`, `few_neighbors`,
    `undetermined`, `folded`."""
    mean: Quantity
    """Mean curvature, the mean of the principal curvatures, 1/mm."""
    gaussian: Quantity
    """Gaussian curvature, their product, 1/mm²."""
    k1: Quantity
    """Greater principal curvature, 1/mm."""
    k2: Quantity
    """Lesser principal curvature, 1/mm."""
    shared_noise: SharedNoise | None
    """The noise of the vertices or points, and how far neighbors share it: the uncertainties take it into
    account."""
    shared_noise_reason: str | None
    """Why none is told: the uncertainties are those of independent points."""
    uncertainty: Range
    """Standard uncertainty of the mean curvature, 1/mm: as the residuals tell it, or as `shared_noise` does
    where that is more."""
    residual: Range
    """Standard deviation of the neighbors from the polynomial."""
    condition: Range
    """Condition of the least-squares systems."""
    neighbors: Range
    """Neighbors of a place."""
    reach: Range
    """Distance of the farthest neighbor."""

    _nested = {"inputs": "[InputRecord]", "neighborhood": "Neighborhood", "mean": "Quantity", "gaussian": "Quantity", "k1": "Quantity", "k2": "Quantity", "shared_noise": "SharedNoise", "uncertainty": "Range", "residual": "Range", "condition": "Range", "neighbors": "Range", "reach": "Range"}
