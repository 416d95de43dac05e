"""The document of `inspect`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from typing import Literal

from .._document import Record, TaskDocument
from ._common import (
    AlignNote as AlignNote,
    AlongRecord as AlongRecord,
    BetweenRecord as BetweenRecord,
    BySide as BySide,
    Counts as Counts,
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
    SharedNoise as SharedNoise,
    SignRecord as SignRecord,
    Soundness as Soundness,
    Statistics as Statistics,
    SurfacesRecord as SurfacesRecord,
    ToleranceShares as ToleranceShares,
    VerdictReason as VerdictReason,
    Warning as Warning,
    Worst as Worst,
)


class PlanRecord(Record):
    """The plan's file."""
    path: str
    """As given on the command line."""
    sha256: str | None
    """SHA-256 of its bytes, hexadecimal."""


class AlignmentRecord(Record):
    """How the measured data came to lie on the reference."""
    method: str
    """`none`, `given`, `best-fit`, `chebyshev`, `zones`, `datum`, `pairs` or `rps`."""
    transform: list[list[float]]
    """4×4, row by row: takes measured coordinates to those of the reference."""
    rms: float | None
    """Root mean square distance of the points that count, of a best fit (also one that datums began with), of
    pairs and of reference points; null of other ways."""
    mean_abs: float | None
    """Their mean distance."""
    greatest: float | None
    """Of `chebyshev` the greatest distance of a point that counts: the least there is near the best fit."""
    excess: float | None
    """Of `zones` how far the worst point of all is beyond its tolerance, negative where all are within: the
    least there is near the best fit where all count in the search."""
    residuals: list[float] | None
    """Of pairs the distance left of each, of reference points the signed one along its direction; absent of
    other ways."""
    amplifications: list[float] | None
    """Of reference points, in the same order: how many millimeters the farthest corner of the part moves per
    millimeter of error; absent of other ways."""
    left_out: int | None
    """Points without a weight in the fit, also in the one that datums began with; absent of other ways. They
    are evaluated all the same."""
    iterations: int | None
    """Steps of the iteration."""
    converged: bool | None
    """Whether the iteration settled."""
    warnings: list[AlignNote]
    """What is to be said about it."""

    _nested = {"warnings": "[AlignNote]"}


class FeatureRecord(Record):
    """A feature as it was found."""
    id: str
    """Its name."""
    shape: str
    """`point`, `line`, `plane`, `circle`, `sphere`, `cylinder`, `cone` or `torus`."""
    source: str
    """Where it comes from: `points`, `nominal`, `seed`, `faces` or `derived`."""
    points: int
    """Number of its points."""
    coverage: float | None
    """Share of its nominal area that was measured."""
    coverage_reason: str | None
    """Why there is none."""
    method: str
    """How its element was associated."""
    parameters: dict[str, float | list[float]] | None
    """The element, by names, as in a fit; null where there is none."""
    measured: MeasuredPlace | None
    """Where it was measured, and its size; null where there is no element."""
    nominal: MeasuredPlace | None
    """The same as the model has it: the place of its nominal that is nearest to the measured one. Null where
    it has no nominal."""
    uncertainty: dict[str, float | list[float]] | None
    """Standard uncertainty of each parameter by the points' scatter."""
    uncertainty_reason: str | None
    """Why there is none."""
    form_error: float | None
    """Greatest less least signed distance from the element."""
    rms: float | None
    """Root mean square of the distances."""
    reason: str | None
    """Why there is no element, or no distance from it."""
    extract: ExtractRecord | None
    """How near facets had to be to the nominal feature; absent where it was not sought by it."""
    dents: int | None
    """Points of it in dents deeper than its extract distance; absent where there are none."""
    left_out: LeftOutRecord | None
    """Measured points that it leaves out; absent where there are none."""
    faces: list[FaceRecord] | None
    """The faces of the reference that it is, where that is a CAD model; absent else."""

    _nested = {"measured": "MeasuredPlace", "nominal": "MeasuredPlace", "extract": "ExtractRecord", "left_out": "LeftOutRecord", "faces": "[FaceRecord]"}


