"""The document of `section`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from typing import Literal

from .._document import Json, Record, TaskDocument
from ._common import (
    BySide as BySide,
    Histogram as Histogram,
    InputRecord as InputRecord,
    SharedNoise as SharedNoise,
    VerdictReason as VerdictReason,
)


class FrameRecord(Record):
    """The plane of a section: a place of it and the directions of its two axes."""
    origin: list[float]
    """The place with the coordinates 0, 0."""
    x: list[float]
    """Direction of the first axis."""
    y: list[float]
    """Direction of the second axis."""
    flatness: float
    """Greatest distance of a point from the plane."""


class PlaneRecord(Record):
    """A plane that a mesh or cloud was cut by: all places `p` with `normal · p = offset`."""
    normal: list[float]
    """Its normal, of length 1."""
    offset: float
    """Its distance from the origin along the normal."""
    frame: FrameRecord
    """Its axes."""
    contours: int
    """Contours found in it."""
    area: float | None
    """Area inside closed contours of a mesh, holes taken off, of the facets themselves. What shells share
    counts once for each of them."""
    area_reason: str | None
    """Why there is no area."""
    loose: int
    """Points of a cloud in its slab that belong to no contour."""
    gap: float | None
    """Contours of a cloud go on over gaps up to this: the one given, or told from how uneven the points
    lie."""
    hint: str | None
    """What may help where contours of a cloud are suspiciously many."""
    fills_area: bool | None
    """Whether the points of a cloud in its slab fill an area, so that there are no contours; `hint` says
    so."""

    _nested = {"frame": "FrameRecord"}


class ContourRecord(Record):
    """A contour."""
    plane: int | None
    """Number of its plane in `planes`, from 0; of points in order `null`."""
    taken: str
    """What its points were taken for: `row` (measured points), `facets` (exact ones, of a drawing), `scan`
    (facets of a scan)."""
    closed: bool
    """Whether its end is its start."""
    length: float
    """Length of all segments."""
    noise: float
    """Standard deviation of the points about it; of `facets`, which carry no noise, the root mean square of
    their distances from it."""
    spacing: float
    """Mean distance between neighboring points."""
    points: int
    """Points given."""
    segments: list[SegmentRecord]
    """The segments in the order of the points."""
    joins: list[JoinRecord]
    """The joins: number `i` between segments `i` and `i + 1`, of a closed contour the last between the last
    and the first."""
    joins_reason: str | None
    """Why there is no join."""
    outliers: list[int]
    """Points left out as outliers, by their numbers from 0."""
    bevels: list[int] | None
    """Crossings of a scan's edges, by their numbers from 0, where its facets pass a corner of the part by:
    they belong to no segment."""
    repeated: list[int]
    """Points that repeat the one before, by their numbers; they were left out."""
    gaps: list[int]
    """Gaps: the number of the point before."""
    crossings: list[list[float]] | None
    """Where the contour crosses itself, at most a hundred places: a closed one that does has no inside."""
    astray: list[int] | None
    """Segments, by their numbers from 0, that do not run along their points and tell nothing of the part;
    with any, the exit status is 1."""
    doubts: list[str] | None
    """What makes the contour doubtful, each with what may help: points that may be strays, walls too thin to
    be told apart. With any, the exit status is 1."""
    hints: list[str] | None
    """What to heed about it, each with what may help: points of a row off their plane, a noise given that
    they contradict, radii that the thickness of a slab moves."""
    tidy: list[OfferRecord] | None
    """What a drawing would have, as offers that the points allow, where they were asked for. None of them is
    put into the contour."""
    tidy_reason: str | None
    """Why there are no offers."""
    residuals: list[float]
    """Signed distance of each point from the contour, positive to the left."""
    labels: list[int]
    """Number of the segment of each point."""
    stations: list[float]
    """Length along the contour from the start of the first segment to the foot of each point."""

    _nested = {"segments": "[SegmentRecord]", "joins": "[JoinRecord]", "tidy": "[OfferRecord]"}


class SegmentRecord(Record):
    """A segment."""
    start: list[float]
    """Where it starts."""
    end: list[float]
    """Where it ends."""
    length: float
    """Its length."""
    count: int
    """Points that belong to it."""
    rms: float
    """Root mean square of their distances."""
    max: float
    """Greatest magnitude of their distances."""
    curvature: list[float]
    """Curvature at its start and end, positive where it turns to the left."""
    near_arc: NearArc | None
    """Of a spline that is nearly an arc, that arc: within a thousandth of its length, and the length half of
    the radius at least: a flatter curve is near to many arcs. Absent for others, and for those of
    `facets`."""
    uncertainty: dict[str, Json] | None
    """Standard uncertainty of its angle, or of its center and radius, from the scatter of the points."""
    uncertainty_reason: str | None
    """Why there is none."""
    length_uncertainty: float | None
    """Standard uncertainty of its length, from the scatter of the points."""
    length_uncertainty_reason: str | None
    """Why there is none."""
    kind: Literal["arc", "line", "spline"]
    angle: float | None
    """Angle of its direction with the first axis."""
    center: list[float] | None
    """Center of the circle."""
    radius: float | None
    """Its radius."""
    start_angle: float | None
    """Angle of the start, seen from the center."""
    sweep: float | None
    """Angle run through, positive counter-clockwise."""
    degree: int | None
    """Its degree."""
    knots: list[float] | None
    """Its knots, the ends `degree + 1` times."""
    control_points: list[list[float]] | None
    """Its control points."""
    deviation: float | None
    """Greatest distance from the curve that was fitted."""

    _nested = {"near_arc": "NearArc"}


class NearArc(Record):
    """The arc that a curve is near to."""
    center: list[float]
    """Its center."""
    radius: float
    """Its radius."""
    rms: float
    """Root mean square distance of the curve from it."""
    max: float
    """Greatest distance of the curve from it."""


class JoinRecord(Record):
    """A join."""
    point: list[float]
    """The place."""
    position: list[float]
    """The same place in space."""
    continuity: str
    """`g0` (a corner), `g1` (a common tangent) or `g2` (and, as far as the data can tell, a common
    curvature)."""
    interval: list[list[float]]
    """The join lies between these two places, at the confidence `level`."""
    std_uncertainty: float
    """Standard uncertainty along the contour; of a corner, the greatest of any direction."""
    interval_open: list[bool]
    """Whether the data allow the join beyond an end of the interval, which was not followed farther."""
    turn: float
    """Angle of the corner, positive to the left; 0 of a tangent join."""


class OfferRecord(Record):
    """A relation, or a whole number, that the points allow. The contour does not have it: it is as it was
    found."""
    kind: str
    """`horizontal` or `vertical` line, lines that are `parallel`, `in_line` or at a `right_angle`, `tangent`
    segments, `equal_radii` or `concentric` arcs, or a whole number of steps: `radius`, `diameter`, `length`
    of a line, `distance` of parallel lines, distance of `centers`."""
    segments: list[MemberRecord]
    """The segments that it is about."""
    found: float
    """The value found: a length, or an angle in radians; of `in_line`, `tangent`, `equal_radii` and
    `concentric` how far that is missed."""
    std_uncertainty: float
    """Its standard uncertainty, from the scatter of the points; of `concentric` that along the way from
    center to center."""
    offered: float
    """The value offered."""
    step: float | None
    """Of a whole number the step that it is a multiple of, millimeters."""
    z: float
    """The difference in standard uncertainties. With what is offered the sum of the squared distances grows
    by its square times the variance of the points (twice the logarithm of the likelihood ratio is the
    square)."""
    p: float
    """The probability of a difference as large, if what is offered holds."""
    chance: float
    """The probability that a value which has nothing to do with it would be offered, too."""

    _nested = {"segments": "[MemberRecord]"}


class MemberRecord(Record):
    """A segment of a contour, both by their numbers from 0."""
    contour: int
    """Number of the contour in `contours`."""
    segment: int
    """Number of the segment in it."""


class DimensionsRecord(Record):
    """The dimensions between segments: how many there are, and the first of them."""
    count: int
    """How many there are."""
    truncated: bool
    """Whether some are not listed."""
    items: list[DimensionRecord]
    """Plane after plane."""

    _nested = {"items": "[DimensionRecord]"}


class DimensionRecord(Record):
    """A dimension between two segments."""
    kind: str
    """`angle` that a line and the next of its contour enclose, `width` between parallel lines that face each
    other, distance of the `centers` of two arcs, or `gap` between two contours."""
    of: list[MemberRecord]
    """The segments that it is of."""
    value: float
    """Its value: a length, of an angle radians."""
    std_uncertainty: float | None
    """Its standard uncertainty, from the scatter of the points."""
    std_uncertainty_reason: str | None
    """Why there is none."""
    between: list[list[float]]
    """The two places between which it is measured; of an angle, the end of the first line and the start of
    the next."""

    _nested = {"of": "[MemberRecord]"}


class AirfoilRecord(Record):
    """The measures of a contour as a profile, or why there are none."""
    contour: int
    """Number of the contour in `contours`, from 0."""
    measures: AirfoilMeasures | None
    """What was measured."""
    measures_reason: str | None
    """Why nothing was."""

    _nested = {"measures": "AirfoilMeasures"}


class AirfoilMeasures(Record):
    """Measures of a profile. Lengths in millimeters; `…_at` are shares of the chord, from the leading
    edge."""
    leading_edge: list[float]
    """The place farthest from the trailing edge."""
    trailing_edge: list[float]
    """The trailing edge; of one with two corners, or of an open row, the middle between these."""
    chord: float
    """Distance of the two."""
    chord_angle: float
    """Angle of the way from leading to trailing edge with the first axis, radians."""
    chords: list[ChordRecord] | None
    """The chord by each of its usual definitions, with their angles and twists."""
    chords_reason: str | None
    """Why there are none, nor centroid and area."""
    centroid: list[float] | None
    """Center of the area that the profile encloses."""
    area: float | None
    """That area."""
    stacking: StackingRecord | None
    """How far the profile's stacking point is from where it should be, where a nominal or that point was
    given."""
    thickness: float
    """Diameter of the greatest inscribed circle."""
    thickness_uncertainty: float
    """Its standard uncertainty, from the scatter of the points."""
    thickness_at: float
    """Where along the chord its center is."""
    thickness_center: list[float]
    """The center."""
    camber: float
    """Greatest distance of the camber line from the chord, positive to the left of the way from leading to
    trailing edge."""
    camber_at: float
    """Where along the chord that is."""
    leading_radius: float | None
    """Radius of curvature at the leading edge."""
    leading_radius_uncertainty: float | None
    """Its standard uncertainty, from the scatter of the points."""
    leading_radius_reason: str | None
    """Why there is no radius."""
    trailing_kind: str
    """What the trailing edge is: `sharp` (a corner), `blunt` (two corners), `round`, `open` (the row ends
    there)."""
    trailing_thickness: float | None
    """Distance of the two corners, or of the ends of an open row."""
    trailing_radius: float | None
    """Radius of curvature at a round trailing edge."""
    trailing_radius_uncertainty: float | None
    """Its standard uncertainty, from the scatter of the points."""
    trailing_radius_reason: str | None
    """Why there is no radius."""
    camber_line: list[list[float]]
    """Center (x, y) and radius of circles inscribed into the profile, from the leading to the trailing
    edge."""

    _nested = {"chords": "[ChordRecord]", "stacking": "StackingRecord"}


class ChordRecord(Record):
    """A chord."""
    definition: str
    """`farthest`: between the two places of the profile that are farthest from each other; `camber_ends`:
    between the ends of the camber line, led on to the profile; `bitangent`: the extent along the flat
    tangent, the line that touches the hollow side at two places."""
    leading: list[float] | None
    """Its end at the leading edge."""
    trailing: list[float] | None
    """Its end at the trailing edge."""
    length: float | None
    """Its length."""
    angle: float | None
    """Angle of the way from leading to trailing edge with the first axis, radians."""
    length_reason: str | None
    """Why there is no such chord."""
    twist: float | None
    """Twist: by how much its angle is greater than that of the nominal's chord of the same definition,
    radians."""
    twist_reason: str | None
    """Why there is no twist."""


class StackingRecord(Record):
    """Where a profile is, against where it should be."""
    point: list[float]
    """The stacking point: the one given, or the centroid of the nominal's profile."""
    by: str
    """`given` or `centroid`."""
    offset: list[float]
    """How far the profile's own stacking point is from it. With a nominal it goes with the profile as
    centroid and twist (of the chord between the farthest places) say; without one it is the centroid."""
    along_chord: float
    """The same along the profile's farthest chord, positive toward the trailing edge."""
    across_chord: float
    """The same across it, positive to its left."""


