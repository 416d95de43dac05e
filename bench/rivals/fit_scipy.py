"""SciPy: least_squares (MINPACK's Levenberg-Marquardt) on orthogonal distances with their derivatives, started near the answer.

`fit_scipy.py POINTS.npy SHAPE THREADS REPEAT`. The start is what a user would have to find first: the answer, leaning
by 3 degrees and 2 % off, as ours gets it where it is given one.
"""
import json
import os
import sys

# Read by the linear algebra of NumPy and SciPy when they are loaded.
os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = sys.argv[3]

import numpy as np  # noqa: E402
from scipy.optimize import least_squares  # noqa: E402

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from harness.fit import TRUTH, start_of  # noqa: E402
from protocol import timed  # noqa: E402


def axis(tilt):
    """Unit vector near z from its two small components, and its derivatives by them."""
    direction = np.array([tilt[0], tilt[1], 1.0])
    length = np.linalg.norm(direction)
    direction /= length
    return direction, [(np.eye(3)[k] - direction[k] * direction) / length for k in range(2)]


def along_and_aside(points, foot, tilt):
    """Height along the axis through `foot` and distance from it; their derivatives by foot (3) and tilt (2), as rows."""
    direction, slopes = axis(tilt)
    offset = points - foot
    height = offset @ direction
    aside = np.sqrt(np.maximum((offset**2).sum(1) - height**2, 0.0))
    turned = [offset @ slope for slope in slopes]
    outward = (offset - height[:, None] * direction).T / aside
    d_height = [*(np.full(len(points), -c) for c in direction), *turned]
    d_aside = [*(-outward), *(-height * t / aside for t in turned)]
    return height, aside, d_height, d_aside


def plane(p, points):
    direction, slopes = axis(p[:2])
    return points @ direction - p[2], [*(points @ s for s in slopes), np.full(len(points), -1.0)]


def sphere(p, points):
    offset = points - p[:3]
    distance = np.sqrt((offset**2).sum(1))
    return distance - p[3], [*(-offset.T / distance), np.full(len(points), -1.0)]


def cylinder(p, points):
    _, aside, _, d_aside = along_and_aside(points, [p[0], p[1], 0.0], p[2:4])
    return aside - p[4], [d_aside[k] for k in (0, 1, 3, 4)] + [np.full(len(points), -1.0)]


def cone(p, points):
    height, aside, d_height, d_aside = along_and_aside(points, [p[0], p[1], 0.0], p[2:4])
    sin, cos = np.sin(p[5]), np.cos(p[5])
    moved = [d_aside[k] * cos - d_height[k] * sin for k in (0, 1, 3, 4)]
    distance = (aside - p[4]) * cos - height * sin
    return distance, [*moved, np.full(len(points), -cos), -(aside - p[4]) * sin - height * cos]


def torus(p, points):
    height, aside, d_height, d_aside = along_and_aside(points, p[:3], p[3:5])
    ring = aside - p[5]
    tube = np.hypot(ring, height)
    moved = [(ring * a + height * h) / tube for a, h in zip(d_aside, d_height)]
    return tube - p[6], [*moved, -ring / tube, np.full(len(points), -1.0)]


ELEMENTS = {"plane": plane, "sphere": sphere, "cylinder": cylinder, "cone": cone, "torus": torus}


def main():
    path, shape, _, repeat = sys.argv[1:5]
    points = np.load(path)
    start, element = start_of(shape), ELEMENTS[shape]
    residuals = lambda p: element(p, points)[0]
    slopes = lambda p: np.stack(element(p, points)[1], axis=1)
    wall, cpu, rms = [], [], 0.0
    for _ in range(int(repeat)):
        lap, found = timed(lambda: least_squares(residuals, start, jac=slopes, method="lm", xtol=1e-12))
        rms = float(np.sqrt((found.fun**2).mean()))
        wall.append(lap[0])
        cpu.append(lap[1])
    print(json.dumps({"query_s": wall, "cpu_s": cpu, "rms": rms}))


if __name__ == "__main__":
    main()
