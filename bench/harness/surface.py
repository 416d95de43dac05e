"""Bicubic surfaces through noisy points of Franke's function, beside FITPACK and G+Smo."""
import statistics

import numpy as np

from . import program

# Points, spans, task, the most seconds that one thread may need; the rivals run beside it where True.
CASES = [
    (1_000_000, 47, "once", 0.2, True),
    (1_000_000, 97, "once", 0.5, False),
    (1_000_000, 47, "auto", 0.9, False),
    (10_000_000, 47, "once", 3.0, False),
]
COLUMNS = [
    ("points", ",d", "points"),
    ("control points", None, "net"),
    ("task", None, "task"),
    ("program", None, "program"),
    ("wall s", ".3f", "query_s"),
    ("CPU s", ".3f", "cpu_s"),
    ("goal s", ".2f", "goal_s"),
    ("× ours", ".1f", "times_ours"),
    ("× ours, CPU", ".1f", "times_ours_cpu"),
    ("bytes a point", ".0f", "bytes"),
    ("rms mm", ".9f", "rms"),
    ("noise", ".2f", "noise"),
]


def points(count, seed=1):
    """float64 (count, 3): Franke's function over 100 mm by 100 mm, 100 mm high, with normal noise of 0.01 mm in height."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(0, 1, count), random.uniform(0, 1, count)
    z = 0.75 * np.exp(-((9 * x - 2) ** 2 + (9 * y - 2) ** 2) / 4)
    z += 0.75 * np.exp(-((9 * x + 1) ** 2) / 49 - (9 * y + 1) / 10)
    z += 0.5 * np.exp(-((9 * x - 7) ** 2 + (9 * y - 3) ** 2) / 4)
    z -= 0.2 * np.exp(-((9 * x - 4) ** 2) - (9 * y - 7) ** 2)
    return np.column_stack([100 * x, 100 * y, 100 * z + random.normal(0, 0.01, count)])


def measure(case, path, programs, rounds, repeat):
    """A row for each of `programs`, ours first. On one thread; `bytes` is the peak memory of the whole process, the points included."""
    count, spans, task, goal, _ = case
    runs = {name: [] for name in programs}
    for round_ in range(rounds):
        for name in list(programs) if round_ % 2 == 0 else list(programs)[::-1]:
            words = [*programs[name], path, str(spans), "1", str(repeat if name == "trueness" else 1), task]
            runs[name].append(program.run(words))
    ours = runs["trueness"]
    rows = []
    for name, done in runs.items():
        least = lambda run, key: min(run[key])
        middle = lambda key: statistics.median(least(r, key) for r in done)
        ratio = lambda key: statistics.median(least(r, key) / least(o, key) for r, o in zip(done, ours))
        rows.append({
            "points": count, "net": f"{spans + 3} x {spans + 3}", "task": task, "program": name,
            "goal_s": goal if done is ours else None, "query_s": middle("query_s"), "cpu_s": middle("cpu_s"),
            "times_ours": ratio("query_s"), "times_ours_cpu": ratio("cpu_s"), "rms": done[0]["rms"],
            "bytes": 1e6 * max(r["peak_mb"] for r in done) * 1.048576 / count,
            "noise": statistics.median(r["noise"] for r in done),
        })  # fmt: skip
    return rows