class LeanRecord(Record):
    """How the offsets of the stacking points grow from plane to plane."""
    lean: list[float]
    """Angles by which the stacking line leans toward the first and the second axis of the planes, radians: of
    the line of least squares."""
    greatest: float
    """Greatest distance of an offset from that line."""
    planes: int
    """Planes that it is of."""


class NominalRecord(Record):
    """Deviations of the points of a section from the section of a nominal."""
    path: str
    """Path of the nominal; it is the last of `inputs`."""
    outline: str
    """What was measured against: `facets` (the cut of a mesh), `faces` (the cut of a CAD model), `contour`
    (the segments found in a row of points) or `drawing` (the entities of a drawing)."""
    positive: str
    """Positive deviations: `outside` of the material within closed outlines, to the `left` of open ones, or
    `outside_or_left` where points are nearest to both: each is as its outline is (`closed` of `outlines`)."""
    deviation: BySide
    """Statistics of the deviations: all, those above zero, those below zero."""
    fits: list[FitRecord] | None
    """The best fit of each plane before the deviations were taken, where one was asked for."""
    profile: ProfileRecord | None
    """The deviations against the tolerance of the profile, where one was given."""
    verdict: Literal["fail", "not_measured", "pass", "undecided"] | None
    """The verdict on them: what table, page and exit status go by. Without a tolerance it is absent."""
    verdict_reasons: list[VerdictReason] | None
    """Why it is not a pass."""
    excluded: dict[str, int]
    """Points left out, by reason: `BEYOND_END`, `NO_OUTLINE`, `MAX_DISTANCE`."""
    histogram: Histogram | None
    """Counts of the deviations; absent when there are none."""
    worst: list[WorstRecord]
    """The points farthest off on both sides: above first."""
    deviations: list[list[float | None]]
    """The deviation of each point of each contour; `null` where it is left out."""
    outlines: list[OutlineRecord] | None
    """The outlines of the nominal, plane after plane, and how much of each was measured."""
    warnings: list[NominalWarning] | None
    """What makes the deviations doubtful, although each is computed right."""

    _nested = {"deviation": "BySide", "fits": "[FitRecord]", "profile": "ProfileRecord", "verdict_reasons": "[VerdictReason]", "histogram": "Histogram", "worst": "[WorstRecord]", "outlines": "[OutlineRecord]", "warnings": "[NominalWarning]"}


