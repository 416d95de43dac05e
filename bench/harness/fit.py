"""Elements through points: least squares beside SciPy's general solver, zones by ourselves."""
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
# Where the axis, the center and the sizes are among them.
TILT = {"plane": [0, 1], "sphere": [], "cylinder": [2, 3], "cone": [2, 3], "torus": [3, 4]}
# What is asked of how many points, and the most milliseconds that one thread may need; SciPy runs beside it where True.
CASES = [
    ("cylinder", 1_000, "near", 0.02, True),
    ("cylinder", 1_000, "global", None, True),
    ("cylinder", 100_000, "near", 2.0, True),
    *((shape, 100_000, "global", None, True) for shape in TRUTH),
    ("cylinder", 10_000_000, "near", 250.0, False),
    ("cylinder", 10_000_000, "global", None, False),
    ("plane", 20_000, "zone", 1.0, False),
    ("cylinder", 20_000, "zone", 4.0, False),
    ("plane", 10_000_000, "zone", 1000.0, False),
    ("cylinder", 10_000_000, "zone", 1000.0, False),
]
COLUMNS = [
    ("shape", None, "shape"),
    ("points", ",d", "points"),
    ("task", None, "task"),
    ("program", None, "program"),
    ("wall ms", ".4f", "query_ms"),
    ("CPU ms", ".4f", "cpu_ms"),
    ("goal ms", ".2f", "goal_ms"),
    ("× ours", ".1f", "times_ours"),
    ("× ours, CPU", ".1f", "times_ours_cpu"),
    ("rms mm", ".12g", "rms"),
    ("noise", ".2f", "noise"),
]


def start_of(shape):
    """Parameters of the start that is given: 3 degrees off, and 2 % in all but the attitude."""
    start = [1.02 * x for x in TRUTH[shape]]
    for k in TILT[shape]:
        start[k] = TRUTH[shape][k]
    if TILT[shape]:
        start[TILT[shape][0]] += np.tan(np.radians(3.0))
    return np.array(start)


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


def measure(case, path, programs, rounds, repeat):
    """A row for each of `programs`, ours first, which takes the task as its last word. On one thread."""
    shape, count, task, goal, _ = case
    # Short work is repeated: its first run pays for cold caches, and a processor takes a while to come up to speed.
    repeat = max(repeat, min(1000, 3_000_000 // count))
    runs = {name: [] for name in programs}
    for round_ in range(rounds):
        for name in list(programs) if round_ % 2 == 0 else list(programs)[::-1]:
            runs[name].append(program.run([*programs[name], path, shape, "1", str(repeat), task]))
    ours = runs[next(iter(programs))]
    rows = []
    for name, done in runs.items():
        typical = lambda run, key: statistics.median(run[key])
        middle = lambda key: 1e3 * statistics.median(typical(r, key) for r in done)
        ratio = lambda key: statistics.median(typical(r, key) / typical(o, key) for r, o in zip(done, ours))
        rows.append({
            "shape": shape, "points": count, "task": task, "program": name, "goal_ms": goal if done is ours else None,
            "query_ms": middle("query_s"), "cpu_ms": middle("cpu_s"),
            "times_ours": ratio("query_s"), "times_ours_cpu": ratio("cpu_s"), "rms": done[0]["rms"],
            "noise": statistics.median(r["noise"] for r in done),
        })  # fmt: skip
    return rows
