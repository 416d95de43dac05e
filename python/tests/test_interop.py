"""Other packages: their objects, their names and their signs, beside the packages themselves where they are installed."""

# What packages that are not installed have for types is unknown.
# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import trueness as t
from trueness.compat import open3d as as_open3d
from trueness.compat import trimesh as as_trimesh

Points = NDArray[np.float64]


def same(part: t.Mesh | t.Cloud, other: t.Mesh | t.Cloud) -> None:
    if isinstance(part, t.Mesh):
        assert isinstance(other, t.Mesh)
        np.testing.assert_array_equal(part.vertices, other.vertices)
        np.testing.assert_array_equal(part.faces, other.faces)
    else:
        assert isinstance(other, t.Cloud)
        np.testing.assert_array_equal(part.points, other.points)


def test_trimesh(bunny: t.Mesh, points: Points) -> None:
    trimesh: Any = pytest.importorskip("trimesh")
    same(bunny, t.from_trimesh(t.to_trimesh(bunny)))
    same(t.Cloud(points), t.from_trimesh(trimesh.PointCloud(points)))


def test_open3d(bunny: t.Mesh, points: Points) -> None:
    pytest.importorskip("open3d", exc_type=ImportError)
    same(bunny, t.from_open3d(t.to_open3d(bunny)))
    again = t.from_open3d(t.to_open3d(t.Cloud(points, points)))
    same(t.Cloud(points), again)
    assert isinstance(again, t.Cloud) and again.normals is not None


def test_pyvista(bunny: t.Mesh, points: Points) -> None:
    pytest.importorskip("pyvista")
    same(bunny, t.from_pyvista(t.to_pyvista(bunny)))
    data = t.to_pyvista(t.Cloud(points), deviation=bunny.signed_distance(points))
    np.testing.assert_array_equal(data.point_data["deviation"], bunny.signed_distance(points))


def test_meshio(bunny: t.Mesh, points: Points) -> None:
    pytest.importorskip("meshio")
    same(bunny, t.from_meshio(t.to_meshio(bunny)))
    same(t.Cloud(points), t.from_meshio(t.to_meshio(t.Cloud(points))))


def test_the_names_of_trimesh_by_themselves(cube: t.Mesh) -> None:
    points = np.array([[0, 0, 0], [0, 0, 2.0], [0.6, 0.7, 0.8]])
    np.testing.assert_allclose(as_trimesh.signed_distance(cube, points)[:2], [0.5, -1.5])
    place, distance, triangle = as_trimesh.closest_point(cube, points)
    np.testing.assert_allclose(place[1:], [[0, 0, 0.5], [0.5, 0.5, 0.5]])
    assert distance[1] == 1.5 and triangle.dtype == np.int64
    np.testing.assert_array_equal(as_trimesh.contains(cube, points), [True, False, False])
    far, vertex = as_trimesh.ProximityQuery(cube).vertex(points)
    expected = np.linalg.norm(points[:, None] - cube.vertices[None], axis=2)
    np.testing.assert_allclose(far, expected.min(axis=1))
    np.testing.assert_allclose(expected[np.arange(3), vertex], far)


def test_the_names_of_trimesh_beside_it(cube: t.Mesh) -> None:
    trimesh: Any = pytest.importorskip("trimesh")
    pytest.importorskip("rtree")
    theirs = t.to_trimesh(cube)
    points = np.random.default_rng(4).uniform(-1.5, 1.5, (300, 3))
    own = as_trimesh.ProximityQuery(theirs)
    other = trimesh.proximity.ProximityQuery(theirs)
    np.testing.assert_allclose(own.signed_distance(points), other.signed_distance(points), atol=1e-12)
    np.testing.assert_allclose(own.on_surface(points)[0], other.on_surface(points)[0], atol=1e-9)
    np.testing.assert_allclose(own.vertex(points)[0], other.vertex(points)[0], atol=1e-12)


def test_the_names_of_open3d_by_themselves(cube: t.Mesh) -> None:
    scene = as_open3d.RaycastingScene()
    assert scene.add_triangles(cube) == 0
    assert scene.add_triangles(cube.vertices + [10, 0, 0], cube.faces) == 1
    points = np.array([[[0, 0, 0], [0, 0, 2.0]], [[10, 0, 0.7], [10.1, 0, 0]]])
    np.testing.assert_allclose(scene.compute_signed_distance(points), [[-0.5, 1.5], [0.2, -0.4]])
    np.testing.assert_allclose(scene.compute_distance(points), [[0.5, 1.5], [0.2, 0.4]])
    np.testing.assert_array_equal(scene.compute_occupancy(points), [[1, 0], [0, 1]])
    found = scene.compute_closest_points(points)
    np.testing.assert_array_equal(found["geometry_ids"], [[0, 0], [1, 1]])
    assert found["points"].shape == (2, 2, 3) and found["primitive_ids"].max() < len(cube.faces)
    np.testing.assert_allclose(found["primitive_normals"][1], [[0, 0, 1], [1, 0, 0]])


def test_the_names_of_open3d_beside_it(bunny: t.Mesh) -> None:
    open3d: Any = pytest.importorskip("open3d", exc_type=ImportError)
    theirs, own = open3d.t.geometry.RaycastingScene(), as_open3d.RaycastingScene()
    mesh = open3d.t.geometry.TriangleMesh.from_legacy(t.to_open3d(bunny))
    theirs.add_triangles(mesh)
    own.add_triangles(mesh.vertex.positions, mesh.triangle.indices)
    points = np.random.default_rng(4).uniform(-50, 150, (200, 3)).astype(np.float32)
    np.testing.assert_allclose(own.compute_distance(points), theirs.compute_distance(points).numpy(), rtol=1e-4, atol=1e-3)
    ours, answers = own.compute_closest_points(points), theirs.compute_closest_points(points)
    np.testing.assert_allclose(ours["points"], answers["points"].numpy(), atol=2e-2)
    equal = ours["primitive_ids"] == answers["primitive_ids"].numpy()
    np.testing.assert_allclose(ours["primitive_uvs"][equal], answers["primitive_uvs"].numpy()[equal], atol=1e-3)
