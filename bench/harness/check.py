"""Loading, welding and checking a mesh: ours beside MeshLib, and beside ADMesh where it is installed.

The programs do not look for the same: ours for every kind of defect it knows with the place of each, MeshLib for five,
ADMesh for edges alone (it has no test for self-intersection, and does all in one go). `core` is the time of ours for what
MeshLib looks for as well: topology, area and volume, self-intersections.
"""
import os
import shutil
import statistics

from . import program

COLUMNS = [
    ("mesh", None, "mesh"),
    ("program", None, "program"),
    ("load s", ".3f", "load_s"),
    ("check s", ".3f", "query_s"),
    ("load CPU s", ".3f", "load_cpu_s"),
    ("check CPU s", ".3f", "cpu_s"),
    ("core s", ".3f", "core_s"),
    ("× ours", ".2f", "times_ours"),
    ("× core", ".2f", "times_core"),
    ("× ours, CPU", ".2f", "times_ours_cpu"),
    ("peak MB", ".0f", "peak_mb"),
    ("found", None, "found"),
    ("noise", ".2f", "noise"),
]


def measure(path, programs, rounds, repeat, threads):
    """One row a program; ratios are of load and check together."""
    programs = {name: [*words, path, str(threads), str(repeat)] for name, words in programs.items()}
    if shutil.which("admesh"):
        programs["admesh"] = ["admesh", path]
    runs = {name: [] for name in programs}
    for round_ in range(rounds):
        for name in list(programs) if round_ % 2 == 0 else list(programs)[::-1]:
            run = program.run(programs[name])
            if "query_s" not in run:  # a program that does all in one go and prints no figures of its own
                run.update(load_s=[0.0], load_cpu_s=[0.0], query_s=[run["wall_s"]], cpu_s=[run["all_cpu_s"]], found="")
            runs[name].append(run)
    ours = runs[next(iter(programs))]
    total = lambda run, load, check: min(a + b for a, b in zip(run[load], run[check]))
    rows = []
    for name, done in runs.items():
        middle = lambda key: statistics.median(min(r[key]) for r in done)
        ratio = lambda *keys: statistics.median(total(r, *keys) / total(o, *keys) for r, o in zip(done, ours))
        rows.append({
            "mesh": os.path.basename(path), "program": name,
            "load_s": middle("load_s"), "query_s": middle("query_s"),
            "core_s": middle("core_s") if "core_s" in done[0] else None,
            "times_core": statistics.median(total(r, "load_s", "query_s") / total(o, "load_s", "core_s") for r, o in zip(done, ours)),
            "load_cpu_s": middle("load_cpu_s"), "cpu_s": middle("cpu_s"),
            "times_ours": ratio("load_s", "query_s"), "times_ours_cpu": ratio("load_cpu_s", "cpu_s"),
            "peak_mb": max(r["peak_mb"] for r in done), "found": str(done[0]["found"] or "nothing"),
            "noise": statistics.median(r["noise"] for r in done),
        })  # fmt: skip
    return rows
