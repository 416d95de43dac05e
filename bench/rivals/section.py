"""The work of src/bin/section.rs by other programs: `section.py trimesh|meshlib MESH COUNT THREADS REPEAT`, or
`section.py scipy|geomdl POINTS.npy COUNT REPEAT` for the curve.

trimesh: one call of `section_multiplane`; its loops are put together by the property that is read afterwards, within the clock, as an
answer of loops is what is compared. MeshLib: `extractPlaneSections` for each plane, on all threads, its tree built outside the clock.
"""
import json
import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np  # noqa: E402

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from protocol import timed  # noqa: E402


def offsets(z, count):
    low, high = float(np.min(z)), float(np.max(z))
    return low + (high - low) / (count + 1) * np.arange(1, count + 1)


def areas(loops):
    """Area inside closed plane loops, holes taken off by their sense."""
    total = 0.0
    for p in loops:
        x, y = p[:, 0] - p[0, 0], p[:, 1] - p[0, 1]
        total += 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    return total


def trimesh(path, count):
    import trimesh as tm

    mesh = tm.load(path, process=True)
    heights = offsets(mesh.vertices[:, 2], count)
    _ = mesh.face_normals, mesh.edges_unique

    def work():
        cuts = mesh.section_multiplane([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], heights)
        return [path.discrete for path in cuts if path is not None]

    def told(found):
        closed = [np.asarray(p)[:-1] for c in found for p in c if len(p) > 3 and np.allclose(p[0], p[-1])]
        return len(closed), None

    return work, told


def meshlib(path, count):
    import meshlib.mrmeshnumpy as mn
    import meshlib.mrmeshpy as mr

    mesh = mr.loadMesh(path)
    part = mr.MeshPart(mesh)
    heights = offsets(mn.getNumpyVerts(mesh)[:, 2], count)
    planes = [mr.Plane3f(mr.Vector3f(0, 0, 1), float(h)) for h in heights]
    mr.extractPlaneSections(part, planes[0])

    def work():
        return [(mr.planeSectionsToContours2f(mesh, s, mr.AffineXf3f()), s) for s in (mr.extractPlaneSections(part, p) for p in planes)]

    def told(found):
        loops = [np.array([[q.x, q.y] for q in c]) for cs, _ in found for c in cs]
        closed = [p[:-1] for p in loops if len(p) > 3 and np.allclose(p[0], p[-1])]
        return len(closed), abs(areas(closed))

    return work, told


def knots(n):
    return np.concatenate([[0.0] * 3, np.linspace(0, 1, n - 2), [1.0] * 3])


def scipy(points, count):
    from scipy.interpolate import BSpline

    t = np.linspace(0, 1, count)
    curve = BSpline(knots(len(points)), points, 3)
    slope = curve.derivative()
    return lambda: np.stack([curve(t), slope(t)], 1)


def geomdl(points, count):
    from geomdl import BSpline

    curve = BSpline.Curve()
    curve.degree, curve.ctrlpts = 3, points.tolist()
    curve.knotvector = knots(len(points)).tolist()
    t = np.linspace(0, 1, count).tolist()
    return lambda: np.array([curve.derivatives(u, 1) for u in t])


def main():
    who, path, count, *rest = sys.argv[1:]
    repeat = int(rest[-1])
    told = None
    if who in ("scipy", "geomdl"):
        work = {"scipy": scipy, "geomdl": geomdl}[who](np.load(path), int(count))
    else:
        work, told = {"trimesh": trimesh, "meshlib": meshlib}[who](path, int(count))
    wall, cpu, found = [], [], None
    for _ in range(repeat):
        (w, c), found = timed(work)
        wall.append(w)
        cpu.append(c)
    line = {"query_s": wall, "cpu_s": cpu}
    if told:
        line["chains"], line["area"] = told(found)
    else:
        np.asarray(found, np.float64).tofile(f"{path}.{who}.f64")
    print(json.dumps(line))


main()
