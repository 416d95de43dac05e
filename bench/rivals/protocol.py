"""The command line that every program for the closest-point job understands, for rivals that are Python packages."""
import json
import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from harness.data import read_ply  # noqa: E402


class Job:
    """`MESH.ply POINTS.npy OUT.f64 THREADS REPEAT unsigned|signed`, read."""

    def __init__(self):
        if len(sys.argv) != 7:
            raise SystemExit("usage: MESH.ply POINTS.npy OUT.f64 THREADS REPEAT unsigned|signed")
        mesh, cloud, self.out, threads, repeat, self.mode = sys.argv[1:]
        if self.mode not in ("unsigned", "signed"):
            raise SystemExit(f"{self.mode}: this rival has no such answer")
        self.vertices, self.faces = read_ply(mesh)
        self.points = np.load(cloud)
        self.threads, self.repeat = int(threads), int(repeat)
        self.signed = self.mode == "signed"

    def report(self, build, query, answers):
        """Times `build()` once and `query(built)` as often as asked; `answers(result)` makes the array, untimed."""
        lap, built = timed(build)
        wall, cpu, result = [], [], None
        for _ in range(self.repeat):
            result = None  # freed first
            (w, c), result = timed(lambda: query(built))
            wall.append(w)
            cpu.append(c)
        np.asarray(answers(result), np.float64).tofile(self.out)
        print(json.dumps({"build_s": lap[0], "build_cpu_s": lap[1], "query_s": wall, "cpu_s": cpu}))


def timed(work):
    """((wall, process CPU) seconds, result)."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = work()
    return (time.perf_counter() - wall, time.process_time() - cpu), result
