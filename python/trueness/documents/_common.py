"""What several documents have.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from typing import Literal

from .._document import Json, Record


class InputRecord(Record):
    """A file that was read."""
    role: Literal["measured", "mesh", "reference"]
    """What it was taken for."""
    path: str
    """As given on the command line; `-` is the standard input."""
    format: str
    """Name of the format found by content."""
    bytes: int
    """Size of the file as it lies on disk; of the data read, for the standard input."""
    sha256: str | None
    """SHA-256 of those bytes, hexadecimal."""
    sha256_reason: str | None
    """Why there is no hash."""
    unit_assumed: str
    """The unit its numbers were taken for."""
    unit_from: str | None
    """Where that comes from: `option`, `header` (the names of a table's columns, or what a CAD file says) or
    `assumed`."""
    table: TableRecord | None
    """What was taken for what in a table of text; absent for other files."""
    points: int
    """Points of a cloud, distinct vertices of a mesh, or control points of B-spline surfaces."""
    facets: int | None
    """Facets; absent for a cloud."""
    incomplete: IncompleteRecord | None
    """What of the file was not read; absent where all of it was."""
    cad: CadInputRecord | None
    """Faces of a CAD model; absent for other files."""
    trimmed_faces: int | None
    """Faces of a CAD file that are less than their surface, which was taken whole; absent where there are
    none."""
    bounds: Bounds | None
    """Box of its points or vertices, mm, after units were converted; `null` where there are none."""
    warnings: list[str] | None
    """What the reader noticed and mended or passed over."""

    _nested = {"table": "TableRecord", "incomplete": "IncompleteRecord", "cad": "CadInputRecord", "bounds": "Bounds"}


class TableRecord(Record):
    """What was taken for what in a table of text."""
    separator: str
    """What parts the columns: `semicolons`, `tabs`, `commas` or `blanks`."""
    decimal_sign: str
    """`.` or `,`."""
    columns: list[ColumnRecord]
    """The columns taken for x, y and, except for points in the plane, z."""
    of: int
    """How many columns there are."""
    header_line: int | None
    """The line whose names were used, from 1; null if no line names the columns."""
    lines_skipped: int
    """Lines before the first row, the header among them."""

    _nested = {"columns": "[ColumnRecord]"}


class ColumnRecord(Record):
    """A column that was taken for a coordinate."""
    axis: str
    """`x`, `y` or `z`."""
    number: int
    """Its number, from 1."""
    name: str | None
    """Its name in the header; null without one."""


class IncompleteRecord(Record):
    """What of a file was not read."""
    read: int | None
    """Faces that were read; null where they cannot be counted."""
    of: int | None
    """Faces of the file; null where they cannot be counted."""
    text: str
    """One sentence for people."""


class CadInputRecord(Record):
    """The faces of a CAD model that was read."""
    faces: int
    """Faces, each as often as its part stands in the assembly."""
    facets_within: float
    """How far the facets made of them lie from them at most, mm."""


class Bounds(Record):
    """An axis-parallel box, millimeters."""
    min: list[float]
    """Least coordinates."""
    max: list[float]
    """Greatest coordinates."""


class AlignNote(Record):
    """Something to be said about an alignment."""
    kind: str
    """`poor`, `ambiguous`, `free`, `normals_turned`, `scale`, `few`, `unconfirmed`, `left_out`, `amplified`,
    `undetermined`, `mirrored` or `not_converged`; of an inspection also `size_ratio` and
    `hardly_overlapping`."""
    text: str
    """One sentence for people."""


class Defects(Record):
    """All defects of a kind."""
    severity: str
    """`error` where the mesh is not sound, `warning` where something may be meant otherwise."""
    count: int | None
    """Their number; `null` where they were not looked for."""
    at_least: bool | None
    """There are more than `count`: they were not counted to the end."""
    count_reason: str | None
    """Why they were not looked for."""
    size: str
    """What the size of an item is."""
    items: list[Item]
    """The first ones."""
    truncated: bool
    """Not all are listed."""

    _nested = {"items": "[Item]"}


class Item(Record):
    """One defect."""
    facets: list[int]
    """Facets concerned, numbered from 0 in the order of the file."""
    vertices: list[int]
    """Vertices concerned, numbered from 0 by their first use in a facet of the file that is finite."""
    position: list[float]
    """A place to look at."""
    bounds: Bounds | None
    """What to bring into view."""
    size: float
    """How big it is."""

    _nested = {"bounds": "Bounds"}


class SignRecord(Record):
    """How the sign of the deviations was found."""
    requested: str
    """What was asked for: `auto`, `pseudonormal`, `winding` or `none`."""
    method: str
    """What was used: `pseudonormal`, `winding`, `normal` (of B-spline surfaces), `none`, or `several` when
    references differ."""
    reason: str
    """Why that one."""
    disagreement: float | None
    """Share of the sampled points whose sign the two methods disagree on (0 to 1)."""
    disagreement_reason: str | None
    """Why there is none."""
    sample: int
    """Points in that sample."""


class Warning(Record):
    """Something that makes the deviations doubtful, although each is computed right."""
    kind: Literal["hardly_overlapping", "size_ratio"]
    """What was noticed."""
    value: float
    """The number that it was noticed by."""
    text: str
    """The same in words."""


class SurfacesRecord(Record):
    """B-spline surfaces as a reference: distances are those from the surfaces themselves."""
    count: int
    """Their number."""
    uncertain: int
    """Points for which a nearer place by more than a billionth of the surfaces' size is not excluded, as
    around the center of a sphere."""
    drawn_within: float
    """How far the facets that draw them may be from the surfaces, millimeters. No number rests on them but
    those of `--both` and of the alignment."""


class AlongRecord(Record):
    """Along what lines deviations are: distances to the nearest crossing of a line through the point with the
    reference, ahead or behind; the sign is that of the nearest place."""
    kind: str
    """`direction`: the same for all points; `reference`: the reference's normal at the nearest place;
    `measured`: each point's own normal."""
    direction: list[float] | None
    """The direction, as it was given."""


class Soundness(Record):
    """Whether a reference is a sound mesh: the precondition of the statistics."""
    sound: bool
    """Two facets at every edge, a closed fan at every vertex, no coincident facets, all facing outward."""
    closed: bool
    """No boundary edge."""
    consistently_oriented: bool
    """Neighbors agree on which side is outside."""
    outward: bool
    """The enclosed volume is positive."""
    shells: int
    """Parts connected through edges."""
    boundary_edges: int
    """Edges with one facet."""
    non_manifold_edges: int
    """Edges with more than two."""
    non_manifold_vertices: int
    """Vertices whose facets are no single fan."""
    duplicate_facets: int
    """Facets on the same three vertices as an earlier one."""
    degenerate_facets: int
    """Facets with a repeated vertex or all corners on one line; they break no rule."""
    not_finite_facets: int
    """Facets with a coordinate that is not finite, left out."""
    inconsistent_edges: int
    """Edges that both neighbors pass in the same direction."""
    findings: dict[str, Defects] | None
    """What breaks the rule, by kind and with its places, as the document of the check has it; empty where the
    mesh is sound. Self-intersections are not looked for."""

    _nested = {"findings": "{Defects}"}


class BySide(Record):
    """Statistics of all deviations and of each side."""
    all: Statistics
    """All."""
    positive: Statistics
    """Above zero: outside, too much material."""
    negative: Statistics
    """Below zero: inside, missing material."""

    _nested = {"all": "Statistics", "positive": "Statistics", "negative": "Statistics"}


class Statistics(Record):
    """Statistics of a set of deviations, millimeters (skewness and kurtosis have no unit, the variance is in
    mm²). A number that does not exist is `null`, and `<name>_reason` says why."""
    count: int
    """Number of deviations."""
    min: float | None
    """Least."""
    min_reason: str | None
    """Why the number above is missing."""
    max: float | None
    """Greatest."""
    max_reason: str | None
    """Why the number above is missing."""
    range: float | None
    """`max - min`."""
    range_reason: str | None
    """Why the number above is missing."""
    mean: float | None
    """Arithmetic mean."""
    mean_reason: str | None
    """Why the number above is missing."""
    variance: float | None
    """Sample variance, divided by `count - 1`."""
    variance_reason: str | None
    """Why the number above is missing."""
    std_dev: float | None
    """Square root of the variance."""
    std_dev_reason: str | None
    """Why the number above is missing."""
    six_sigma: float | None
    """Six standard deviations."""
    six_sigma_reason: str | None
    """Why the number above is missing."""
    cv: float | None
    """Coefficient of variation: standard deviation over the mean's size."""
    cv_reason: str | None
    """Why the number above is missing."""
    rms: float | None
    """Root mean square."""
    rms_reason: str | None
    """Why the number above is missing."""
    mean_abs: float | None
    """Mean of the absolute deviations."""
    mean_abs_reason: str | None
    """Why the number above is missing."""
    median: float | None
    """Middle value."""
    median_reason: str | None
    """Why the number above is missing."""
    mad: float | None
    """Median of the distances from the median."""
    mad_reason: str | None
    """Why the number above is missing."""
    skewness: float | None
    """Third standardized moment."""
    skewness_reason: str | None
    """Why the number above is missing."""
    kurtosis: float | None
    """Fourth standardized moment less 3."""
    kurtosis_reason: str | None
    """Why the number above is missing."""
    percentiles: Percentiles
    """Percentiles; all missing when `count` is 0."""
    percentile_error: float
    """Largest relative error of median, mad and percentiles; 0 when they are exact."""

    _nested = {"percentiles": "Percentiles"}


class Percentiles(Record):
    """Percentiles, linearly interpolated between order statistics (Hyndman & Fan's type 7, as NumPy's
    default)."""


class OutliersRecord(Record):
    """Which points were left out as outliers. The limits belong to what counts."""
    rule: str
    """The rule: `mad:K`, farther than K times 1.4826 MAD from the median, or `Ksigma`, farther than K
    standard deviations from the mean; of the deviations that nothing else excludes."""
    center: float | None
    """Median or mean, millimeters."""
    spread: float | None
    """1.4826 MAD or standard deviation, millimeters."""
    lower: float | None
    """Least deviation that counts, millimeters."""
    upper: float | None
    """Greatest deviation that counts, millimeters."""
    limits_reason: str | None
    """Why the rule gives no limits, and left out nothing."""
    count: int
    """Points left out by it."""


class CoverageRecord(Record):
    """What part of a reference no measured point covers. A piece of it counts as covered if all its corners
    have the nearest place of a point that counts within the reach."""
    area: float
    """Area of the reference, square millimeters."""
    uncovered: float
    """Area that is not covered, gray in the map, square millimeters."""
    uncovered_share: float | None
    """Its share of the area (0 to 1)."""
    uncovered_share_reason: str | None
    """Why there is none."""
    required: float | None
    """The share that must be covered for a pass (0 to 1); absent without a tolerance."""
    reach: float
    """Within what distance a point covers, millimeters."""
    spacing: float
    """How far the points' nearest places lie apart, millimeters."""
    between: int | None
    """Places on large facets of the measured mesh, between its vertices, that count here and in the map, and
    in no statistics."""


class BetweenRecord(Record):
    """Places on large facets of the measured mesh, between its vertices. They are in no statistics, but what
    passes must keep its tolerance there too: a facet across a bore that was not made has its corners on the
    part."""
    places: int
    """Places that count, evenly spread."""
    beyond: int
    """Those out of tolerance."""
    deviation: float
    """The deviation of the worst, millimeters."""
    point: list[float]
    """Where it is."""


class ToleranceShares(Record):
    """Shares of the points against the tolerance (0 to 1); the limits belong to the zone."""
    lower: float
    """Lower limit, millimeters."""
    upper: float
    """Upper limit, millimeters."""
    inside: float | None
    """Share within."""
    inside_reason: str | None
    """Why there is none."""
    above: float | None
    """Share above the upper limit."""
    above_reason: str | None
    """Why there is none."""
    below: float | None
    """Share below the lower limit."""
    below_reason: str | None
    """Why there is none."""
    required: float
    """The share inside that was asked for."""


class VerdictReason(Record):
    """What makes a verdict fail or undecided."""
    kind: str
    """`out_of_tolerance`, `alignment`, `size_ratio`, `hardly_overlapping`, `incomplete_reference`,
    `not_measured`, `between_vertices`, `coverage` or `coverage_unknown`."""
    text: str
    """One sentence for people."""


class Histogram(Record):
    """Counts of deviations between edges; bin `i` holds `edges[i] <= d < edges[i + 1]`, the last one its
    upper edge too."""
    edges: list[float]
    """`n + 1` limits, rising."""
    counts: list[int]
    """`n` counts."""
    below: int
    """Deviations below the first edge."""
    above: int
    """Deviations above the last edge."""


class ExtremeRecord(Record):
    """A measured point with its deviation."""
    index: int
    """Number of the point, from 0 in file order."""
    point: list[float]
    """The point, where it was compared."""
    deviation: float
    """Its deviation, millimeters."""


class Worst(Record):
    """One of the worst places."""
    sign: int
    """`1` above, `-1` below."""
    index: int
    """Number of the measured point, from 0 in file order."""
    point: list[float]
    """The measured point."""
    nearest: list[float]
    """The nearest place on the reference, or where its line meets it."""
    normal: list[float] | None
    """Unit normal of the reference there; null on a facet without area."""
    deviation: float
    """The deviation, millimeters."""
    region: str | None
    """The region that it belongs to, if one does."""


class FaceDeviation(Record):
    """Deviations of the points that are nearest to a face of a CAD model, or whose lines meet it."""
    face: int
    """The number of its entity in the file."""
    name: str | None
    """Its name; absent where the file gives none."""
    instance: str | None
    """The names on the way from the root of the assembly to its instance; absent where there is one
    instance."""
    kind: str
    """What its surface is."""
    count: int
    """Points that count."""
    mean: float
    """Their mean deviation, millimeters."""
    rms: float
    """The root of their mean square."""
    min: float
    """The least one."""
    max: float
    """The greatest one."""
    inside: float | None
    """Share of them that keep their tolerance (0 to 1); absent where they have none."""


class Reverse(Record):
    """From the reference to the measured mesh, and both directions together."""
    deviation: Statistics
    """Unsigned distances of the reference's vertices (or samples) from the measured mesh."""
    hausdorff: float | None
    """The greater of the two greatest distances."""
    mean: float | None
    """Mean of the two mean distances."""

    _nested = {"deviation": "Statistics"}


class PaperVsExact(Record):
    """The paper's method beside the exact distance, over the points that have both."""
    count: int
    """Points compared."""
    differing: int
    """Points whose values differ by more than rounding."""
    too_small: int
    """Of those, points where the paper's value is too small."""
    max_difference: float
    """Largest difference, millimeters."""
    median_difference: float | None
    """Median difference where they differ, millimeters."""


class Research(Record):
    """Everything together."""
    bootstrap: Bootstrap | dict[str, Json]
    """Bootstrap intervals of mean and σ, as if the points were independent."""
    block_mean: BlockMean | dict[str, Json]
    """The mean with an interval that allows for correlation within cubes of space."""
    normality: Normality
    """Tests for a normal distribution."""
    distributions: list[Distribution] | dict[str, Json]
    """Fitted distributions, the best by BIC first."""
    moran: Moran | dict[str, Json]
    """Spatial autocorrelation."""

    _nested = {"bootstrap": "Bootstrap", "block_mean": "BlockMean", "normality": "Normality", "distributions": "[Distribution]", "moran": "Moran"}


class Bootstrap(Record):
    """Bootstrap intervals (BCa for few points, see `geom::stats::research::bootstrap`)."""
    mean: list[float]
    """Interval of the mean."""
    std_dev: list[float]
    """Interval of the standard deviation."""
    confidence: float
    """Share of such intervals that hold the true value."""
    replicates: int
    """Resamples."""
    count: int
    """Deviations behind them."""


class BlockMean(Record):
    """Mean with a cluster-robust interval (Liang & Zeger 1986)."""
    block_size: float
    """Side of the cubes, millimeters: a twentieth of the reference's diagonal."""
    mean: float
    """The mean of the sample."""
    interval: list[float]
    """Its 95 % interval."""
    effective_count: float
    """Independent values that would give the same uncertainty."""
    blocks: int
    """Cubes that hold points."""
    count: int
    """Points of the sample."""


class Normality(Record):
    """Tests for a normal distribution; small p values speak against it."""
    d_agostino: Test | dict[str, Json]
    """D'Agostino and Pearson's K², of all deviations."""
    anderson_darling: Test | dict[str, Json]
    """Anderson and Darling's A², of a sample."""

    _nested = {"d_agostino": "Test", "anderson_darling": "Test"}


class Test(Record):
    """A test."""
    statistic: float
    """The statistic."""
    p_value: float
    """Chance of one as large, were the deviations normal."""
    count: int
    """Deviations looked at."""


class Distribution(Record):
    """A fitted distribution."""
    family: str
    """`normal`, `laplace`, `logistic`, `student-t`, `half-normal`, `exponential` or `log-normal`."""
    location: float
    """Where its middle lies."""
    scale: float
    """Its scale."""
    shape: float | None
    """Degrees of freedom of Student's t."""
    aic: float
    """Akaike's criterion."""
    bic: float
    """Schwarz's criterion."""
    ks_distance: float
    """Greatest difference between observed and fitted shares (Kolmogorov–Smirnov)."""


class Moran(Record):
    """Moran's I on a graph of nearest neighbors."""
    i: float
    """1: neighbors deviate alike; about 0: independently."""
    expected: float
    """What chance gives on average."""
    p_value: float
    """Two-sided p value of chance."""
    count: int
    """Points looked at."""
    neighbour_distance: float
    """Mean distance of the neighbors, millimeters."""


class Scale(Record):
    """`trueness/scale/1`."""
    name: str
    """For people."""
    mode: Literal["bands", "continuous", "go_no_go"]
    """How values become colors."""
    lower: float
    """Low end; values below have the low cap's color."""
    upper: float
    """High end; values above have the high cap's color."""
    tolerance: list[float] | None
    """The tolerance zone, which is then the middle band."""
    bands: int
    """Number of bands between the ends."""
    palette: str
    """`inspect`, `safe` (color-blind) or `mono` (print)."""
    decimals: int
    """Digits after the point in the legend."""
    unit: str
    """`mm` of deviations; `mm⁻¹` or `mm⁻²` of curvatures."""


class SharedNoise(Record):
    """The noise of what was measured: what its points scatter by about smooth surfaces, and how far neighbors
    share it."""
    deviation: float
    """Standard deviation of a point across the surface, millimeters."""
    reach: float
    """Distance beyond which two points share no noise, millimeters; 0 where none do."""
    points_per_independent: float
    """Points that tell as much as one independent point, 1 or more. Uncertainties are its root times those of
    independent points."""
    spacing: float
    """Distance of neighboring points, millimeters."""
    patches: int
    """Patches of the surface that it is told from."""
    left_out: int
    """Patches left out, which lie over edges or form."""


class Range(Record):
    """Range of a quantity."""
    min: float
    """Least."""
    median: float
    """Half of the values are below."""
    max: float
    """Greatest."""


class Counts(Record):
    """Number of characteristics by verdict."""
    pass_: int
    """Conforming."""
    fail: int
    """Not conforming."""
    undecided: int
    """Within the uncertainty of a limit."""
    not_measured: int
    """Without a value."""
