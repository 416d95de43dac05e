"""The closest-point job: several programs, the same mesh, the same points, one session.

Every program runs in a process of its own, round after round in alternating order; a ratio is the median over rounds
of the ratios within a round, so that a machine that is slow for a while is slow for both.
"""
import os
import statistics
import tempfile

import numpy as np

from . import data, program

WRONG_SIDE_FROM = 1e-3  # a sign is called wrong only for points farther than this many mm (single precision rivals)


class Case:
    """One mesh, one cloud, one question."""

    def __init__(self, mesh, cloud, mode="unsigned", heavy=False):
        """`heavy`: rivals that need minutes run in the first round alone, once."""
        self.mesh, self.cloud, self.mode, self.heavy = mesh, cloud, mode, heavy

    @property
    def name(self):
        stem = os.path.basename(self.cloud)[: -len(".npy")]
        return stem if self.mode == "unsigned" else f"{stem} {self.mode}"


def measure(case, programs, rounds, repeat, threads, say=print):
    """Rows, one a program: dictionaries of medians and ratios to the first program, which is ours.

    `programs`: name to command, the six words of the job left out.
    """
    points = int(np.load(case.cloud, mmap_mode="r").shape[0])
    ours = next(iter(programs))
    runs = {name: [] for name in programs}
    for round_ in range(rounds):
        names = list(programs) if round_ % 2 == 0 else list(programs)[::-1]
        for name in names:
            rival = name in RIVALS
            if case.heavy and rival and round_ > 0:
                runs[name].append(None)
                continue
            try:
                runs[name].append(_once(case, programs[name], 1 if case.heavy and rival else repeat, threads))
            except program.Failed as reason:
                say(f"!! {case.name}: {name}: {reason}")
                runs[name].append(None)
    rows = [_row(name, runs[name], runs[ours], points, threads) for name in programs if any(runs[name])]
    return [dict(row, case=case.name, points=points, mode=case.mode, rounds=rounds, threads=threads) for row in rows]


RIVALS = ("open3d", "meshlib", "parry3d")


def _once(case, command, repeat, threads):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "distances")
        run = program.run([*command, case.mesh, case.cloud, out, str(threads), str(repeat), case.mode], timeout=1200)
        if "query_s" not in run:
            raise program.Failed("printed no measurement")
        which, distance, winding = data.reference(case.mesh, case.cloud)
        found = np.fromfile(out)
        signed = found[which[: len(winding)]]
        if case.mode == "winding":
            run["max_error"] = float(np.abs(signed - winding).max())
            return run
        run["max_error"] = float(np.abs(np.abs(found[which]) - distance).max())
        if case.mode == "signed":
            told = np.abs(distance[: len(winding)]) > WRONG_SIDE_FROM
            run["wrong_signs"] = int((told & ((signed < 0) != (winding > 0.5))).sum())
            run["signs_compared"] = int(told.sum())
        return run


def _row(name, runs, ours, points, threads):
    done = [r for r in runs if r]
    best = lambda r, key: min(r[key])  # the least of the repeats: the first also pays for fresh memory
    middle = lambda key: statistics.median(best(r, key) for r in done)
    pairs = [(r, o) for r, o in zip(runs, ours) if r and o]
    ratio = lambda key: statistics.median(best(r, key) / best(o, key) for r, o in pairs) if pairs else None
    query, cpu = middle("query_s"), middle("cpu_s")
    row = {
        "program": name,
        "build_s": statistics.median(r["build_s"] for r in done),
        "query_s": query,
        "cpu_s": cpu,
        "mpts_per_s": points / query / 1e6,
        "quiet_mpts_per_s": points / (cpu / threads) / 1e6,
        "times_ours": ratio("query_s"),
        "times_ours_cpu": ratio("cpu_s"),
        "spread": [min(best(r, "cpu_s") for r in done), max(best(r, "cpu_s") for r in done)],
        "peak_mb": max(r["peak_mb"] for r in done),
        "max_error": max(r["max_error"] for r in done),
        "noise": statistics.median(r["noise"] for r in done),
    }
    if "wrong_signs" in done[0]:
        row["wrong_signs"] = f"{max(r['wrong_signs'] for r in done)}/{done[0]['signs_compared']}"
    return row
