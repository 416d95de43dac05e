"""Least-squares elements: ours, which looks for its own start, beside SciPy's general solver, which is given one."""
import statistics

import numpy as np

from . import program

# Parameters as rivals/fit_scipy.py has them: tilts of the axis from z, places and radii in mm.
TRUTH = {
    "plane": [0.1, -0.2, 30.0],
    "sphere": [10.0, 20.0, -30.0, 40.0],
    "cylinder": [5.0, -7.0, 0.1, 0.05, 25.0],
    "cone": [5.0, -7.0, 0.1, 0.05, 25.0, 0.3],
    "torus": [5.0, -7.0, 3.0, 0.1, 0.05, 60.0, 15.0],
}
COLUMNS = [
    ("shape", None, "shape"),
    ("program", None, "program"),
    ("wall s", ".4f", "query_s"),
    ("CPU s", ".4f", "cpu_s"),
    ("× ours", ".1f", "times_ours"),
    ("× ours, CPU", ".1f", "times_ours_cpu"),
    ("rms mm", ".12g", "rms"),
    ("noise", ".2f", "noise"),
]


def points(shape, count, noise=0.01, seed=1):
    """float64 (count, 3): part of the shape, as a scanner sees it, with Gaussian noise along the normal."""
    random = np.random.default_rng(seed)
    p, error = TRUTH[shape], random.normal(0, noise, count)
    u, v = random.uniform(-1, 1, count), random.uniform(-1, 1, count)
    if shape == "sphere":
        ring = np.sqrt(1 - (0.9 * u) ** 2)
        local = np.column_stack([ring * np.cos(2 * v), ring * np.sin(2 * v), 0.9 * u]) * (p[3] + error)[:, None]
        return local + p[:3]
    tilt = {"plane": p[:2], "cylinder": p[2:4], "cone": p[2:4], "torus": p[3:5]}[shape]
    frame = _frame(tilt)
    if shape == "plane":
        return np.column_stack([50 * u, 50 * v, p[2] + error]) @ frame
    height, angle = 40 * u, 2 * v
    if shape == "torus":
        tube = p[6] + error
        aside, height = p[5] + tube * np.cos(3 * u), tube * np.sin(3 * u)
        origin = np.array(p[:3])
    else:
        slope = p[5] if shape == "cone" else 0.0
        aside = p[4] + height * np.tan(slope) + error * np.cos(slope)
        height = height - error * np.sin(slope)
        origin = np.array([p[0], p[1], 0.0])
    return np.column_stack([aside * np.cos(angle), aside * np.sin(angle), height]) @ frame + origin


def _frame(tilt):
    """Rows: two directions across the axis, and the axis."""
    z = np.array([tilt[0], tilt[1], 1.0])
    z /= np.linalg.norm(z)
    x = np.cross([0.0, 1.0, 0.0], z)
    x /= np.linalg.norm(x)
    return np.array([x, np.cross(z, x), z])


def measure(shape, path, programs, rounds, repeat, threads):
    """Two rows; `programs` are ours and the rival's command, in this order."""
    runs = {name: [] for name in programs}
    for round_ in range(rounds):
        for name in list(programs) if round_ % 2 == 0 else list(programs)[::-1]:
            runs[name].append(program.run([*programs[name], path, shape, str(threads), str(repeat)]))
    ours = runs[next(iter(programs))]
    rows = []
    for name, done in runs.items():
        middle = lambda key: statistics.median(min(r[key]) for r in done)
        ratio = lambda key: statistics.median(min(r[key]) / min(o[key]) for r, o in zip(done, ours))
        rows.append({
            "shape": shape, "program": name, "query_s": middle("query_s"), "cpu_s": middle("cpu_s"),
            "times_ours": ratio("query_s"), "times_ours_cpu": ratio("cpu_s"), "rms": done[0]["rms"],
            "noise": statistics.median(r["noise"] for r in done),
        })  # fmt: skip
    return rows
