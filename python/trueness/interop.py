"""To and from the objects of other packages. None of them is imported before a function that needs it is called.

pandas, Polars, Arrow and DuckDB take a `trueness.Deviation` by the Arrow PyCapsule interface: ``pyarrow.record_batch(found)``,
``polars.DataFrame(found)``.
"""

# What other packages say of their types is incomplete.
# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
# pyright: reportMissingImports=false, reportUnknownParameterType=false

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import UsageError
from ._geometry import Cloud, Mesh

if TYPE_CHECKING:
    import meshio
    import open3d
    import pyvista
    import trimesh


def to_trimesh(mesh: Mesh) -> trimesh.Trimesh:
    """A `trimesh.Trimesh` of the same vertices and faces, which are not merged or reordered."""
    import trimesh

    return trimesh.Trimesh(np.array(mesh.vertices), mesh.faces.astype(np.int64), process=False, validate=False)


def from_trimesh(mesh: trimesh.Trimesh | trimesh.PointCloud) -> Mesh | Cloud:
    """A `trimesh.Trimesh`, or a `trimesh.PointCloud`."""
    vertices: NDArray[np.float64] = np.asarray(mesh.vertices, np.float64)
    faces = getattr(mesh, "faces", None)
    return Cloud(vertices) if faces is None else Mesh(vertices, np.asarray(faces, np.int64))


def to_open3d(part: Mesh | Cloud) -> open3d.geometry.TriangleMesh | open3d.geometry.PointCloud:
    """An `open3d.geometry.TriangleMesh`, or a `PointCloud` with its normals; both hold double precision."""
    import open3d

    vector = open3d.utility.Vector3dVector
    if isinstance(part, Mesh):
        faces = open3d.utility.Vector3iVector(part.faces.astype(np.int32))
        return open3d.geometry.TriangleMesh(vector(np.array(part.vertices)), faces)
    cloud = open3d.geometry.PointCloud(vector(np.array(part.points)))
    if part.normals is not None:
        cloud.normals = vector(part.normals)
    return cloud


def from_open3d(part: open3d.geometry.TriangleMesh | open3d.geometry.PointCloud) -> Mesh | Cloud:
    """An `open3d.geometry.TriangleMesh` or `PointCloud`."""
    values: Callable[[str], NDArray[np.float64]] = lambda name: np.asarray(getattr(part, name), np.float64)
    if hasattr(part, "triangles"):
        return Mesh(values("vertices"), np.asarray(getattr(part, "triangles"), np.int64))
    normals = values("normals")
    return Cloud(values("points"), normals if len(normals) else None)


def to_pyvista(part: Mesh | Cloud, **values: ArrayLike) -> pyvista.PolyData:
    """A `pyvista.PolyData`; `values` become arrays of its points, as ``deviation=found.values``."""
    import pyvista

    if isinstance(part, Mesh):
        faces = np.hstack([np.full((len(part.faces), 1), 3, np.int64), part.faces.astype(np.int64)])
        made = pyvista.PolyData(np.array(part.vertices), faces.ravel())
    else:
        made = pyvista.PolyData(np.array(part.points))
    for name, value in values.items():
        made.point_data[name] = np.asarray(value)
    return made


def from_pyvista(data: pyvista.PolyData) -> Mesh | Cloud:
    """A `pyvista.PolyData` of triangles, or of points alone."""
    points = np.asarray(data.points, np.float64)
    faces: NDArray[np.int64] = np.asarray(data.faces, np.int64)
    if len(faces) == 0:
        return Cloud(points)
    if not data.is_all_triangles:
        raise UsageError("it has faces of other than three corners; call triangulate() first")
    return Mesh(points, faces.reshape(-1, 4)[:, 1:])


def to_meshio(part: Mesh | Cloud) -> meshio.Mesh:
    """A `meshio.Mesh` of triangles, or of vertices."""
    import meshio

    if isinstance(part, Mesh):
        return meshio.Mesh(np.array(part.vertices), [("triangle", part.faces.astype(np.int64))])
    return meshio.Mesh(np.array(part.points), [("vertex", np.arange(len(part.points)).reshape(-1, 1))])


def from_meshio(mesh: meshio.Mesh) -> Mesh | Cloud:
    """The triangles of a `meshio.Mesh`; its points where it has none."""
    blocks: list[NDArray[np.int64]] = [np.asarray(b.data, np.int64) for b in mesh.cells if b.type == "triangle"]
    points = np.asarray(mesh.points, np.float64)
    return Mesh(points, np.concatenate(blocks)) if blocks else Cloud(points)
