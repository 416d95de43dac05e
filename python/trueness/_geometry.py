"""Meshes, clouds and CAD models."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Generic, Literal, NamedTuple, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _ply, _trueness
from ._errors import UsageError
from ._progress import Progress, callback

if TYPE_CHECKING:
    from ._deviation import Deviation

Floats: TypeAlias = NDArray[np.float64]
Sign: TypeAlias = Literal["auto", "pseudonormal", "winding", "none"]
Tolerance: TypeAlias = "float | tuple[float, float] | Sequence[float] | str"


class Closest(NamedTuple):
    """The nearest places of a mesh, an array each, in the order of the points.

    Attributes
    ----------
    distance : (n,) float64
        Millimeters; NaN where a point is not finite or nothing is within `max_distance`.
    point : (n, 3) float64
        The nearest place.
    facet : (n,) int64
        Of several the lowest; -1 where there is none.
    barycentric : (n, 3) float64
        The weights of the facet's corners at that place.
    """

    distance: Floats
    point: Floats
    facet: NDArray[np.int64]
    barycentric: Floats


class ClosestOnModel(NamedTuple):
    """The nearest places of the faces of a CAD model, an array each, in the order of the points.

    Attributes
    ----------
    distance : (n,) float64
        Millimeters; NaN where a point is not finite.
    point : (n, 3) float64
        The nearest place.
    face : (n,) int64
        The number of the face, an index of ``model.faces``; -1 where there is none.
    """

    distance: Floats
    point: Floats
    face: NDArray[np.int64]


Core = TypeVar("Core", bound="_trueness.Mesh | _trueness.Model", covariant=True)


class Reference(Generic[Core]):
    """What points are measured from."""

    _core: Core

    def signed_distance(
        self,
        points: ArrayLike,
        *,
        sign: Sign = "auto",
        max_distance: float = np.inf,
        skip_boundary: bool = False,
        progress: Progress = None,
    ) -> Floats:
        """Signed distances of points, positive outside.

        Parameters
        ----------
        points : (n, 3) array of real numbers
            Millimeters. C-contiguous float64 is not copied.
        sign : {"auto", "pseudonormal", "winding", "none"}
            How inside and outside are told apart; ``auto`` takes the method that is valid for this reference.
        max_distance : float
            Points farther than this are infinite.
        skip_boundary : bool
            Points whose nearest place is on a boundary edge are NaN.
        progress : callable or bool, optional
            Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

        Returns
        -------
        (n,) float64
            NaN also where a point is not finite.

        Examples
        --------
        >>> import trueness as t
        >>> cube = t.read("corpus/shapes/trimesh__unit_cube.STL")
        >>> cube.signed_distance([[0, 0, 0], [0, 0, 2]])
        array([-0.5,  1.5])
        """
        return self._core.deviations(points, sign, max_distance, skip_boundary, callback(progress))

    def deviation(
        self,
        points: ArrayLike | Cloud | Mesh,
        tolerance: Tolerance | None = None,
        *,
        sign: Sign = "auto",
        max_distance: float = np.inf,
        skip_boundary: bool = False,
        progress: Progress = None,
    ) -> Deviation:
        """Deviations of points with all that is told of them: statistics, verdict, document, report.

        Parameters
        ----------
        points : (n, 3) array, Cloud or Mesh
            The measured points, millimeters; of a mesh its vertices.
        tolerance : float or (lower, upper), optional
            Allowed deviation, ``0.1`` for ±0.1; the document then has a verdict.
        sign, max_distance, skip_boundary, progress
            As for `signed_distance`.

        Examples
        --------
        >>> import trueness as t
        >>> cube = t.read("corpus/shapes/trimesh__unit_cube.STL")
        >>> found = cube.deviation([[0, 0, 0.52], [0, 0, 0.7]], tolerance=0.1)
        >>> found.values.round(6)
        array([0.02, 0.2 ])
        >>> found.within(0.1), found.verdict  # two points cover too little of the cube
        (0.5, 'undecided')
        """
        from ._deviation import Deviation

        return Deviation(
            self,
            points_of(points),
            tolerance=tolerance,
            sign=sign,
            max_distance=max_distance,
            skip_boundary=skip_boundary,
            progress=progress,
        )

    def sign_method(self, sign: Sign = "auto") -> tuple[str, str]:
        """The method by which inside and outside are told apart, and why it is that one."""
        raise NotImplementedError


class Mesh(Reference[_trueness.Mesh]):
    """A triangle mesh, millimeters. It never changes; its search tree is built at the first question and kept.

    Parameters
    ----------
    vertices : (v, 3) array of real numbers
    faces : (f, 3) array of whole numbers
        Rows of `vertices`, counter-clockwise seen from outside.

    Examples
    --------
    >>> import trueness as t
    >>> mesh = t.Mesh([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[0, 1, 2]])
    >>> mesh.closest([[1, 2, 5]]).distance
    array([5.])
    """

    def __init__(self, vertices: ArrayLike, faces: ArrayLike) -> None:
        self._core = _trueness.Mesh(vertices, faces)
        self.warnings: list[str] = []

    @classmethod
    def _of(cls, core: _trueness.Mesh, warnings: list[str]) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._core, mesh.warnings = core, warnings
        return mesh

    @property
    def vertices(self) -> Floats:
        """(v, 3) float64, a view that cannot be written to."""
        return self._core.vertices

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(f, 3) uint32, a view that cannot be written to."""
        return self._core.faces

    @property
    def bounds(self) -> Floats:
        """(2, 3) float64: the least and the greatest coordinates of vertices that are finite."""
        return bounds(self.vertices)

    @property
    def is_closed(self) -> bool:
        """Whether it has no boundary edge."""
        return self._core.soundness()[0]

    @property
    def is_watertight(self) -> bool:
        """The same by the name that others have for it: closed, and consistently oriented."""
        closed, oriented, _ = self._core.soundness()
        return closed and oriented

    @property
    def is_sound(self) -> bool:
        """Whether distances from it have signs beyond doubt: closed, oriented, manifold. `trueness.check` finds what is wrong."""
        return self._core.soundness()[2]

    def sign_method(self, sign: Sign = "auto") -> tuple[str, str]:
        """The method by which inside and outside are told apart, and why it is that one."""
        return self._core.sign(sign)

    def closest(
        self, points: ArrayLike, *, max_distance: float = np.inf, progress: Progress = None
    ) -> Closest:
        """The nearest place of the mesh for each point, exactly.

        Parameters
        ----------
        points : (n, 3) array of real numbers
            Millimeters. C-contiguous float64 is not copied.
        max_distance : float
            Farther points have no place.

        Examples
        --------
        >>> import trueness as t
        >>> cube = t.read("corpus/shapes/trimesh__unit_cube.STL")
        >>> found = cube.closest([[0, 0, 2]])
        >>> found.distance, found.point
        (array([1.5]), array([[0. , 0. , 0.5]]))
        """
        return Closest(*self._core.closest(points, max_distance, callback(progress)))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes it in the format of the path's ending: STL, PLY, OBJ, OFF and others."""
        from .tasks import convert

        convert(self, path)

    def _bytes(self) -> bytes:
        return _ply.mesh(self.vertices, self.faces)

    def __reduce__(self) -> tuple[type[Mesh], tuple[Floats, NDArray[np.uint32]]]:
        return Mesh, (self.vertices, self.faces)

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: object) -> Mesh:
        return self

    def __len__(self) -> int:
        return len(self.faces)

    def __repr__(self) -> str:
        return f"Mesh({len(self.vertices)} vertices, {len(self.faces)} facets)"


