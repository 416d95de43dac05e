"""The document of `compare`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from typing import Literal

from .._document import Record, TaskDocument
from ._common import (
    AlignNote as AlignNote,
    AlongRecord as AlongRecord,
    BetweenRecord as BetweenRecord,
    Bounds as Bounds,
    BySide as BySide,
    CoverageRecord as CoverageRecord,
    ExtremeRecord as ExtremeRecord,
    FaceDeviation as FaceDeviation,
    Histogram as Histogram,
    InputRecord as InputRecord,
    OutliersRecord as OutliersRecord,
    PaperVsExact as PaperVsExact,
    Research as Research,
    Reverse as Reverse,
    Scale as Scale,
    SignRecord as SignRecord,
    Soundness as Soundness,
    Statistics as Statistics,
    SurfacesRecord as SurfacesRecord,
    ToleranceShares as ToleranceShares,
    VerdictReason as VerdictReason,
    Warning as Warning,
    Worst as Worst,
)


class Measured(Record):
    """What was measured."""
    kind: str
    """`points`, `vertices` (of a mesh) or `samples` (of a mesh's surface)."""
    count: int
    """Their number."""
    bounds: Bounds | None
    """Their box."""

    _nested = {"bounds": "Bounds"}


class AlignedTo(Record):
    """The alignment that a comparison began with."""
    reference: str
    """The reference that the measured was brought to."""
    transform: list[list[float]]
    """4×4, row by row: takes the coordinates of the measured file to those compared."""
    rms: float
    """Root of the weighted mean square distance of what counts."""
    mean_abs: float
    """Weighted mean distance of what counts."""
    iterations: int
    """Steps of the last iteration."""
    converged: bool
    """Whether the iteration settled."""
    left_out: int
    """Points without a weight in the fit; they are compared all the same."""
    warnings: list[AlignNote]
    """What is to be said about the result."""

    _nested = {"warnings": "[AlignNote]"}


class Comparison(Record):
    """Deviations from one reference."""
    reference: str
    """Path of the reference."""
    rank: int
    """1 for the reference with the least root mean square; equal for equal values."""
    warnings: list[Warning] | None
    """What makes it unlikely that measured and reference belong together as they lie."""
    surfaces: SurfacesRecord | None
    """Of a reference that is not a mesh but B-spline surfaces; absent for meshes."""
    along: AlongRecord | None
    """Along what lines the deviations are; absent where they are to the nearest place."""
    sign: SignRecord
    """How the sign was found here."""
    soundness: Soundness
    """Whether the statistics rest on a sound mesh; of B-spline surfaces, which have no facets that could be
    wrong, `sound`."""
    deviation: BySide
    """Statistics of the deviations: all, those above zero, those below zero."""
    excluded: dict[str, int]
    """Points left out, by reason: `max_distance`, `free_edge`; with `--facing` also `facing`, with
    `--outliers` `outlier`, with `--along` `no_crossing` (the line meets nothing) and, for normals,
    `no_direction`."""
    outliers: OutliersRecord | None
    """The rule for outliers and what it gave here; absent without one."""
    coverage: CoverageRecord | None
    """What part of the reference no measured point covers, nor a large facet of a measured mesh; with a
    tolerance, with `--coverage` and with a report."""
    between_vertices: BetweenRecord | None
    """Places between the vertices of the measured mesh that are out of tolerance; absent where there are
    none."""
    tolerance: ToleranceShares | None
    """Shares against the tolerance; absent without one."""
    regions: list[RegionRecord] | None
    """Parts of the reference with tolerances of their own; `tolerance` is then of the points of no region."""
    verdict: Literal["fail", "not_measured", "pass", "undecided"] | None
    """Pass when the share inside reaches what was asked, in every region too, and enough of the reference is
    covered. Undecided where the values cannot be relied on, and where nothing fails but not enough was
    measured. Without a tolerance it is absent, unless the alignment cannot be relied on."""
    verdict_reasons: list[VerdictReason] | None
    """Why it is not a pass."""
    others_verdict: Literal["fail", "not_measured", "pass", "undecided"] | None
    """The verdict on all points of no region; absent where there are no regions, or no tolerance for these
    points."""
    histogram: Histogram | None
    """Counts of the deviations; absent when there are none."""
    lowest: ExtremeRecord | None
    """The lowest deviation of all that count, and its point; absent where none counts."""
    highest: ExtremeRecord | None
    """The highest one."""
    worst: list[Worst]
    """The worst places, far from one another, on both sides: the farthest beyond the tolerance first, without
    a tolerance the greatest deviation."""
    faces: list[FaceDeviation] | None
    """Deviations of each face of a CAD model that has points, in the order of the model; absent for other
    references."""
    reverse: Reverse | None
    """The same question asked from the reference's vertices to the measured mesh; only with `--both`."""
    paper_vs_exact: PaperVsExact | None
    """How the paper's method differs from the exact distance; only with `--method paper`."""
    research: Research | None
    """Intervals, tests and models; only with `--research`."""

    _nested = {"warnings": "[Warning]", "surfaces": "SurfacesRecord", "along": "AlongRecord", "sign": "SignRecord", "soundness": "Soundness", "deviation": "BySide", "outliers": "OutliersRecord", "coverage": "CoverageRecord", "between_vertices": "BetweenRecord", "tolerance": "ToleranceShares", "regions": "[RegionRecord]", "verdict_reasons": "[VerdictReason]", "histogram": "Histogram", "lowest": "ExtremeRecord", "highest": "ExtremeRecord", "worst": "[Worst]", "faces": "[FaceDeviation]", "reverse": "Reverse", "paper_vs_exact": "PaperVsExact", "research": "Research"}


class RegionRecord(Record):
    """A part of the reference with a tolerance of its own. A point belongs to the first region that has its
    place on the reference."""
    id: str
    """Its name."""
    deviation: Statistics
    """Statistics of its points' deviations."""
    tolerance: ToleranceShares
    """Shares of its points against its tolerance."""
    verdict: Literal["fail", "not_measured", "pass", "undecided"]
    """Pass when the share inside reaches what was asked; `not_measured` without points; `undecided` where the
    values cannot be relied on."""

    _nested = {"deviation": "Statistics", "tolerance": "ToleranceShares"}


class Paired(Record):
    """The difference `|d| to the first − |d| to the second`, point by point."""
    better: int
    """Number of the better reference (0-based, in the order given)."""
    other: int
    """Number of the other."""
    count: int
    """Points compared."""
    points_per_independent: float | None
    """Points that tell as much as an independent one, as the differences of neighbors go together."""
    points_per_independent_reason: str | None
    """Why that is not told: intervals and p values are those of independent points."""
    mean_difference: float | None
    """Mean difference; negative where the better one is nearer."""
    interval: list[float] | None
    """Its 95 % confidence interval."""
    std_dev: float | None
    """Standard deviation of the differences."""
    p_value: float | None
    """Two-sided p value of the mean difference being zero (Student)."""
    wilcoxon_p_value: float | None
    """Two-sided p value of Wilcoxon's signed-rank test."""
    reason: str | None
    """Why numbers are missing."""


class Sampling(Record):
    """What a report shows of all points."""
    shown: int
    """Points drawn."""
    total: int
    """Points measured; every number is from all of them."""


class CompareDocument(TaskDocument):
    """The whole document."""
    schema: str
    """`trueness/compare/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """Files read: the measured one, then the references in the order given."""
    measured: Measured
    """What was compared."""
    alignment: AlignedTo | None
    """How the measured was brought to the first reference; absent where it was compared as it lies."""
    method: str
    """How distances were computed: `exact` or `paper`."""
    sign: SignRecord
    """The sign method; with several references, what holds for all of them (see each comparison for its
    own)."""
    max_distance: float | None
    """Points farther than this are excluded, millimeters."""
    skip_boundary: bool
    """Points whose closest place lies on a boundary edge are excluded."""
    facing: float | None
    """Only points count whose normals are within this angle of that of the reference, radians; absent where
    all count."""
    comparisons: list[Comparison]
    """One entry a reference, in the order given."""
    paired: list[Paired]
    """Every pair of references on the same points, the better one first; empty with one reference."""
    scale: Scale
    """The color scale that all comparisons share."""
    verdict_reasons: list[VerdictReason] | None
    """Why it is not a pass: the reasons of the comparisons that have this verdict."""
    sampling: Sampling | None
    """How many of the points a report shows."""
    seed: int
    """Seed of everything random."""

    _nested = {"inputs": "[InputRecord]", "measured": "Measured", "alignment": "AlignedTo", "sign": "SignRecord", "comparisons": "[Comparison]", "paired": "[Paired]", "scale": "Scale", "verdict_reasons": "[VerdictReason]", "sampling": "Sampling"}
