"""SciPy: least_squares (MINPACK's Levenberg-Marquardt) on orthogonal distances, started near the answer.

`fit_scipy.py POINTS.npy SHAPE THREADS REPEAT`. The start is what a user would have to find first; ours gets none.
"""
import json
import os
import sys

import numpy as np
from scipy.optimize import least_squares

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from harness.fit import TRUTH  # noqa: E402
from protocol import timed  # noqa: E402


def axis(tilt):
    """Unit vector near z from its two small components."""
    direction = np.array([tilt[0], tilt[1], 1.0])
    return direction / np.linalg.norm(direction)


def along_and_aside(points, foot, direction):
    """Height along the axis through (foot, 0), and distance from it."""
    offset = points - np.array([foot[0], foot[1], 0.0])
    height = offset @ direction
    return height, np.sqrt(np.maximum((offset**2).sum(1) - height**2, 0.0))


def plane(p, points):
    return points @ axis(p[:2]) - p[2]


def sphere(p, points):
    return np.linalg.norm(points - p[:3], axis=1) - p[3]


def cylinder(p, points):
    return along_and_aside(points, p[:2], axis(p[2:4]))[1] - p[4]


def cone(p, points):
    height, aside = along_and_aside(points, p[:2], axis(p[2:4]))
    return (aside - p[4]) * np.cos(p[5]) - height * np.sin(p[5])


def torus(p, points):
    direction = axis(p[3:5])
    offset = points - p[:3]
    height = offset @ direction
    aside = np.sqrt(np.maximum((offset**2).sum(1) - height**2, 0.0))
    return np.hypot(aside - p[5], height) - p[6]


RESIDUALS = {"plane": plane, "sphere": sphere, "cylinder": cylinder, "cone": cone, "torus": torus}
path, shape, _, repeat = sys.argv[1:]
points = np.load(path)
truth = np.array(TRUTH[shape])
start = truth + 0.02 * np.maximum(np.abs(truth), 0.1)
wall, cpu, rms = [], [], 0.0
for _ in range(int(repeat)):
    lap, found = timed(lambda: least_squares(RESIDUALS[shape], start, args=(points,), method="lm", xtol=1e-12))
    rms = float(np.sqrt((found.fun**2).mean()))
    wall.append(lap[0])
    cpu.append(lap[1])
print(json.dumps({"query_s": wall, "cpu_s": cpu, "rms": rms}))