class Cloud:
    """Measured points without facets, millimeters.

    Parameters
    ----------
    points : (n, 3) array of real numbers
        C-contiguous float64 is not copied.
    normals : (n, 3) array of real numbers, optional

    Examples
    --------
    >>> import trueness as t
    >>> t.Cloud([[0, 0, 0], [1, 2, 3]])
    Cloud(2 points)
    """

    def __init__(self, points: ArrayLike, normals: ArrayLike | None = None) -> None:
        self.points: Floats = _rows("points", points)
        self.normals: Floats | None = None if normals is None else _rows("normals", normals)
        self.warnings: list[str] = []
        if self.normals is not None and len(self.normals) != len(self.points):
            raise UsageError(f"normals: there are {len(self.normals)} for {len(self.points)} points")

    @property
    def bounds(self) -> Floats:
        """(2, 3) float64: the least and the greatest coordinates of points that are finite."""
        return bounds(self.points)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes it in the format of the path's ending."""
        from .tasks import convert

        convert(self, path)

    def _bytes(self) -> bytes:
        return _ply.points(self.points, self.normals)

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        return f"Cloud({len(self.points)} points{', normals' if self.normals is not None else ''})"


class Model(Reference[_trueness.Model]):
    """A CAD model of a STEP or IGES file: distances are those of its exact faces.

    Parameters
    ----------
    path : path-like
    """

    def __init__(self, path: str | os.PathLike[str], *, progress: Progress = None) -> None:
        with open(path, "rb") as file:
            self._set(os.fspath(path), file.read(), progress)

    def _set(self, name: str, content: bytes, progress: Progress = None) -> None:
        self.name = name
        self._content = content
        self._core = _trueness.Model(name, content, callback(progress))

    @classmethod
    def _of(cls, name: str, content: bytes, progress: Progress = None) -> Model:
        model = cls.__new__(cls)
        model._set(name, content, progress)
        return model

    @property
    def faces(self) -> list[tuple[int, str]]:
        """For each face the number of its entity in the file, and its name."""
        return self._core.faces

    @property
    def warnings(self) -> list[str]:
        """What was odd about the file."""
        return self._core.warnings

    @property
    def drawn_within(self) -> float:
        """How far the facets of `mesh` lie from the faces at most, mm."""
        return self._core.drawn_within

    @property
    def mesh(self) -> Mesh:
        """The mesh that draws the faces. Distances do not come from it."""
        return Mesh._of(self._core.mesh, [])

    @property
    def bounds(self) -> Floats:
        """(2, 3) float64: the box of the mesh that draws it."""
        return bounds(self._core.mesh.vertices)

    def closest(self, points: ArrayLike, *, progress: Progress = None) -> ClosestOnModel:
        """The nearest place of the exact faces for each point."""
        return ClosestOnModel(*self._core.closest(points, callback(progress)))

    def sign_method(self, sign: Sign = "auto") -> tuple[str, str]:
        """The method by which inside and outside are told apart, and why it is that one."""
        if sign == "none":
            return "none", "asked for"
        return "normal", "the side of the faces' normals"

    def _bytes(self) -> bytes:
        return self._content

    def __reduce__(self) -> tuple[object, tuple[str, bytes]]:
        return Model._of, (self.name, self._content)

    def __copy__(self) -> Model:
        return self

    def __deepcopy__(self, memo: object) -> Model:
        return self

    def __repr__(self) -> str:
        return f"Model({len(self.faces)} faces)"


