"""B-spline curves by other programs: `curve.py scipy|geomdl POINTS.npy SPANS COUNT THREADS REPEAT OUT.f64 at|derivatives|fit`.

Cubic, uniform knots on 0 to 1, tasks as in src/bin/curve.rs. `scipy`: BSpline, make_lsq_spline. `geomdl`: the same curve in Python.
"""
import json
import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = sys.argv[5]

import numpy as np  # noqa: E402

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from protocol import timed  # noqa: E402


def scipy(points, knots, at, task):
    from scipy.interpolate import BSpline, make_lsq_spline

    if task == "fit":
        where = np.linspace(0, 1, len(points))
        return lambda: make_lsq_spline(where, points, knots, 3).c
    curve = BSpline(knots, points, 3)
    if task == "at":
        return lambda: curve(at)
    return lambda: np.hstack([curve(at, 1), curve(at, 2)])


def geomdl(points, knots, at, task):
    from geomdl import BSpline

    curve = BSpline.Curve()
    curve.degree, curve.ctrlpts, curve.knotvector = 3, points.tolist(), knots.tolist()
    if task == "at":
        return lambda: np.array(curve.evaluate_list(at.tolist()))
    if task == "derivatives":
        return lambda: np.array([np.concatenate(curve.derivatives(t, 2)[1:]) for t in at.tolist()])
    raise SystemExit("fit: geomdl chooses knots of its own")


def main():
    who, path, spans, count, _, repeat, out, task = sys.argv[1:]
    knots = np.concatenate([[0] * 3, np.linspace(0, 1, int(spans) + 1), [1] * 3])
    work = {"scipy": scipy, "geomdl": geomdl}[who](np.load(path), knots, np.linspace(0, 1, int(count)), task)
    wall, cpu, found = [], [], None
    for _ in range(int(repeat)):
        (w, c), found = timed(work)
        wall.append(w)
        cpu.append(c)
    np.asarray(found, np.float64).tofile(out)
    print(json.dumps({"query_s": wall, "cpu_s": cpu}))


if __name__ == "__main__":
    main()
