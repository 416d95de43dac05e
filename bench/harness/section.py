"""Sections: a mesh by a stack of planes beside trimesh and MeshLib; curves on the same knots beside SciPy and geomdl."""
import os
import statistics

import numpy as np

from . import program

COLUMNS = [
    ("facets", ",d", "facets"),
    ("planes", ",d", "planes"),
    ("program", None, "program"),
    ("wall s", ".3f", "query_s"),
    ("CPU s", ".3f", "cpu_s"),
    ("× ours", ".1f", "times_ours"),
    ("× ours, CPU", ".1f", "times_ours_cpu"),
    ("chains", ",d", "loops"),
    ("length mm", ".3f", "length"),
    ("noise", ".2f", "noise"),
]
CURVE_COLUMNS = [
    ("task", None, "task"),
    ("count", ",d", "count"),
    ("program", None, "program"),
    ("wall ms", ".2f", "query_ms"),
    ("CPU ms", ".2f", "cpu_ms"),
    ("× ours", ".2f", "times_ours"),
    ("× ours, CPU", ".2f", "times_ours_cpu"),
    ("greatest difference", ".1e", "off"),
    ("noise", ".2f", "noise"),
]
# Task, spans, points of a fit, parameters, whether geomdl runs beside it.
CURVES = [
    ("at", 97, None, 1_000_000, False),
    ("at", 97, None, 10_000, True),
    ("derivatives", 97, None, 1_000_000, False),
    ("derivatives", 97, None, 10_000, True),
    ("fit", 97, 100_000, 2, False),
]


def _runs(programs, rounds, words):
    """The runs of each program, in turns; `words(name)` are the arguments."""
    runs = {name: [] for name in programs}
    for round_ in range(rounds):
        for name in list(programs) if round_ % 2 == 0 else list(programs)[::-1]:
            runs[name].append(program.run([*programs[name], *words(name)]))
    return runs


def _figures(done, ours):
    least = lambda run, key: min(run[key])
    middle = lambda key: statistics.median(least(r, key) for r in done)
    ratio = lambda key: statistics.median(least(r, key) / least(o, key) for r, o in zip(done, ours))
    return {
        "query_s": middle("query_s"), "cpu_s": middle("cpu_s"), "query_ms": 1e3 * middle("query_s"), "cpu_ms": 1e3 * middle("cpu_s"),
        "times_ours": ratio("query_s"), "times_ours_cpu": ratio("cpu_s"), "noise": statistics.median(r["noise"] for r in done),
    }  # fmt: skip


def stack(mesh, planes, programs, rounds, repeat, threads):
    """A row for each program, ours first; rivals answer once a round."""
    words = lambda name: [mesh, str(planes), str(threads), str(repeat if name == "trueness" else 1)]
    runs = _runs(programs, rounds, words)
    ours = runs["trueness"]
    about = lambda done: {"loops": done[0]["loops"], "length": done[0]["length"]}
    same = {"facets": ours[0]["facets"], "planes": planes}
    return [{**same, "program": name, **about(done), **_figures(done, ours)} for name, done in runs.items()]


def curve(case, folder, programs, rounds, repeat):
    """A row for each program, ours first, with the greatest difference from ours, over the greatest coordinate."""
    task, spans, points, count, beside = case
    random = np.random.default_rng(4)
    rows = points or spans + 3
    angle = np.linspace(0, 20, rows)
    path = os.path.join(folder, "points.npy")
    np.save(path, np.stack([50 * np.cos(angle), 50 * np.sin(angle), 3 * angle], axis=1) + random.normal(0, 0.1, (rows, 3)))
    programs = {name: words for name, words in programs.items() if name != "geomdl" or beside}
    out = lambda name: os.path.join(folder, f"{name}.f64")
    words = lambda name: [path, str(spans), str(count), "1", str(repeat if name == "trueness" else 1), out(name), task]
    runs = _runs(programs, rounds, words)
    found = {name: np.fromfile(out(name)) for name in programs}
    ours = found["trueness"]
    off = lambda name: float(np.abs(found[name] - ours).max() / np.abs(ours).max())
    size = points or count
    return [
        {"task": task, "count": size, "program": name, "off": off(name), **_figures(done, runs["trueness"])}
        for name, done in runs.items()
    ]