class FitRecord(Record):
    """The motion that brought the section of a plane nearest to the nominal, before its deviations were
    taken: from the section as it lies to the nominal. Coordinates of contours, worst points and outlines stay
    those of the section as it lies."""
    plane: int | None
    """Number of its plane in `planes`, from 0; of points in order `null`."""
    freedom: str
    """What may move: `free`, `xy`, `x`, `y` or `turn`."""
    center: list[float]
    """What it turns about: the middle of the points, of `turn` the origin."""
    shift: list[float]
    """Where that goes."""
    shift_uncertainty: list[float | None]
    """Standard uncertainty of the shift; `null` of what may not move."""
    turn: float
    """Angle that it turns by, radians, counter-clockwise."""
    turn_uncertainty: float | None
    """Its standard uncertainty; `null` where it may not turn."""
    transform: list[list[float]]
    """Takes x, y, 1 of the section to the nominal's coordinates: two rows."""
    rms_before: float
    """Root mean square distance before."""
    rms: float
    """Root mean square distance after it, of the same points."""
    correlated: float
    """So many successive points tell as much as one alone, as their deviations go together; the uncertainties
    allow for it."""
    used: int
    """Points that count."""
    left_out: int
    """Points that do not: beyond an end of the nominal, or farther than `--max-distance`."""
    iterations: int
    """Steps taken."""
    converged: bool
    """Whether it came to rest."""


