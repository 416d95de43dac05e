"""Inputs: meshes, points on and around them, and what the right answers are.

Everything is made from a mesh and a seed, so that the same command makes the same bytes anywhere.
"""
import os

import numpy as np

REFERENCE_POINTS = 500  # compared with brute force
WINDING_POINTS = 100  # of these, compared with the winding number


def read_ply(path):
    """Vertices float64 (V, 3) and faces int64 (F, 3) of a binary little-endian PLY of triangles, as `write_ply` writes it."""
    with open(path, "rb") as file:
        head = []
        while not head or head[-1] != "end_header":
            line = file.readline()
            if not line:
                raise SystemExit(f"{path}: no PLY header")
            head.append(line.decode("ascii").strip())
        count = {w[1]: int(w[2]) for w in map(str.split, head) if w[:1] == ["element"]}
        kind = "<f8" if "property double x" in head else "<f4"
        plain = [f"property {'double' if kind == '<f8' else 'float'} {c}" for c in "xyz"]
        lists = [h for h in head if h.startswith("property list")]
        if [h for h in head if h.startswith("property ") and h not in lists] != plain or "format binary_little_endian 1.0" not in head:
            raise SystemExit(f"{path}: expected binary little-endian PLY with x, y, z alone; make it with inputs.py mesh")
        vertices = np.fromfile(file, kind, 3 * count["vertex"]).reshape(-1, 3).astype(np.float64)
        faces = np.fromfile(file, [("n", "u1"), ("corner", "<i4", 3)], count.get("face", 0))
    return vertices, faces["corner"].astype(np.int64)


def write_ply(path, vertices, faces):
    """Float32 vertices and triangles."""
    record = np.empty(len(faces), [("n", "u1"), ("corner", "<i4", 3)])
    record["n"], record["corner"] = 3, faces
    with open(path, "wb") as file:
        _header(file, len(vertices), "float", len(faces))
        file.write(np.ascontiguousarray(vertices, "<f4").tobytes())
        file.write(record.tobytes())


def write_ply_points(path, points, kind="float", block=1 << 20):
    """Points alone; `kind` is float or double."""
    with open(path, "wb") as file:
        _header(file, len(points), kind, None)
        for i in range(0, len(points), block):
            file.write(np.ascontiguousarray(points[i : i + block], "<f4" if kind == "float" else "<f8").tobytes())


def _header(file, vertices, kind, faces):
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {vertices}"]
    lines += [f"property {kind} {c}" for c in "xyz"]
    if faces is not None:
        lines += [f"element face {faces}", "property list uchar int vertex_indices"]
    file.write(("\n".join(lines + ["end_header"]) + "\n").encode("ascii"))


def write_stl(path, vertices, faces):
    """Binary STL with unit normals."""
    corners = np.asarray(vertices, np.float32)[faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(np.float64)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    record = np.zeros(len(faces), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    record["normal"], record["corners"] = normal, corners
    with open(path, "wb") as file:
        file.write(b"trueness bench".ljust(80))
        file.write(np.uint32(len(faces)).tobytes())
        file.write(record.tobytes())


def write_xyz(path, points, block=1 << 16):
    """Text, six decimals, one point a line."""
    with open(path, "w", encoding="ascii") as file:
        for i in range(0, len(points), block):
            part = np.asarray(points[i : i + block])
            file.write(("%.6f %.6f %.6f\n" * len(part)) % tuple(part.ravel().tolist()))


def points(vertices, faces, kind, count, seed=1, noise=0.0005):
    """float64 (count, 3). `scan`: area-uniform on the surface, plus Gaussian noise along the facet's normal with a
    standard deviation of `noise` diagonals, in random order. `far`: uniform in 1.5 times the box."""
    random = np.random.default_rng(seed)
    low, high = vertices.min(0), vertices.max(0)
    if kind == "far":
        return (low + high) / 2 + random.uniform(-1, 1, (count, 3)) * (high - low) / 2 * 1.5
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    share = np.cumsum(area)
    face = np.minimum(np.searchsorted(share / share[-1], random.random(count)), len(faces) - 1)
    u, v = np.sqrt(random.random(count))[:, None], random.random(count)[:, None]
    on = (1 - u) * a[face] + u * (1 - v) * b[face] + u * v * c[face]
    unit = normal[face] / np.maximum(area[face], 1e-300)[:, None]
    return on + unit * (random.standard_normal(count) * noise * np.linalg.norm(high - low))[:, None]


def reference(mesh_path, points_path):
    """Indices, true distances and winding numbers (of the first few) of some points, kept beside the points.

    Another formula in another language than what is measured: distances to all facets that a sphere around the
    nearest centroid reaches, by projection on plane and edges in float64.
    """
    kept = os.path.splitext(points_path)[0] + ".ref.npz"
    if os.path.exists(kept):
        found = np.load(kept)
        return found["idx"], found["d"], found["w"]
    vertices, faces = read_ply(mesh_path)
    cloud = np.load(points_path, mmap_mode="r")
    which = np.sort(np.random.default_rng(7).choice(len(cloud), min(REFERENCE_POINTS, len(cloud)), replace=False))
    corners = vertices[faces]
    center = corners.mean(1)
    reach = np.sqrt(((corners - center[:, None]) ** 2).sum(2).max(1)) * (1 + 1e-12)
    distance = np.array([_distance(p, corners, center, reach) for p in cloud[which]])
    winding = np.array([_winding(p, corners) for p in cloud[which[:WINDING_POINTS]]])
    np.savez(kept, idx=which, d=distance, w=winding)
    return which, distance, winding


def _distance(p, corners, center, reach):
    to_center = np.sqrt(((center - p) ** 2).sum(1))
    near = corners[to_center - reach <= to_center.min() * (1 + 1e-9)]
    best = np.full(len(near), np.inf)
    for k in range(3):
        a, side = near[:, k], near[:, (k + 1) % 3] - near[:, k]
        length2 = np.maximum((side**2).sum(1), 1e-300)
        t = np.clip(((p - a) * side).sum(1) / length2, 0, 1)
        best = np.minimum(best, np.sqrt(((a + t[:, None] * side - p) ** 2).sum(1)))
    normal = np.cross(near[:, 1] - near[:, 0], near[:, 2] - near[:, 0])
    inside = np.linalg.norm(normal, axis=1) > 0
    for k in range(3):
        side = near[:, (k + 1) % 3] - near[:, k]
        inside &= (np.cross(side, p - near[:, k]) * normal).sum(1) >= 0
    if inside.any():
        height = np.abs(((p - near[inside, 0]) * normal[inside]).sum(1)) / np.linalg.norm(normal[inside], axis=1)
        best[inside] = np.minimum(best[inside], height)
    return best.min()


def _winding(p, corners):
    a, b, c = (corners[:, k] - p for k in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
    above = (a * np.cross(b, c)).sum(1)
    below = la * lb * lc + (a * b).sum(1) * lc + (b * c).sum(1) * la + (c * a).sum(1) * lb
    return np.arctan2(above, below).sum() / (2 * np.pi)
