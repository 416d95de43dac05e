"""NumPy in and out: what is copied, what is accepted, what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import trueness as t
from trueness import _trueness


def test_double_precision_is_not_copied(points: NDArray[np.float64]) -> None:
    assert _trueness.address(points) == points.ctypes.data
    points.setflags(write=False)
    assert _trueness.address(points) == points.ctypes.data
    assert _trueness.address(points[100:]) == points.ctypes.data + 100 * 24
    assert t.Cloud(points).points is points


def test_a_view_of_a_mesh_is_its_memory_and_lives_on(bunny: t.Mesh) -> None:
    vertices = bunny.vertices
    assert vertices.ctypes.data == bunny.vertices.ctypes.data
    assert not vertices.flags.writeable and not bunny.faces.flags.writeable
    expected = vertices.copy()
    del bunny
    np.testing.assert_array_equal(vertices, expected)


@pytest.mark.parametrize("kind", ["float32", "float16", ">f8", "longdouble", "int8", "uint64", "int32"])
def test_any_real_numbers(cube: t.Mesh, kind: str) -> None:
    points = np.array([[0, 0, 0], [0, 0, 2], [3, 0, 0]], kind)
    np.testing.assert_array_equal(cube.signed_distance(points), [-0.5, 1.5, 2.5])


def test_any_order(bunny: t.Mesh, points: NDArray[np.float64]) -> None:
    expected = bunny.signed_distance(points)
    fortran = np.asfortranarray(points)
    wide = np.zeros((len(points), 7))
    wide[:, 2:5] = points
    for same in (fortran, wide[:, 2:5], points[::-1][::-1], points.tolist()):
        np.testing.assert_array_equal(bunny.signed_distance(same), expected)
    unaligned = np.frombuffer(b"x" + points.tobytes(), np.uint8)[1:].view(np.float64).reshape(-1, 3)
    np.testing.assert_array_equal(bunny.signed_distance(unaligned), expected)


def test_no_points(cube: t.Mesh, rod: t.Model) -> None:
    nothings: tuple[NDArray[np.float64] | list[float], ...] = (np.empty((0, 3)), [])
    for nothing in nothings:
        assert cube.signed_distance(nothing).shape == (0,)
        assert cube.closest(nothing).point.shape == (0, 3)
        assert rod.signed_distance(nothing).shape == (0,)


@pytest.mark.parametrize(
    ("points", "said"),
    [
        (np.zeros((5, 2)), "points: its shape is (5, 2), give one of (n, 3)"),
        (np.zeros(3), "points: its shape is (3), give one of (n, 3)"),
        (np.zeros((2, 3), complex), "points: it holds complex128, give real numbers"),
        ([["a", "b", "c"]], "points: it holds <U1, give real numbers"),
    ],
)
def test_other_points_are_refused(cube: t.Mesh, points: NDArray[np.float64], said: str) -> None:
    with pytest.raises(ValueError) as error:
        cube.signed_distance(points)
    assert str(error.value) == said and isinstance(error.value, t.TruenessError)


def test_the_row_of_a_bad_argument_is_named(cube: t.Mesh) -> None:
    with pytest.raises(ValueError, match="faces, row 1: it names vertex 3, but there are 3 vertices"):
        t.Mesh(np.eye(3), [[0, 1, 2], [0, 1, 3]])
    with pytest.raises(ValueError, match="faces, row 0: it names vertex -1"):
        t.Mesh(np.eye(3), [[0, 1, -1]])
    with pytest.raises(ValueError, match="faces: it holds float64, give whole numbers"):
        t.Mesh(np.eye(3), [[0.0, 1, 2]])
    with pytest.raises(ValueError, match="vertices, row 1: "):
        t.Mesh(np.array([[0, 0, 0], [np.inf, 0, 0], [0, 1, 0]]), [[0, 1, 2]]).closest([[0, 0, 0]])
    far = np.array([[0, 0, 0], [np.nan, 0, 0], [1e200, 0, 0]])
    with pytest.raises(ValueError, match=r"points, row 2: point 2 has a coordinate"):
        cube.signed_distance(far)
    with pytest.raises(ValueError, match="sign: ‘sidewise’ is none of auto, pseudonormal, winding, none"):
        cube.signed_distance([[0, 0, 0]], sign="sidewise")  # type: ignore[arg-type] # pyright: ignore[reportArgumentType]
    with pytest.raises(ValueError, match="max_distance: "):
        cube.signed_distance([[0, 0, 0]], max_distance=-1)
