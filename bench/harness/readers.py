"""Reading files: seconds, and items (facets or points) a second."""
import os
import statistics

from . import program

COLUMNS = [
    ("file", None, "file"),
    ("items", None, "items"),
    ("wall s", ".3f", "query_s"),
    ("CPU s", ".3f", "cpu_s"),
    ("M items/s", ".2f", "per_s"),
    ("quiet M items/s", ".2f", "quiet_per_s"),
    ("peak MB", ".0f", "peak_mb"),
    ("noise", ".2f", "noise"),
]


def measure(reader, file, rounds, repeat, threads):
    """One row; a file that cannot be read ends the run."""
    runs = [program.run([*reader, file, str(threads), str(repeat)]) for _ in range(rounds)]
    wall = statistics.median(min(r["query_s"]) for r in runs)
    cpu = statistics.median(min(r["cpu_s"]) for r in runs)
    items = runs[0]["items"]
    return {
        "file": os.path.basename(file), "items": items, "query_s": wall, "cpu_s": cpu,
        "per_s": items / wall / 1e6, "quiet_per_s": items / (cpu / threads) / 1e6,
        "peak_mb": max(r["peak_mb"] for r in runs), "noise": statistics.median(r["noise"] for r in runs),
    }  # fmt: skip
