#!/usr/bin/env python3
"""Sections beside other programs: `section.py MESH [--count 1000] [--rounds 3] [--against trimesh,meshlib] [--no-build]`.

Parallel planes through a mesh beside trimesh and MeshLib: time, number of closed loops, area inside them. Then a cubic B-spline
curve of 200 control points at 100,000 parameters, place and derivative, beside SciPy and geomdl (at 2,000, scaled), with the greatest
difference. Ratios above 1 mean: the rival needs that many times longer. Each program runs in a process of its own, in turns.
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import numpy as np  # noqa: E402
from harness import program, report  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
COLUMNS = [
    ("task", None, "task"),
    ("program", None, "program"),
    ("wall s", ".4f", "query_s"),
    ("CPU s", ".4f", "cpu_s"),
    ("× ours", ".1f", "times_ours"),
    ("× ours, CPU", ".1f", "times_ours_cpu"),
    ("loops", None, "chains"),
    ("area", None, "area"),
    ("max difference", None, "difference"),
    ("noise", ".2f", "noise"),
]
CONTROL, PLACES, FEW = 200, 100_000, 2_000


def measure(task, programs, rounds, scale=None, difference=None):
    runs = {name: [] for name in programs}
    for round_ in range(rounds):
        for name in list(programs) if round_ % 2 == 0 else list(programs)[::-1]:
            runs[name].append(program.run(programs[name]))
    rows, ours = [], runs["trueness"]
    for name, done in runs.items():
        k = (scale or {}).get(name, 1)
        middle = lambda key: k * statistics.median(min(r[key]) for r in done)
        ratio = lambda key: k * statistics.median(min(r[key]) / min(o[key]) for r, o in zip(done, ours))
        rows.append({
            "task": task, "program": name, "query_s": middle("query_s"), "cpu_s": middle("cpu_s"),
            "times_ours": ratio("query_s"), "times_ours_cpu": ratio("cpu_s"), "chains": done[0].get("chains", ""),
            "area": done[0].get("area") or "", "difference": (difference or {}).get(name, ""),
            "noise": statistics.median(r["noise"] for r in done),
        })  # fmt: skip
    return rows


def curves(binary, rival, rounds, against):
    with tempfile.TemporaryDirectory() as folder:
        points = np.cumsum(np.random.default_rng(1).normal(0, 1, (CONTROL, 3)), 0)
        programs, counts = {}, {"trueness": PLACES, "scipy": PLACES, "geomdl": FEW}
        for name in ["trueness", *against]:
            path = os.path.join(folder, f"{name}.npy")
            np.save(path, points)
            words = [binary, "curve"] if name == "trueness" else [*rival, name]
            programs[name] = [*words, path, str(counts[name]), "3"]
        rows = measure("curve", programs, rounds, {"geomdl": PLACES / FEW})
        # What each found, beside ours at the same parameters.
        for row in rows[1:]:
            name = row["program"]
            program.run([binary, "curve", os.path.join(folder, "trueness.npy"), str(counts[name]), "1"])
            ours = np.fromfile(os.path.join(folder, "trueness.npy.f64"))
            theirs = np.fromfile(os.path.join(folder, f"{name}.npy.{name}.f64"))
            row["difference"] = "%.1e" % (np.max(np.abs(ours - theirs)) / np.max(np.abs(ours)))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--against", default="trimesh,meshlib,scipy,geomdl")
    parser.add_argument("--no-build", action="store_true")
    o = parser.parse_args()
    if not o.no_build:
        subprocess.run(["cargo", "build", "--release", "--bin", "section"], cwd=HERE, check=True)
    folder = os.environ.get("CARGO_TARGET_DIR") or os.path.join(HERE, "target")
    binary = os.path.join(folder, "release", "section")
    rival = [sys.executable, os.path.join(HERE, "rivals", "section.py")]
    names = [n for n in o.against.split(",") if n]
    rest = lambda repeat: [o.mesh, str(o.count), str(o.threads), str(repeat)]
    programs = {"trueness": [binary, *rest(3)]}
    programs.update({n: [*rival, n, *rest(1)] for n in names if n in ("trimesh", "meshlib")})
    rows = measure(f"{o.count} planes", programs, o.rounds)
    rows += curves(binary, rival, o.rounds, [n for n in names if n in ("scipy", "geomdl")])
    print(report.markdown(rows, COLUMNS))


if __name__ == "__main__":
    main()