class ProfileRecord(Record):
    """The deviations against a tolerance of the profile (ISO 1101, profile any line)."""
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
    zone_width: float
    """Width of the zone: `upper` − `lower`. Of ±T it is 2 T, the number in the frame of a drawing; the zone
    is even about the nominal then."""
    worst: WorstRecord | None
    """The point farthest beyond the limits, or nearest to them where all are within."""
    covered: float
    """Share of the nominal's length that points run along (0 to 1)."""
    counterparts: float
    """Share of the points that have a counterpart on the nominal (0 to 1)."""
    min_coverage: float
    """The share of both that a pass needs."""

    _nested = {"worst": "WorstRecord"}


class WorstRecord(Record):
    """A point far off the nominal."""
    contour: int
    """Number of its contour, from 0."""
    index: int
    """Its number in the contour, from 0."""
    point: list[float]
    """The point, in its plane."""
    nearest: list[float]
    """The place of the nominal nearest to it."""
    deviation: float
    """Its deviation."""


class OutlineRecord(Record):
    """An outline of a nominal. Documents do not hold its lines, arcs and curves, which may be far more than
    those of the contours; a report draws them."""
    plane: int | None
    """Number of its plane in `planes`, from 0; of points in order `null`."""
    closed: bool
    """Whether its end is its start."""
    hole: bool
    """Whether the material is outside of it."""
    length: float
    """Its length."""
    center: list[float]
    """Middle of the box around it."""
    size: list[float]
    """Width and height of that."""
    points: int
    """Points that are nearest to it."""
    covered: float
    """Share of its length that successive points run along, from 0 to 1; 0: it was not measured."""


