"""Meshes and points as the bytes of a PLY file, in double precision: how tasks read what is in memory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def points(places: NDArray[np.float64], normals: NDArray[np.float64] | None = None) -> bytes:
    """Points, with their normals where there are such."""
    if normals is None:
        return _header(len(places), "x y z", None) + places.astype("<f8", copy=False).tobytes()
    return _header(len(places), "x y z nx ny nz", None) + np.hstack([places, normals]).astype("<f8").tobytes()


def mesh(vertices: NDArray[np.float64], faces: NDArray[np.uint32]) -> bytes:
    """A mesh."""
    rows = np.empty(len(faces), [("corners", "u1"), ("vertices", "<i4", 3)])
    rows["corners"] = 3
    rows["vertices"] = faces
    header = _header(len(vertices), "x y z", len(faces))
    return b"".join([header, vertices.astype("<f8", copy=False).tobytes(), rows.tobytes()])


def _header(vertices: int, properties: str, faces: int | None) -> bytes:
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {vertices}"]
    lines += [f"property double {name}" for name in properties.split()]
    if faces is not None:
        lines += [f"element face {faces}", "property list uchar int vertex_indices"]
    return "\n".join([*lines, "end_header", ""]).encode()