def read(
    path: str | os.PathLike[str],
    *,
    units: str | None = None,
    format: str | None = None,
    progress: Progress = None,
) -> Mesh | Cloud | Model:
    """Reads a mesh, points or a CAD model of any format.

    Parameters
    ----------
    path : path-like
        The format is told by the content; whatever is packed with gzip is unpacked.
    units : {"mm", "cm", "m", "in", "um"}, optional
        Unit of a file that does not say its own.
    format : str, optional
        Where the content does not tell it; ``trueness formats`` lists them.

    Returns
    -------
    Mesh, Cloud or Model
        Millimeters. Vertices at the same place are one. ``warnings`` says what was odd about the file.

    Raises
    ------
    OSError
        The file cannot be opened.
    TruenessError
        It cannot be read; the message names file, place and remedy.

    Examples
    --------
    >>> import trueness as t
    >>> t.read("corpus/bunny/zipper_res4.ply")
    Mesh(453 vertices, 948 facets)
    """
    import json

    taken = {name: value for name, value in (("units", units), ("format", format)) if value is not None}
    content, warnings = _trueness.read(path, json.dumps(taken), callback(progress))
    if isinstance(content, bytes):
        return Model._of(os.fspath(path), content, progress)
    if isinstance(content, _trueness.Mesh):
        return Mesh._of(content, warnings)
    cloud = Cloud(content)
    cloud.warnings = warnings
    return cloud


def points_of(points: ArrayLike | Cloud | Mesh) -> Floats:
    """The points of what has some."""
    if isinstance(points, Cloud):
        return points.points
    if isinstance(points, Mesh):
        return points.vertices
    return _rows("points", points)


def _rows(name: str, values: ArrayLike) -> Floats:
    """Rows of three real numbers; not copied where they are C-contiguous float64."""
    array = np.asarray(values)
    if array.shape == (0,):
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise UsageError(f"{name}: its shape is {array.shape}, give one of (n, 3)")
    if array.dtype.kind not in "fiu" and array.size:
        raise UsageError(f"{name}: it holds {array.dtype}, give real numbers")
    return np.require(array, np.float64, ["C", "A"])


def bounds(points: Floats) -> Floats:
    """The least and the greatest coordinates of the points that are finite; NaN without any."""
    finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) == 0:
        return np.full((2, 3), np.nan)
    return np.stack([finite.min(axis=0), finite.max(axis=0)])
