"""The document of `trend`.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from typing import Literal

from .._document import Record, TaskDocument
from ._common import (
    Counts as Counts,
    Histogram as Histogram,
    Scale as Scale,
    Statistics as Statistics,
)


class ResultInput(Record):
    """A result document that was read."""
    path: str
    """As given on the command line."""
    format: str
    """Its schema."""
    bytes: int
    """Size of the file."""
    sha256: str | None
    """SHA-256 of its bytes, hexadecimal."""
    unit_assumed: str
    """Always `mm`: documents are in millimeters."""


class PartRecord(Record):
    """A part."""
    name: str
    """Its first measured file; where results name none, or several the same one, the result."""
    verdict: Literal["fail", "not_measured", "pass", "undecided"]
    """Its verdict."""
    deviation: Literal["fail", "not_measured", "pass", "undecided"] | None
    """That on its deviations from the reference; absent where they were not judged."""


class TrendRecord(Record):
    """A characteristic over all parts."""
    id: str
    """Its name."""
    kind: str
    """What it is."""
    symbol: str
    """Its sign on drawings, where it has one."""
    feature: str
    """The toleranced feature."""
    datums: list[str]
    """The datums."""
    unit: str
    """Unit of the values: `mm`, `deg`, `1` or `%`."""
    nominal: float | None
    """Nominal value of a dimension."""
    lower: float | None
    """Least allowed value of a dimension."""
    upper: float | None
    """Greatest allowed value; null where a material requirement allows each part its own."""
    values: list[float | None]
    """Its value of each part; null where it was not measured."""
    verdicts: list[Literal["pass", "fail", "undecided", "not_measured"]]
    """Its verdict on each part."""
    uncertainties: list[float | None] | None
    """Expanded uncertainty (k = 2) of each value; absent where no value has one."""
    intervals: list[list[float] | None] | None
    """From and to where the true value of each part lies: the `interval` of its result, or the value less and
    plus its uncertainty; absent where no value has one."""
    own_upper: list[float] | None
    """Greatest allowed value of each part, where a material requirement allows each its own; else absent."""
    counts: Counts
    """Number of parts by verdict."""
    measured: int
    """Number of values."""
    mean: float | None
    """Their mean."""
    min: float | None
    """Least value."""
    max: float | None
    """Greatest value."""
    std_dev: float | None
    """Standard deviation of all values."""
    std_dev_within: float | None
    """Standard deviation within: by the moving ranges of two."""
    control: Control | None
    """Limits of the control charts of values and of moving ranges."""
    course_reason: str | None
    """Why there is no course: fewer than two values."""
    out_of_control: list[OutOfControl]
    """Parts that are out of control."""
    cp: IndexRecord | None
    """Tolerance over six standard deviations within; null of one limit."""
    cpk: IndexRecord | None
    """Distance of the mean from the nearer limit over three standard deviations within."""
    pp: IndexRecord | None
    """As `cp`, by the standard deviation of all values."""
    ppk: IndexRecord | None
    """As `cpk`, by the standard deviation of all values."""
    capability_reason: str | None
    """Why some or all of these are missing."""

    _nested = {"counts": "Counts", "control": "Control", "out_of_control": "[OutOfControl]", "cp": "IndexRecord", "cpk": "IndexRecord", "pp": "IndexRecord", "ppk": "IndexRecord"}


class Control(Record):
    """Limits of the control charts of individuals and moving ranges (ISO 7870-2)."""
    lower: float
    """Lower control limit of values."""
    center: float
    """Their mean."""
    upper: float
    """Upper control limit of values."""
    moving_range: float
    """Mean moving range."""
    moving_range_upper: float
    """Upper control limit of moving ranges."""


class OutOfControl(Record):
    """A part that is out of control."""
    part: int
    """Its number, from 0."""
    rule: Literal["beyond", "range", "run", "steady"]
    """By which rule: `beyond`, `range`, `run` (nine on one side of the mean) or `steady` (six rising or
    falling)."""


class IndexRecord(Record):
    """An index of capability with its confidence interval."""
    value: float
    """The estimate."""
    low: float
    """Lower end of the interval."""
    high: float
    """Upper end."""


class TrendMap(Record):
    """Mean and spread of the deviations over all parts, place by place."""
    places: list[list[float]]
    """Where the places are, mm."""
    facets: list[list[int]]
    """The surface between them, as in the results."""
    parts: list[int]
    """Number of parts with a value at each place."""
    mean: list[float | None]
    """Mean of these; null where there is none."""
    std_dev: list[float | None]
    """Their standard deviation, divided by their number less 1; null where fewer than two parts have a
    value."""
    complete: int
    """Places where every part has a value: what statistics and colors are of."""
    partial: int
    """Places where some parts have a value and some have none."""
    without: int
    """Places where no part has a value."""
    means: MapQuantity
    """Of the means, over the complete places, each counting once."""
    std_devs: MapQuantity
    """Of the standard deviations."""

    _nested = {"means": "MapQuantity", "std_devs": "MapQuantity"}


class MapQuantity(Record):
    """One of the two over the complete places."""
    statistics: Statistics
    """Over the places."""
    histogram: Histogram | None
    """Counts of the values."""
    greatest: MapPlace | None
    """Where the size is greatest, of the places with a facet whose corners all have a value in every part, as
    others are gray; absent where there is none."""
    scale: Scale
    """Its colors."""

    _nested = {"statistics": "Statistics", "histogram": "Histogram", "greatest": "MapPlace", "scale": "Scale"}


class MapPlace(Record):
    """A place with its value."""
    index: int
    """Its number, from 0."""
    position: list[float]
    """Where it is, mm."""
    value: float
    """The value there."""


class TrendDocument(TaskDocument):
    """The whole document. Values in millimeters, of angles in degrees."""
    schema: str
    """`trueness/trend/1`."""
    version: str
    """Version of the program."""
    units: str
    """Always `mm`."""
    title: str | None
    """The plan's heading."""
    inputs: list[ResultInput]
    """The results read, in the order given: the order of the parts."""
    parts: list[PartRecord]
    """The parts, in the same order."""
    warnings: list[str]
    """What makes the results doubtful as results of one plan."""
    confidence: float
    """Confidence of the intervals: 0.95."""
    characteristics: list[TrendRecord]
    """The characteristics, in the plan's order; then, where deviations from the reference are judged, the
    shares of points within tolerance, of kind `deviation` and in percent: of each region, then of all other
    points."""
    map: TrendMap | None
    """Mean and spread of the deviations over the part."""
    map_reason: str | None
    """Why there is none: results without deviations at places."""
    in_control: bool
    """Whether no value of any characteristic is out of control."""

    _nested = {"inputs": "[ResultInput]", "parts": "[PartRecord]", "characteristics": "[TrendRecord]", "map": "TrendMap"}
