"""Distances against closed forms and brute force."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import rod_distance
from numpy.typing import NDArray

import trueness as t


def brute(mesh: t.Mesh, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The least distance over all facets (Ericson, Real-Time Collision Detection, 5.1.5, as minima over edges and plane)."""
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    least = np.full(len(points), np.inf)
    for i, p in enumerate(points):
        own = np.inf
        for start, end in ((a, b), (b, c), (c, a)):
            along = end - start
            share = np.clip(((p - start) * along).sum(1) / (along * along).sum(1), 0, 1)
            own = min(own, np.linalg.norm(start + share[:, None] * along - p, axis=1).min())
        normal = np.cross(b - a, c - a)
        height = ((p - a) * normal).sum(1) / (normal * normal).sum(1)
        foot = p - height[:, None] * normal
        sides = [(np.cross(e - s, foot - s) * normal).sum(1) >= 0 for s, e in ((a, b), (b, c), (c, a))]
        within = np.logical_and.reduce(sides)
        if within.any():
            own = min(own, np.linalg.norm(foot[within] - p, axis=1).min())
        least[i] = own
    return least


def test_closest_is_that_of_brute_force(bunny: t.Mesh, points: NDArray[np.float64]) -> None:
    found = bunny.closest(points[:100])
    np.testing.assert_allclose(found.distance, brute(bunny, points[:100]), rtol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(points[:100] - found.point, axis=1), found.distance, rtol=1e-12)
    corners = bunny.vertices[bunny.faces[found.facet]]
    np.testing.assert_allclose((found.barycentric[:, :, None] * corners).sum(1), found.point, atol=1e-12)
    np.testing.assert_allclose(found.barycentric.sum(1), 1)


def test_a_cube_in_closed_form(cube: t.Mesh) -> None:
    points = np.random.default_rng(1).uniform(-2, 2, (4000, 3))
    out = np.abs(points) - 0.5
    expected = np.linalg.norm(np.maximum(out, 0), axis=1) + np.minimum(out.max(axis=1), 0)
    np.testing.assert_allclose(cube.signed_distance(points), expected, atol=1e-15)
    np.testing.assert_allclose(cube.signed_distance(points, sign="winding"), expected, atol=1e-15)
    np.testing.assert_allclose(cube.signed_distance(points, sign="none"), np.abs(expected), atol=1e-15)
    near = cube.signed_distance(points, max_distance=1)
    np.testing.assert_array_equal(np.isinf(near), np.abs(expected) > 1)


def test_a_rod_in_closed_form(rod: t.Model) -> None:
    points = np.random.default_rng(2).uniform(-4, 6, (2000, 3))
    expected = rod_distance(points)
    np.testing.assert_allclose(rod.signed_distance(points), expected, atol=1e-12)
    np.testing.assert_allclose(rod.signed_distance(points, sign="none"), np.abs(expected), atol=1e-12)
    found = rod.closest(points)
    np.testing.assert_allclose(found.distance, np.abs(expected), atol=1e-12)
    np.testing.assert_allclose(rod_distance(found.point), 0, atol=1e-12)
    assert {rod.faces[face][1] for face in found.face} == {"AROUND", "BELOW", "ABOVE"}
    # Facets are off by their chords; the faces are not.
    assert 1e-6 < np.abs(rod.mesh.signed_distance(points) - expected).max() < 2 * rod.drawn_within
    with pytest.raises(ValueError, match="sign: ‘winding’ is for meshes"):
        rod.signed_distance(points, sign="winding")


def test_points_that_are_not_finite(cube: t.Mesh, rod: t.Model) -> None:
    points = np.array([[0, 0, 2], [np.nan, 0, 0], [0, 0, 0], [0, np.inf, 0], [0, 0, -2.0]])
    bad = [False, True, False, True, False]
    np.testing.assert_array_equal(cube.signed_distance(points), [1.5, np.nan, -0.5, np.nan, 1.5])
    found = cube.closest(points)
    np.testing.assert_array_equal(np.isnan(found.distance), bad)
    np.testing.assert_array_equal(found.facet == -1, bad)
    np.testing.assert_array_equal(np.isnan(found.point).all(1), bad)
    np.testing.assert_array_equal(np.isnan(rod.signed_distance(points)), bad)
    np.testing.assert_array_equal(rod.closest(points).face == -1, bad)
    deviation = cube.deviation(points, max_distance=1)
    assert deviation.counts == {"points": 5, "measured": 1, "not_finite": 2, "max_distance": 2, "free_edge": 0}


def test_blocks_do_not_show(cube: t.Mesh) -> None:
    points = np.random.default_rng(3).uniform(-2, 2, ((1 << 20) + 5, 3))
    points[-1] = [0, 0, 3]
    values = cube.signed_distance(points)
    assert values[-1] == 2.5
    np.testing.assert_array_equal(values[-5:], cube.signed_distance(points[-5:]))
    points[-2, 0] = 1e300
    with pytest.raises(ValueError, match=f"points, row {len(points) - 2}"):
        cube.signed_distance(points)


def test_properties(cube: t.Mesh, bunny: t.Mesh) -> None:
    assert cube.is_closed and cube.is_watertight and cube.is_sound
    assert not bunny.is_closed and not bunny.is_sound
    assert cube.sign_method() == ("pseudonormal", cube.sign_method()[1])
    assert bunny.sign_method("none")[0] == "none"
    np.testing.assert_array_equal(cube.bounds, [[-0.5] * 3, [0.5] * 3])
    assert repr(bunny) == "Mesh(453 vertices, 948 facets)" and len(bunny) == 948
