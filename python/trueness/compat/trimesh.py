"""The names of `trimesh.proximity`, with its sign: positive inside, negative outside.

Replace ``from trimesh import proximity`` by ``from trueness.compat import trimesh as proximity``. Meshes may be those of trimesh or
of this package. trimesh itself is not imported.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._geometry import Floats, Mesh


class HasFaces(Protocol):
    """Vertices and faces: a `trimesh.Trimesh`, say."""

    @property
    def vertices(self) -> ArrayLike: ...
    @property
    def faces(self) -> ArrayLike: ...


def _mesh(mesh: Mesh | HasFaces) -> Mesh:
    return mesh if isinstance(mesh, Mesh) else Mesh(mesh.vertices, np.asarray(mesh.faces, np.int64))


class ProximityQuery:
    """Questions about one mesh, whose search tree is kept.

    Examples
    --------
    >>> import trueness as t
    >>> from trueness.compat.trimesh import ProximityQuery
    >>> query = ProximityQuery(t.read("corpus/shapes/trimesh__unit_cube.STL"))
    >>> query.signed_distance([[0, 0, 0], [0, 0, 2]])
    array([ 0.5, -1.5])
    """

    def __init__(self, mesh: Mesh | HasFaces) -> None:
        self._mesh = _mesh(mesh)

    def on_surface(self, points: ArrayLike) -> tuple[Floats, Floats, NDArray[np.int64]]:
        """The nearest places (n, 3), their distances (n,) and their triangles (n,)."""
        found = self._mesh.closest(points)
        return found.point, found.distance, found.facet

    def signed_distance(self, points: ArrayLike) -> Floats:
        """Distances (n,): positive inside, negative outside."""
        return -self._mesh.signed_distance(points)

    def vertex(self, points: ArrayLike) -> tuple[Floats, NDArray[np.int64]]:
        """Distances (n,) of the nearest vertices, and their numbers (n,)."""
        vertices = self._mesh.vertices
        number = np.arange(len(vertices))
        # A vertex is a facet without extent: where all three corners are one.
        found = Mesh(vertices, np.stack([number, number, number], axis=1)).closest(points)
        return found.distance, found.facet


def closest_point(mesh: Mesh | HasFaces, points: ArrayLike) -> tuple[Floats, Floats, NDArray[np.int64]]:
    """The nearest places (n, 3), their distances (n,) and their triangles (n,)."""
    return ProximityQuery(mesh).on_surface(points)


def signed_distance(mesh: Mesh | HasFaces, points: ArrayLike) -> Floats:
    """Distances (n,): positive inside, negative outside."""
    return ProximityQuery(mesh).signed_distance(points)


def contains(mesh: Mesh | HasFaces, points: ArrayLike) -> NDArray[np.bool_]:
    """Whether points are inside, as ``trimesh.Trimesh.contains``."""
    return _mesh(mesh).signed_distance(points) < 0
