"""What the comparisons share: the program, its corpus, and curves by the recursion in its plain form."""

import subprocess
import sys
from pathlib import Path

import numpy as np

PROGRAM, CORPUS = sys.argv[1], Path(sys.argv[2])


def run(*words):
    """Runs the program; its answer may be "out of tolerance", but not an error."""
    done = subprocess.run([PROGRAM, *map(str, words), "--quiet"], capture_output=True, text=True)
    assert done.returncode in (0, 1), (words, done.returncode, done.stderr)


def basis(knots, degree, t):
    """All basis functions at a parameter, by the recursion of Cox and de Boor in its plain form."""
    last = np.flatnonzero(np.asarray(knots) < t).max() if t > knots[0] else degree
    n = np.zeros(len(knots) - 1)
    n[last] = 1
    for p in range(1, degree + 1):
        for i in range(len(knots) - p - 1):
            left, right = knots[i + p] - knots[i], knots[i + p + 1] - knots[i + 1]
            a = (t - knots[i]) / left * n[i] if left > 0 else 0
            n[i] = a + ((knots[i + p + 1] - t) / right * n[i + 1] if right > 0 else 0)
    return n[: len(knots) - degree - 1]


def along(segment, shares):
    """Places of a segment of a section's document, in its plane, at shares of its parameter."""
    if segment["kind"] == "line":
        return np.outer(1 - shares, segment["start"]) + np.outer(shares, segment["end"])
    if segment["kind"] == "arc":
        angles = segment["start_angle"] + shares * segment["sweep"]
        return segment["center"] + segment["radius"] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    knots, control = segment["knots"], np.array(segment["control_points"])
    return np.array([basis(knots, segment["degree"], knots[0] + t * (knots[-1] - knots[0])) @ control for t in shares])


def mixed_row():
    """Points of a line, an arc tangent to it, and a wave."""
    s = np.linspace(0, 1, 60)
    line, angle = np.stack([30 * s - 30, 0 * s], axis=1), 1.5 * s[1:]
    arc = np.stack([12 * np.sin(angle), 12 - 12 * np.cos(angle)], axis=1)
    wave = np.stack([30 * s + 15, 8 * np.sin(4 * s**2) + 14], axis=1)
    return np.concatenate([line, arc, wave])
