"""The document of `surface`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from .._document import Record, TaskDocument
from ._common import (
    Histogram as Histogram,
    InputRecord as InputRecord,
    Range as Range,
    Scale as Scale,
    Statistics as Statistics,
)


class KnotsRecord(Record):
    """Whole knots, ends as often as the degree and one."""
    u: list[float]
    """Along `u`."""
    v: list[float]
    """Along `v`."""


class BaseRecord(Record):
    """Where parameters came from."""
    kind: str
    """`plane`, `xy`, `cylinder`, `sphere` or `mesh`."""
    origin: list[float]
    """Of a plane the corner of the bounding rectangle, of a cylinder a place of its axis, of a sphere its
    center, of a mesh the mean of its vertices."""
    axes: list[list[float]]
    """Right-handed unit axes: of a plane the sides of the rectangle (the longer one first) and the normal; of
    a cylinder the third is its axis; of a sphere the first points amid the points; of a mesh those in which
    its vertices spread, most in the first."""
    turned: float | None
    """Angle from the longer side of the minimum bounding rectangle to the first axis, radians from −π/2 to
    π/2: 0 but of a plane whose rectangle was turned for a tolerance, along the direction in which the surface
    bends most."""
    tilted: float | None
    """Angle from the normal of the least-squares plane to the third axis, radians: 0 but of a plane over
    whose least-squares plane the points lie in layers, and over another one in fewer."""
    radius: float | None
    """Of a cylinder or a sphere."""
    radius_reason: str | None
    """Why there is none."""
    around: bool
    """Whether the points go all around, so that the surface has a seam."""
    pole: bool | None
    """Whether points lie within ten degrees of a pole of the sphere, where the surface is torn or creased."""
    folded_share: float
    """Share of the points where layers lie over one another as seen on the base (0 to 1)."""
    standing_share: float | None
    """Share of the points whose surface stands on edge on the base, at 80° and more (0 to 1)."""
    on_edge: bool | None
    """Whether so many of them do that the surface is not theirs."""
    stretch: list[float] | None
    """Of a mesh laid flat, factors by which lengths on its facets grew: 1 % of its area has less than the
    first, 1 % more than the second."""
    round: bool | None
    """Whether a mesh was laid within a circle: laid out freely, its rim would cross itself."""


class MapRecord(Record):
    """What a report draws values by."""
    histogram: Histogram | None
    """Counts of the values."""
    mean: float | None
    """Mean of the values."""
    scale: Scale
    """Their colors."""

    _nested = {"histogram": "Histogram", "scale": "Scale"}


class WorstPoint(Record):
    """A point and its deviation."""
    point: int
    """Number of the point in the file, from 0."""
    position: list[float]
    """Where it lies."""
    deviation: float
    """Its signed distance."""
    parameters: list[float]
    """Parameters of the nearest place."""


class Residual(Record):
    """What is left at the parameters of the last fit."""
    sum_of_squares: float
    """Sum of the squares."""
    rms: float
    """Root mean square."""
    max: float
    """Greatest."""


class ToleranceRecord(Record):
    """What came of a tolerance."""
    value: float
    """The tolerance."""
    reached: bool
    """Whether all points are within."""
    outside: int
    """Points beyond it."""
    stopped_by: str
    """Why no more knots were set: `tolerance`, `noise`, `points` or `memory`."""


class TrimRecord(Record):
    """The outline of the points."""
    reach: float
    """Half the width of the gaps that do not count."""
    share: float
    """Share of the rectangle of the parameters that is within (0 to 1)."""
    regions: list[RegionRecord]
    """The parts that do not hang together, largest first."""
    left_out: int
    """Points of parts with less than 1 % of them, which are left out."""

    _nested = {"regions": "[RegionRecord]"}


class RegionRecord(Record):
    """A part of the surface within closed polygons of the parameters."""
    outer: list[list[float]]
    """Around it, against the clock."""
    holes: list[list[list[float]]]
    """Around its holes, with the clock."""


class CurvatureRecord(Record):
    """Curvatures, positive where the surface bends towards its normal; `null` where no place has any."""
    count: int
    """Places that have curvatures."""
    reason: str | None
    """Why numbers are missing."""
    k1: Range | None
    """Greater principal curvature."""
    k2: Range | None
    """Lesser principal curvature."""
    mean: Range | None
    """Mean curvature."""
    gaussian: Range | None
    """Gaussian curvature, 1/mm²."""
    middle: PlaceCurvature | None
    """In the middle of the domain."""
    maps: dict[str, MapRecord]
    """Counts and colors of each: `mean`, `gaussian`, `k1`, `k2`; those of which no place has a value are
    absent."""

    _nested = {"k1": "Range", "k2": "Range", "mean": "Range", "gaussian": "Range", "middle": "PlaceCurvature", "maps": "{MapRecord}"}


class PlaceCurvature(Record):
    """Curvatures at a place."""
    parameters: list[float]
    """Its parameters."""
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


class SupportRecord(Record):
    """How well the points hold the control points."""
    control_points: int
    """Control points."""
    unsupported: int
    """Of those, without support."""
    cells: int
    """Knot cells."""
    empty_cells: int
    """Of those, without a point."""


class SurfaceDocument(TaskDocument):
    """The whole document. Lengths in millimeters, curvatures in their reciprocal."""
    schema: str
    """`trueness/surface/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """The file read."""
    degree: list[int]
    """Degrees along `u` and `v`."""
    knots: KnotsRecord
    """The knots."""
    control_points: list[list[list[float]]]
    """Control points: rows along `u`, each ordered by `v`."""
    base: BaseRecord
    """Where the parameters of the points came from."""
    fairness: float
    """Weight of the thin-plate term, mm²."""
    fairness_from: str
    """`auto` (generalized cross-validation) or `given`."""
    degrees_of_freedom: float | None
    """Degrees of freedom that the surface uses."""
    degrees_of_freedom_reason: str | None
    """Why they are not known."""
    deviation: Statistics
    """Signed distances of all points but those left out and those beyond the border from the surface, at
    their nearest places; positive on the side of the normal, which is the derivative by `u` times the
    derivative by `v`."""
    map: MapRecord
    """Counts and colors of the deviations."""
    worst: WorstPoint
    """Point farthest from the surface."""
    residual: Residual
    """Differences between the points and the surface at the parameters that the control points were found
    with."""
    tolerance: ToleranceRecord | None
    """What came of the tolerance; absent without one."""
    trim: TrimRecord | None
    """The outline that the surface is cut along in files for CAD and on the page; absent where it is not
    cut."""
    curvature: CurvatureRecord
    """Curvatures at the places nearest to the points."""
    unsupported_share: float
    """Share of the control points that hardly any point holds: the thin-plate term made them (0 to 1)."""
    support: SupportRecord
    """The same in numbers."""
    far_control_points: int
    """Control points outside of twice the box of the points."""
    corrections: int
    """Parameter corrections made."""
    outliers: int
    """Points left out by `--robust`: they contradict their neighbors. No other number counts them."""
    beyond_border: int | None
    """Points beyond the border of the surface: their distance has a part along it. No other number counts
    them."""
    unsettled: int
    """Points whose nearest place was not found to the last digit."""
    warnings: list[str]
    """What makes the surface doubtful."""

    _nested = {"inputs": "[InputRecord]", "knots": "KnotsRecord", "base": "BaseRecord", "deviation": "Statistics", "map": "MapRecord", "worst": "WorstPoint", "residual": "Residual", "tolerance": "ToleranceRecord", "trim": "TrimRecord", "curvature": "CurvatureRecord", "support": "SupportRecord"}
