"""The document of `align`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from .._document import Record, TaskDocument
from ._common import (
    AlignNote as AlignNote,
    InputRecord as InputRecord,
)


class FreeMotion(Record):
    """A motion that the shape leaves free, in the frame of the reference."""
    kind: str
    """`slides` or `turns`."""
    direction: list[float]
    """Unit direction of the slide, or of the axis."""
    point: list[float] | None
    """A place on the axis; absent for a slide."""


class SlackMotion(Record):
    """A motion that rims alone hold."""
    kind: str
    """`slides` or `turns`."""
    direction: list[float]
    """Unit direction of the slide, or of the axis."""
    point: list[float] | None
    """A place on the axis; absent for a slide."""
    width: float
    """How far the measured may go at least, root mean square; within it any pose fits as well."""


class LockRecord(Record):
    """Components of a motion that stay zero."""
    axes: list[str]
    """Which: `tx`, `ty`, `tz` of the translation of `center`, `rx`, `ry`, `rz` of the rotation vector, in the
    frame of the reference."""
    center: list[float]
    """What the motion turns about."""


class BestFitRecord(Record):
    """What a best fit tells."""
    median: float
    """Weighted median distance of all points that have a place on the reference."""
    used: int
    """Points that count."""
    left_out: int
    """Points that do not: outliers, beside a boundary edge, on the other side of a wall."""
    share: float
    """Share of the measured surface that counts, 0 to 1."""
    center: list[float]
    """Mean of the measured points in the frame of the reference: what the rotation vector of the covariance
    is about."""
    covariance: list[list[float]]
    """Covariance of the rotation vector (radians) and the translation (mm); zero along free motions."""
    std_uncertainty: list[float]
    """Standard uncertainties of the same six."""
    condition: float | None
    """Greatest over least eigenvalue of the normal equations."""
    condition_reason: str | None
    """Why there is none."""
    alternatives: list[AlternativeRecord]
    """Other poses that fit nearly as well, best first."""

    _nested = {"alternatives": "[AlternativeRecord]"}


class AlternativeRecord(Record):
    """Another pose that fits nearly as well."""
    transform: list[list[float]]
    """As `transform` of the document."""
    angle: float
    """Angle of the rotation between this pose and the result, radians."""
    ratio: float
    """Its root mean square distance, capped at twenty standard deviations, over that of the result."""


class ChebyshevRecord(Record):
    """The pose with the least greatest distance."""
    greatest: float
    """The greatest distance of a point that counts from the surface."""
    at: list[float]
    """Where that point lies after the motion."""
    used: int
    """Points that count."""
    left_out: int
    """Points that do not: much farther off than the others and than a hundredth of the size of the reference,
    beside a boundary edge, on the other side of a wall, of no facet."""
    left_out_farthest: float | None
    """Distance of the farthest of those; absent where all count."""


class ZonesRecord(Record):
    """The pose with the least greatest excess over the tolerances."""
    excess: float
    """How far the worst point of all is beyond its tolerance; negative where all are within, by so much at
    least."""
    at: list[float]
    """Where that point lies after the motion."""
    deviation: float
    """Its deviation."""
    tolerance: list[float]
    """Its tolerance: least and greatest deviation."""
    beyond: int
    """Points that are beyond their tolerance."""
    least: float
    """The greatest excess of the points that count in the search for the pose: what is least there. Where all
    count it is `excess`."""
    used: int
    """Points that have a tolerance. All of them are judged."""
    left_out: int
    """Points that do not count in the search, as those of `chebyshev`, if they are off by more than ten times
    the widest tolerance, too. They are judged all the same."""
    left_out_farthest: float | None
    """Distance of the farthest of those; absent where all count."""
    without_zone: int
    """Points at places without a tolerance."""


class PairRecord(Record):
    """A row of the table of places."""
    row: int
    """Number of the row, from 0."""
    residual: float
    """What is left: the distance of a pair, the signed distance along the direction of a row."""
    amplification: float | None
    """How many millimeters the corner of the reference's box that moves farthest moves per millimeter of
    error in this row; absent of pairs."""


class AlignDocument(TaskDocument):
    """The whole document. Lengths in millimeters, angles in radians."""
    schema: str
    """`trueness/align/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """The files read: the measured first."""
    method: str
    """`best-fit`, `chebyshev`, `zones`, `pairs`, `3-2-1` or `rps`."""
    transform: list[list[float]]
    """4×4, row by row, acting on columns (x, y, z, 1): takes measured coordinates to those of the reference.
    With a `scale` its rotation is multiplied by it."""
    scale: float | None
    """How many times as large the measured was made, where that was asked for."""
    scale_std_uncertainty: float | None
    """Its standard uncertainty."""
    angle: float
    """Angle of its rotation, radians."""
    rms: float
    """Root of the weighted mean square distance of what counts."""
    mean_abs: float
    """Weighted mean distance of what counts."""
    iterations: int
    """Steps of the last iteration."""
    converged: bool
    """Whether the iteration settled: the last step was less than a thousandth of its own uncertainty."""
    degrees_of_freedom: int
    """Of the six degrees of freedom, those that the parts determine."""
    free: list[FreeMotion]
    """The motions that stay free."""
    slack: list[SlackMotion] | None
    """The motions that rims alone hold, with the way that they leave."""
    lock: LockRecord | None
    """The components of the motion that were to stay zero."""
    best_fit: BestFitRecord | None
    """What a best fit tells beyond that, also the one that `chebyshev` or `zones` began with; absent for the
    other methods."""
    chebyshev: ChebyshevRecord | None
    """Of `chebyshev`: the greatest distance, which is the least that there is."""
    zones: ZonesRecord | None
    """Of `zones`: the greatest excess over a tolerance, which is the least that there is."""
    pairs: list[PairRecord] | None
    """Of `pairs`, `3-2-1` and `rps`: what is left in each row of the table, in its order."""
    warnings: list[AlignNote]
    """What is to be said about the result."""
    seed: int
    """Seed of everything random."""

    _nested = {"inputs": "[InputRecord]", "free": "[FreeMotion]", "slack": "[SlackMotion]", "lock": "LockRecord", "best_fit": "BestFitRecord", "chebyshev": "ChebyshevRecord", "zones": "ZonesRecord", "pairs": "[PairRecord]", "warnings": "[AlignNote]"}
