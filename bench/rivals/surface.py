"""Bicubic surfaces z(x, y) by other programs: `surface.py fitpack|gismo POINTS.npy SPANS THREADS REPEAT once`.

Least squares over given uniform knots without smoothing, and the difference of every point. `fitpack`: SciPy's LSQBivariateSpline.
`gismo`: G+Smo's gsFitting, from the package pygismo.
"""
import json
import os
import sys

# Read by OpenMP and the linear algebra of NumPy when they are loaded.
os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = sys.argv[4]

import numpy as np  # noqa: E402

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from protocol import timed  # noqa: E402


def fitpack(points, spans):
    from scipy.interpolate import LSQBivariateSpline

    x, y, z = points.T.copy()
    inner = [np.linspace(a.min(), a.max(), spans + 1)[1:-1] for a in (x, y)]

    def work():
        surface = LSQBivariateSpline(x, y, z, *inner)
        return surface.ev(x, y) - z

    return work


def gismo(points, spans):
    import pygismo

    low, high = points.min(0), points.max(0)
    parameters, places = np.asfortranarray(points[:, :2].T), np.asfortranarray(points.T)
    clamped = lambda a, b: np.concatenate([[a] * 3, np.linspace(a, b, spans + 1), [b] * 3])
    knots = [pygismo.nurbs.gsKnotVector(clamped(low[k], high[k]), 3) for k in (0, 1)]
    basis = pygismo.nurbs.gsTensorBSplineBasis2(*knots)

    def work():
        fitting = pygismo.modelling.gsFitting(parameters, places, basis)
        fitting.compute(0.0)
        return (fitting.result().eval(parameters) - places)[2]

    return work


def main():
    who, path, spans, _, repeat, task = sys.argv[1:]
    if task != "once":
        raise SystemExit(f"{task}: the rivals have no such task")
    work = {"fitpack": fitpack, "gismo": gismo}[who](np.load(path), int(spans))
    wall, cpu, rms = [], [], 0.0
    for _ in range(int(repeat)):
        (w, c), left = timed(work)
        wall.append(w)
        cpu.append(c)
        rms = float(np.sqrt(np.mean(left**2)))
    print(json.dumps({"query_s": wall, "cpu_s": cpu, "rms": rms}))


if __name__ == "__main__":
    main()