class NominalWarning(Record):
    """Something that makes the deviations doubtful, although each is computed right."""
    kind: Literal["face_in_plane", "hardly_overlapping", "layers_passed_over", "nearly_closed", "nowhere_near", "size_ratio"]
    """What was noticed."""
    value: float
    """The number that it was noticed by."""
    text: str
    """The same in words."""


class MethodsRecord(Record):
    """The paper's methods of finding the join of one line and one curve."""
    chosen: str
    """The one that the contour is of: `stepwise`, `improved` or `golden`."""
    interval: str
    """How the interval of `golden` was found: `paper` or `profile`."""
    table: list[MethodRecord]
    """What each found."""

    _nested = {"table": "[MethodRecord]"}


class MethodRecord(Record):
    """What one method found."""
    method: str
    """`stepwise`, `improved` or `golden`."""
    interval: list[list[float]]
    """Where it looked for the join, from the line to the curve."""
    interval_length: float
    """Length of that."""
    join: list[float]
    """The join."""
    line: ResidualsRecord
    """Points of the line, and their distances from it."""
    curve: ResidualsRecord
    """Points of the curve, and their distances from it."""
    control_points: int
    """Control points of the curve."""

    _nested = {"line": "ResidualsRecord", "curve": "ResidualsRecord"}


class ResidualsRecord(Record):
    """Distances of points from a segment."""
    points: int
    """Number of points."""
    rms: float
    """Root mean square."""
    max: float
    """Greatest magnitude."""


class SectionDocument(TaskDocument):
    """The whole document. Lengths in millimeters, angles in radians."""
    schema: str
    """`trueness/section/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """The file read."""
    level: float
    """Confidence of the intervals."""
    noise_given: float | None
    """Standard deviation of the points across the contour, where it was given."""
    shared_noise: SharedNoise | None
    """The noise of a mesh's vertices, and how far neighbors share it: of contours taken from a scan's facets
    the search and the uncertainties take it into account."""
    shared_noise_reason: str | None
    """Why none is told."""
    continuity_given: str | None
    """Continuity of all joins, where it was asked for: `g0`, `g1` or `g2`."""
    frame: FrameRecord
    """Where the plane of the section lies in space; of several, the first."""
    planes: list[PlaneRecord]
    """The planes that a mesh or cloud was cut by; of points in order none."""
    contours: list[ContourRecord]
    """The contours."""
    dimensions: DimensionsRecord
    """Angles, widths, distances of centers and gaps between segments; lengths and radii stand with the
    segments."""
    airfoils: list[AirfoilRecord] | None
    """Chord, camber, thickness and edges of each contour, where they were asked for."""
    lean: LeanRecord | None
    """How the stacking points of the profiles lean from plane to plane: of parallel planes with one profile
    each."""
    nominal: NominalRecord | None
    """How the points differ from the section of a nominal, where one was given."""
    methods: MethodsRecord | None
    """The three methods of the paper, side by side, where one was asked for; the contour is that of the one
    chosen."""

    _nested = {"inputs": "[InputRecord]", "shared_noise": "SharedNoise", "frame": "FrameRecord", "planes": "[PlaneRecord]", "contours": "[ContourRecord]", "dimensions": "DimensionsRecord", "airfoils": "[AirfoilRecord]", "lean": "LeanRecord", "nominal": "NominalRecord", "methods": "MethodsRecord"}
