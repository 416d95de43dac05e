"""The names of `open3d.t.geometry.RaycastingScene`, with its sign: negative inside, positive outside.

Answers are NumPy arrays of double precision where Open3D has tensors of single precision. Open3D itself is not imported.
"""

from __future__ import annotations

from typing import Protocol, TypedDict, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._errors import UsageError
from .._geometry import Floats, Mesh


@runtime_checkable
class Tensor(Protocol):
    """A tensor of Open3D."""

    def numpy(self) -> NDArray[np.float32]: ...


class ClosestPoints(TypedDict):
    """What `RaycastingScene.compute_closest_points` answers."""

    points: Floats
    geometry_ids: NDArray[np.uint32]
    primitive_ids: NDArray[np.uint32]
    primitive_uvs: Floats
    primitive_normals: Floats


class RaycastingScene:
    """One or several meshes that points are measured from.

    Examples
    --------
    >>> import trueness as t
    >>> from trueness.compat.open3d import RaycastingScene
    >>> scene = RaycastingScene()
    >>> scene.add_triangles(t.read("corpus/shapes/trimesh__unit_cube.STL"))
    0
    >>> scene.compute_signed_distance([[0, 0, 0], [0, 0, 2]])
    array([-0.5,  1.5])
    """

    INVALID_ID = 0xFFFFFFFF

    def __init__(self) -> None:
        self._meshes: list[Mesh] = []
        self._all: Mesh | None = None

    def add_triangles(
        self, mesh_or_positions: Mesh | ArrayLike | Tensor, triangles: ArrayLike | Tensor | None = None
    ) -> int:
        """Adds a mesh, or vertices and triangles; its number."""
        if isinstance(mesh_or_positions, Mesh):
            mesh = mesh_or_positions
        elif triangles is not None:
            mesh = Mesh(_array(mesh_or_positions), np.asarray(_array(triangles), np.int64))
        else:
            raise UsageError("triangles: give vertices and triangles, or a trueness.Mesh")
        self._meshes.append(mesh)
        self._all = None
        return len(self._meshes) - 1

    def _mesh(self) -> Mesh:
        if self._all is None:
            if not self._meshes:
                raise UsageError("the scene is empty; add_triangles first")
            starts = np.cumsum([0, *(len(mesh.vertices) for mesh in self._meshes)])
            faces = [mesh.faces.astype(np.int64) + start for mesh, start in zip(self._meshes, starts, strict=False)]
            whole = len(self._meshes) == 1
            self._all = self._meshes[0] if whole else Mesh(np.concatenate([m.vertices for m in self._meshes]), np.concatenate(faces))
        return self._all

    def compute_distance(self, query_points: ArrayLike | Tensor) -> Floats:
        """Distances of points of shape (…, 3)."""
        points, shape = _rows(query_points)
        return self._mesh().closest(points).distance.reshape(shape)

    def compute_signed_distance(self, query_points: ArrayLike | Tensor) -> Floats:
        """Distances of points of shape (…, 3), negative inside."""
        points, shape = _rows(query_points)
        return self._mesh().signed_distance(points).reshape(shape)

    def compute_occupancy(self, query_points: ArrayLike | Tensor) -> Floats:
        """1 inside, 0 outside."""
        return (self.compute_signed_distance(query_points) < 0).astype(np.float64)

    def compute_closest_points(self, query_points: ArrayLike | Tensor) -> ClosestPoints:
        """The nearest places with their meshes, triangles, coordinates and normals."""
        points, shape = _rows(query_points)
        mesh = self._mesh()
        found = mesh.closest(points)
        is_found = found.facet >= 0
        starts = np.cumsum([0, *(len(mesh.faces) for mesh in self._meshes)])
        geometry = np.searchsorted(starts, found.facet, side="right") - 1
        primitive = found.facet - starts[np.maximum(geometry, 0)]
        a, b, c = (mesh.vertices[mesh.faces[found.facet, corner]] for corner in range(3))
        normals = np.cross(b - a, c - a)
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0)
        invalid = self.INVALID_ID
        return {
            "points": found.point.reshape(*shape, 3),
            "geometry_ids": np.where(is_found, geometry, invalid).astype(np.uint32).reshape(shape),
            "primitive_ids": np.where(is_found, primitive, invalid).astype(np.uint32).reshape(shape),
            "primitive_uvs": found.barycentric[:, 1:].reshape(*shape, 2),
            "primitive_normals": normals.reshape(*shape, 3),
        }


def _array(values: ArrayLike | Tensor) -> ArrayLike:
    return values.numpy() if isinstance(values, Tensor) else values


def _rows(points: ArrayLike | Tensor) -> tuple[Floats, tuple[int, ...]]:
    array = np.asarray(_array(points), np.float64)
    return array.reshape(-1, 3), array.shape[:-1]
