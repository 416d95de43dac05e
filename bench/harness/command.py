"""The whole command `trueness compare MEASURED REFERENCE --json FILE`: wall time, processor time, peak memory."""
import os
import statistics
import tempfile

from . import program

COLUMNS = [
    ("measured", None, "measured"),
    ("reference", None, "reference"),
    ("wall s", ".2f", "wall_s"),
    ("CPU s", ".2f", "all_cpu_s"),
    ("quiet s", ".2f", "quiet_s"),
    ("peak MB", ".0f", "peak_mb"),
    ("noise", ".2f", "noise"),
]


def measure(trueness, measured, reference, rounds, threads):
    """One row of medians; `quiet_s` is what the processor time would be on that many idle threads."""
    with tempfile.TemporaryDirectory() as folder:
        document = os.path.join(folder, "result.json")
        words = ["compare", measured, reference, "--threads", str(threads), "--json", document]
        # 1 is an answer too: out of tolerance, or undecided.
        runs = [program.run([*trueness, *words], timeout=1200, accept=(0, 1)) for _ in range(rounds)]
        if not os.path.exists(document):
            raise program.Failed("compare wrote no result document")
    row = {key: statistics.median(r[key] for r in runs) for key in ("wall_s", "all_cpu_s", "noise")}
    row.update(
        measured=os.path.basename(measured), reference=os.path.basename(reference),
        quiet_s=row["all_cpu_s"] / threads, peak_mb=max(r["peak_mb"] for r in runs),
    )  # fmt: skip
    return row
