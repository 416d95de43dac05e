"""Deviations of points from a mesh or a CAD model, and what is told of them."""

# What matplotlib says of its types is incomplete.
# pyright: reportUnknownMemberType=false

from __future__ import annotations

import json
import os
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from . import _trueness
from ._document import Verdict, row
from ._errors import UsageError
from ._geometry import Cloud, Floats, Mesh, Model, Reference, Sign, Tolerance
from ._progress import Progress, callback

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

    from .documents._common import Histogram
    from .documents.compare import BySide, CompareDocument

#: Files of points that hold the deviations.
POINT_FILES = (".csv", ".ply", ".parquet", ".npz", ".vtp", ".xyz", ".txt")


class Capsule(Protocol):
    """A PyCapsule of the Arrow C data interface."""


class Deviation:
    """Deviations of points, in their order.

    Attributes
    ----------
    values : (n,) float64, read-only
        Millimeters, positive outside. NaN where the point is not finite, or is on a boundary edge that was to be skipped;
        infinite beyond `max_distance`.
    points : (n, 3) float64
        The measured points; not a copy.
    tolerance : (lower, upper) or None
    sign_method, sign_reason : str
        How inside and outside were told apart, and why so.
    """

    def __init__(
        self,
        reference: Reference[_trueness.Mesh | _trueness.Model],
        points: Floats,
        *,
        tolerance: Tolerance | None = None,
        sign: Sign = "auto",
        max_distance: float = np.inf,
        skip_boundary: bool = False,
        progress: Progress = None,
    ) -> None:
        self.reference = reference
        self.points = points
        self.tolerance = _limits(tolerance)
        self._asked = (sign, max_distance, skip_boundary)
        told = callback(progress)
        self.values: Floats = reference._core.deviations(points, sign, max_distance, skip_boundary, told)
        self.values.setflags(write=False)
        self.sign_method, self.sign_reason = reference.sign_method(sign)

    def __len__(self) -> int:
        return len(self.values)

    def __array__(self, dtype: np.dtype[np.float64] | None = None, copy: bool | None = None) -> Floats:
        return np.array(self.values, dtype, copy=copy) if copy else np.asarray(self.values, dtype)

    @cached_property
    def counts(self) -> dict[str, int]:
        """Numbers of points: all, those measured, and the others by reason."""
        finite = np.isfinite(self.points).all(axis=1)
        nan = np.isnan(self.values)
        counts = {
            "points": len(self.values),
            "measured": int(np.isfinite(self.values).sum()),
            "not_finite": int((~finite).sum()),
            "max_distance": int(np.isinf(self.values).sum()),
            "free_edge": int((nan & finite).sum()),
        }
        return counts

    @cached_property
    def statistics(self) -> BySide:
        """Statistics of all deviations, the positive and the negative ones: the same as in the document."""
        from .documents.compare import BySide

        return BySide(json.loads(_trueness.statistics(self.values)))

    def within(self, lower: float, upper: float | None = None) -> float:
        """Share of the measured points within ±`lower`, or from `lower` to `upper`; NaN where nothing was measured.

        Examples
        --------
        >>> import trueness as t
        >>> cube = t.read("corpus/shapes/trimesh__unit_cube.STL")
        >>> cube.deviation([[0, 0, 0.55], [0, 0, 0.7]]).within(0.1)
        0.5
        """
        low, high = (-lower, lower) if upper is None else (lower, upper)
        measured = self.values[np.isfinite(self.values)]
        return float(np.mean((measured >= low) & (measured <= high))) if len(measured) else float("nan")

    @cached_property
    def document(self) -> CompareDocument:
        """The document of ``trueness compare`` with these points and this reference.

        It is made at the first look, from the points as they are then; points that have changed since are an error.
        """
        return self._compare(view=False)

    def _compare(self, *, view: bool, out: str | os.PathLike[str] | None = None) -> CompareDocument:
        from .tasks import compare

        finite = np.isfinite(self.points).all(axis=1)
        points = self.points if finite.all() else self.points[finite]
        sign, max_distance, skip_boundary = self._asked
        found = compare(
            Cloud(points),
            _source(self.reference),
            tolerance=self.tolerance,
            sign=sign,
            max_distance=None if np.isinf(max_distance) else max_distance,
            skip_boundary=skip_boundary,
            out=out,
            view=view,
        )
        if found.comparisons[0].deviation != self.statistics:
            raise UsageError("points: they have changed since they were measured; call deviation again")
        return found

    @property
    def histogram(self) -> Histogram | None:
        """Edges and counts, as in the document."""
        return self.document.comparisons[0].histogram

    @property
    def verdict(self) -> Verdict | None:
        """The verdict of the document; None without a tolerance."""
        return self.document.verdict

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the report (``.html``), the document (``.json``), or points with their deviations (``.csv``, ``.ply``,
        ``.parquet``, ``.npz``, ``.vtp``; points that are not finite are left out).
        """
        ending = os.path.splitext(path)[1].lower()
        if ending == ".json":
            self.document.save(path)
        elif ending in (".html", ".htm"):
            self._compare(view=True).save(path)
        elif ending in POINT_FILES:
            self._compare(view=False, out=path)
        else:
            raise UsageError(f"{os.fspath(path)}: the ending must be .html, .json or one of {', '.join(POINT_FILES)}")

    def to_pandas(self) -> pandas.DataFrame:
        """A table of x, y, z and deviation, one row for each point."""
        import pandas

        x, y, z = self.points.T
        return pandas.DataFrame({"x": x, "y": y, "z": z, "deviation": self.values})

    def columns(self) -> dict[str, NDArray[np.float64]]:
        """The columns of the table: x, y, z and deviation."""
        x, y, z = self.points.T
        return {"x": x, "y": y, "z": z, "deviation": self.values}

    def __arrow_c_array__(self, requested_schema: object = None) -> tuple[Capsule, Capsule]:
        """The table for Arrow, pandas, Polars, DuckDB and others, by the Arrow PyCapsule interface."""
        columns = {name: np.ascontiguousarray(column) for name, column in self.columns().items()}
        return _trueness.arrow(list(columns), list(columns.values()))

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the histogram, with the tolerance, by matplotlib."""
        if axes is None:
            import matplotlib.pyplot as plt

            axes = plt.gca()
        found = self.histogram
        if found is not None:
            axes.stairs(found.counts, found.edges, fill=True)
        for limit in self.tolerance or ():
            axes.axvline(limit, color="black", linestyle="--")
        axes.set_xlabel("deviation, mm")
        axes.set_ylabel("points")
        return axes

    def __repr__(self) -> str:
        counts = self.counts
        rms = self.statistics.all.rms
        return f"Deviation({counts['measured']} of {counts['points']} points, rms {'–' if rms is None else f'{rms:.4g}'} mm)"

    def _repr_html_(self) -> str:
        own = self.statistics.all
        named = {"mean": own.mean, "rms": own.rms, "σ": own.std_dev, "min": own.min, "max": own.max}
        rows = "".join(row(f"{name}, mm", "–" if value is None else f"{value:.4f}") for name, value in named.items())
        rows = row("points", f"{self.counts['measured']} of {self.counts['points']}") + rows + row("sign", self.sign_method)
        table = f"<table>{rows}</table>"
        text = "<small>{} bytes; <code>save(&quot;map.html&quot;)</code> writes a page of up to 10 MB</small>"
        return table + text.format(len(table.encode()))


def _source(reference: object) -> Mesh | Model:
    if isinstance(reference, (Mesh, Model)):
        return reference
    raise UsageError("reference: give a Mesh or a Model")


def _limits(tolerance: Tolerance | None) -> tuple[float, float] | None:
    if tolerance is None:
        return None
    if isinstance(tolerance, str):
        parts = [float(part) for part in tolerance.split(",")]
    elif isinstance(tolerance, (int, float)):
        parts = [float(tolerance)]
    else:
        parts = [float(part) for part in tolerance]
    if len(parts) == 1:
        parts = [-parts[0], parts[0]]
    if len(parts) != 2 or not parts[0] < parts[1]:
        raise UsageError(f"tolerance: {tolerance!r} is no zone; give 0.1 for ±0.1, or (-0.1, 0.2)")
    return parts[0], parts[1]
