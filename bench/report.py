"""What a report costs, and how long after Ctrl-C a run is over.

    python bench/report.py --trueness PROGRAM [--rounds 5] [--stops 20] SCAN REFERENCE

Compares SCAN with REFERENCE without and with `--html`, in turns, and prints the medians of the wall time, the size of the report
and what it shows. Then starts the run with the report again and again, interrupts it at even distances over its course, and prints
how long it took to end: median and greatest. The figures of a machine that does much else mean little.
"""
import argparse
import json
import pathlib
import re
import signal
import statistics
import subprocess
import tempfile
import time


def seconds(words):
    start = time.perf_counter()
    done = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode > 1:
        raise SystemExit(done.stderr)
    return time.perf_counter() - start


def shown(page):
    """What each object of a report shows of what was given."""
    text = re.search(r'id="manifest">(.*?)</script>', page.read_text(), re.S).group(1)
    said = []
    for o in json.loads(text)["objects"]:
        if o["kind"] in ("mesh", "points"):
            said.append(f"{o['role']}: {o['vertices']:,} of {o['source_vertices']:,} places")
    return "; ".join(said)


def end_after(words, wait):
    """Milliseconds from the interrupt to the end; None where the run was over before."""
    run = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(wait)
    if run.poll() is not None:
        return None
    start = time.perf_counter()
    run.send_signal(signal.SIGINT)
    run.wait()
    return 1000 * (time.perf_counter() - start)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--trueness", required=True)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--stops", type=int, default=20)
    parser.add_argument("scan")
    parser.add_argument("reference")
    args = parser.parse_args()
    plain = [args.trueness, "compare", args.scan, args.reference]
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder, "report.html")
        whole = [*plain, "--html", str(page)]
        times = [(seconds(plain), seconds(whole)) for _ in range(args.rounds + 1)][1:]
        without, within = (statistics.median(column) for column in zip(*times))
        print(f"without a report {without:.2f} s, with it {within:.2f} s, {page.stat().st_size / 1e6:.2f} MB; {shown(page)}")
        waits = [within * (k + 0.5) / args.stops for k in range(args.stops)]
        ends = [ms for ms in (end_after(whole, wait) for wait in waits) if ms is not None]
        print(f"over after Ctrl-C: {statistics.median(ends):.0f} ms, at most {max(ends):.0f} ms of {len(ends)}")


if __name__ == "__main__":
    main()
