"""The document of `fit`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from .._document import Record, TaskDocument
from ._common import (
    Histogram as Histogram,
    InputRecord as InputRecord,
    Scale as Scale,
    SharedNoise as SharedNoise,
)


class Extreme(Record):
    """A point and its signed distance."""
    distance: float
    """Distance from the element, millimeters."""
    point: int
    """Index of the point in the file, counted from 0."""
    position: list[float] | None
    """Where the point lies."""


class Touching(Record):
    """A point that touches."""
    point: int
    """Index of the point in the file, counted from 0."""
    side: int
    """1 on the outer boundary, −1 on the inner one."""
    multiplier: float
    """Its share in holding the element: positive, all sum to 1."""
    position: list[float] | None
    """Where the point lies."""


class Extent(Record):
    """The part of an element that its points lie on, in a frame of the element. The two coordinates are
    lengths, or angles in radians: of a plane along the first and second axis; of a line, nothing and along
    the third axis; of what is round, about the third axis from the first, and (cylinder, cone) along it,
    (sphere) up from the equator, (torus) around the tube from its outer side. A circle and an ellipse have
    the first alone."""
    origin: list[float]
    """Where the frame sits."""
    axes: list[list[float]]
    """Its axes."""
    u: list[float]
    """Range of the first coordinate; a full turn is 2π."""
    v: list[float]
    """Range of the second."""


class FitDocument(TaskDocument):
    """The whole document. Lengths in millimeters, angles in radians."""
    schema: str
    """`trueness/fit/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    inputs: list[InputRecord]
    """The file read."""
    shape: str
    """`line`, `plane`, `circle`, `ellipse`, `sphere`, `cylinder`, `cone` or `torus`."""
    planar: bool
    """True if the element lies in the plane z = 0, as points of two columns do."""
    method: str
    """`gaussian`, `minimum-zone`, `minimum-circumscribed`, `maximum-inscribed` or `robust`."""
    parameters: dict[str, float | list[float]]
    """The element, by names: `point`, `direction`, `normal`, `center`, `apex`, `radius`, `half_angle`,
    `major_radius`, `minor_radius`, as the shape has them."""
    uncertainty: dict[str, float | list[float]] | None
    """Standard uncertainty of each parameter; of places and directions, coordinate by coordinate. Errors are
    shared by neighbors as far as `shared_noise` tells, else independent."""
    uncertainty_reason: str | None
    """Why there is none."""
    shared_noise: SharedNoise | None
    """The noise of the points about the element, and how far neighbors share it."""
    shared_noise_reason: str | None
    """Why none is told: the uncertainties are those of independent points."""
    form_error: float
    """Greatest less least signed distance, or the width of the zone; of a curve in space, twice the greatest
    distance."""
    rms: float
    """Root mean square of the distances."""
    std_dev: float | None
    """Sum of squares over the distances left after the unknowns, its root."""
    std_dev_reason: str | None
    """Why there is none."""
    count: int
    """Number of points; with `robust`, of those that are no outliers."""
    outliers: int
    """Points left out by `robust`."""
    minimum: Extreme
    """Point with the least signed distance."""
    maximum: Extreme
    """Point with the greatest signed distance."""
    touching: list[Touching]
    """Points that hold a zone, a circumscribed or an inscribed element."""
    extent: Extent | None
    """The part of the element that the points lie on."""
    histogram: Histogram | None
    """Counts of the signed distances of all points."""
    scale: Scale | None
    """Colors of the signed distances."""
    iterations: int
    """Steps of the solver on all points."""
    converged: bool
    """Whether the last step changed nothing that shows."""
    seed: int
    """Seed of everything random."""

    _nested = {"inputs": "[InputRecord]", "shared_noise": "SharedNoise", "minimum": "Extreme", "maximum": "Extreme", "touching": "[Touching]", "extent": "Extent", "histogram": "Histogram", "scale": "Scale"}