class MeasuredPlace(Record):
    """Place and size of a feature, in the coordinates of the aligned data. Millimeters."""
    place: list[float]
    """Its place: the middle of its axis or points, its center."""
    diameter: float | None
    """Diameter of a cylinder, circle or sphere; null of what has none."""
    angle: float | None
    """Angle between the sides of a cone, degrees; null of what has none."""


class ExtractRecord(Record):
    """How near facets had to be to the nominal feature."""
    distance: float
    """Greatest distance."""
    angle: float
    """Greatest angle between the normals, degrees."""
    margin: float
    """What was left out along the bounds."""
    rim: bool
    """Whether vertices that other facets share counted."""
    coverage: float
    """Least share of the nominal area that had to be measured."""


class LeftOutRecord(Record):
    """Measured points that a feature leaves out."""
    others: int
    """Points within its reach of which it is not certain that they are of it: what each value would be with
    them, its characteristic tells."""
    edge: int | None
    """Points on its edges, where scans are rounded: none of those."""
    broken: int | None
    """Those of them along its edges that no face explains: burrs, grooves, chamfers that are not drawn."""
    deep: int | None
    """Those of them that go on into the material beyond its extract distance: holes, deep dents."""
    high: int | None
    """Those of them that go on out of the material: bumps, what stands on it."""
    between: int | None
    """Those of them between it and the other side of a wall, off both."""
    outliers: int | None
    """Points of a scan that stick out, with no more than two together: outliers."""
    beyond: int
    """Points that lie where the feature is, but farther off than its extract distance."""
    farthest: float | None
    """How far off the farthest of these is; null where there are none."""
    on_reference: bool
    """Whether a reference has the feature. Else nothing but the points tells of these."""


class FaceRecord(Record):
    """A face of a CAD model."""
    face: int
    """The number of its entity in the file."""
    name: str | None
    """Its name; absent where the file gives none."""
    instance: str | None
    """The names on the way from the root of the assembly to its instance; absent where there is one
    instance."""


class CharacteristicRecord(Record):
    """A characteristic with its verdict."""
    id: str
    """Its name."""
    kind: str
    """What it is: `flatness`, `position`, …"""
    symbol: str
    """Its sign on drawings, where it has one."""
    feature: str
    """The toleranced feature; of a size of two planes, both, with a dash between."""
    datums: list[str]
    """The datums, the first one first: `A`, a common datum `A-B`, with a material requirement `A(M)`."""
    modifiers: list[str]
    """What modifies it: the tolerance class, the size, the offset of the zone, the intersection planes, the
    material requirement, the datums' association, the parameter."""
    zone: str
    """Form of the zone: `width`, `diameter` or `value` (a dimension or parameter)."""
    nominal: float | None
    """Nominal value of a dimension."""
    tolerance: float | None
    """Width or diameter of the zone; the greatest allowed value."""
    lower: float | None
    """Least allowed value of a dimension."""
    upper: float
    """Greatest allowed value; with a material requirement, the tolerance and its bonus."""
    value: float | None
    """The value; millimeters, degrees for an angle."""
    unit: str
    """Unit of the value: `mm`, `deg`, or `1` for a ratio."""
    uncertainty: float | None
    """Expanded uncertainty of the value (k = 2): value less and plus this hold the true one. Null where the
    plan states neither it nor the noise of the points."""
    uncertainty_source: str | None
    """Where it comes from: `plan`, `noise`, or `plan and noise`."""
    noise_bias: float | None
    """What noise adds to the value on the average, where it leads away from the true one to one side: the
    interval lies about the value less this. It is not taken off the value. Absent where noise adds
    nothing."""
    interval: list[float] | None
    """From and to where the true value lies: about the value less `noise_bias`, longer where little is known
    of the form below the noise. What `iso14253-1` decides by. Absent where there is no uncertainty."""
    decision_rule: str
    """How the verdict was reached."""
    verdict: Literal["fail", "not_measured", "pass", "undecided"]
    """The verdict."""
    reason: str | None
    """Why there is no value."""
    utilisation: float | None
    """Share of what is allowed that the value takes up; 1 is at a limit."""
    witness: list[list[float]]
    """Places where the value is reached."""
    anchor: list[float] | None
    """Where a leader may end: on the feature."""
    parts: dict[str, float]
    """Further numbers."""
    place: PlaceRecord | None
    """Of a position or a profile: where its feature lies, in the frame of its true place; absent of other
    kinds."""
    value_with_others: float | None
    """The value with the points of its features and datums of which it is not certain whose they are; absent
    where there are none."""
    notes: list[str]
    """What the reader should know."""
    standard: str
    """The standard and clause that define it."""

    _nested = {"place": "PlaceRecord"}


class PlaceRecord(Record):
    """Where the feature of a characteristic lies beside its true place. Millimeters."""
    frame: str
    """What the frame comes from: `datums`, `plan` (numbers of the plan) or `aligned` (the coordinates of the
    aligned data)."""
    origin: list[float]
    """Its origin in the coordinates of the aligned data."""
    x: list[float]
    """Direction of its x."""
    z: list[float]
    """Direction of its z."""
    measured: list[float]
    """The measured place: the middle of the feature's axis or points, its center."""
    exact: list[float | None]
    """The true place; null along what is not toleranced."""
    deviation: list[float | None]
    """Measured less true place: dx, dy, dz."""


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


class PlaceMap(Record):
    """Mean deviations at places of the reference, which are the same for every part: its facets, parted at
    creases and cut by the reference's own size alone."""
    places: list[list[float]]
    """Where the places are, mm."""
    facets: list[list[int]]
    """The surface between them: numbers of three places each, from 0, counter-clockwise seen from outside."""
    deviations: list[float | None]
    """Mean deviation of the points whose place on the reference is nearest to each place; where there are
    none, of the nearest place along the surface that has some; null where that is farther than `reach`."""
    points: list[int]
    """Number of points in each; 0 where it is another place's."""
    reach: float
    """How far a mean goes over to places without points, mm."""


class InspectDocument(TaskDocument):
    """The whole document. Lengths in millimeters, angles of features in radians, of characteristics in
    degrees."""
    schema: str
    """`trueness/inspect/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    title: str | None
    """The plan's heading."""
    plan: PlanRecord
    """The plan that was evaluated."""
    inputs: list[InputRecord]
    """The files read."""
    alignment: AlignmentRecord
    """How the measured data came to lie on the reference."""
    features: list[FeatureRecord]
    """The features, in the plan's order."""
    characteristics: list[CharacteristicRecord]
    """The characteristics, in the plan's order."""
    shared_noise: SharedNoise | None
    """The noise of what was measured, and how far neighbors share it: the uncertainties of the features take
    it into account, and with `noise = "measured"` those of the values."""
    shared_noise_reason: str | None
    """Why none is told: the uncertainties of the features are those of independent points."""
    deviation: Comparison | None
    """Deviations of all that was measured from the reference, as in a comparison; null where the plan asks
    for none."""
    deviation_reason: str | None
    """Why there are none."""
    deviation_map: PlaceMap | None
    """Deviations at places that are the same for every part, for the map of a trend; absent where it was not
    asked for."""
    scale: Scale | None
    """The colors of the deviations; absent where there are none."""
    decision_rule: str
    """How verdicts are reached: `simple` or `iso14253-1`."""
    counts: Counts
    """Number of characteristics by verdict."""
    verdict_reasons: list[VerdictReason] | None
    """What makes all of it undecided; absent where nothing does."""

    _nested = {"plan": "PlanRecord", "inputs": "[InputRecord]", "alignment": "AlignmentRecord", "features": "[FeatureRecord]", "characteristics": "[CharacteristicRecord]", "shared_noise": "SharedNoise", "deviation": "Comparison", "deviation_map": "PlaceMap", "scale": "Scale", "counts": "Counts", "verdict_reasons": "[VerdictReason]"}
