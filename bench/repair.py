"""Repairs broken files with trueness and with other programs and judges all results alike.

    python bench/repair.py --trueness target/release/trueness --python VENV/bin/python FILE…

The python given needs meshlib, pymeshfix, trimesh and numpy; admesh must be on the PATH. Files that are not STL become
binary STL first, so that all programs read the same. A result counts as sound when `trueness check` finds no defect in the file
written. Deviation is the largest distance of either surface from the other, at places no farther apart than a hundredth of
the diagonal, as a share of the diagonal. A vertex counts as gone when no facet of the result has a corner at its very place:
it was moved, joined with another, or its facets were removed. All but the first number of a row are of the files that its
program and trueness made sound.
"""
import argparse
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile

PROGRAMS = ["trueness", "meshlib", "pymeshfix", "admesh"]
HERE = pathlib.Path(__file__).parent


def run(words, seconds=120):
    try:
        return subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return None


def facets(path):
    """The corners of a binary STL file, three for each facet."""
    data = path.read_bytes()
    for at in range(84, len(data) - 49, 50):
        numbers = struct.unpack_from("<9f", data, at + 12)
        yield [tuple(x + 0.0 for x in numbers[k : k + 3]) for k in (0, 3, 6)]


def spread(path, step, out):
    """Writes places on all facets, at most `step` apart."""
    with open(out, "w") as file:
        for a, b, c in facets(path):
            n = min(max(1, math.ceil(max(math.dist(a, b), math.dist(b, c), math.dist(c, a)) / step)), 100)
            for i in range(n + 1):
                for j in range(n + 1 - i):
                    u, v, w = i / n, j / n, (n - i - j) / n
                    print(*(u * x + v * y + w * z for x, y, z in zip(a, b, c)), file=file)


def gone(before, after):
    """How many places of a file are not in the other."""
    before, after = ({p for f in facets(path) for p in f} for path in (before, after))
    return len(before - after)


class Judge:
    def __init__(self, trueness, python):
        self.trueness, self.python = trueness, python

    def repair(self, program, path, out):
        words = [self.python, HERE / "rivals/repair.py", program, path, out]
        if program == "trueness":
            words = [self.trueness, "repair", path, "-o", out]
        return run(words)

    def sound(self, path):
        found = run([self.trueness, "check", path])
        return found is not None and found.returncode == 0

    def deviation(self, a, b, step, folder):
        points = folder / "points.xyz"
        spread(a, step, points)
        found = run([self.trueness, "compare", points, b, "--sign", "none", "--json", "-"])
        if found is None or found.returncode > 1:
            return float("inf")
        return json.loads(found.stdout)["comparisons"][0]["deviation"]["all"]["max"]

    def judge(self, program, path, folder, diagonal):
        out = folder / f"{program}.stl"
        out.unlink(missing_ok=True)
        self.repair(program, path, out)
        if not out.exists() or out.stat().st_size <= 84:
            return {"sound": False, "gone": None, "deviation": None}
        step = diagonal / 100
        far = max(self.deviation(path, out, step, folder), self.deviation(out, path, step, folder))
        return {
            "sound": self.sound(out),
            "gone": gone(path, out),
            "deviation": far / diagonal,
        }


def as_stl(trueness, path, folder):
    """The file as binary STL in `folder`, and the length of its diagonal."""
    out = folder / "input.stl"
    run([trueness, "repair", path, "-o", out, "--only", "not_finite"])
    box = json.loads(run([trueness, "check", out, "--json", "-"]).stdout)["dimensions"]
    return out, sum(x * x for x in box) ** 0.5


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trueness", required=True)
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    judge = Judge(arguments.trueness, arguments.python)
    rows = {}
    for path in arguments.files:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            stl, diagonal = as_stl(arguments.trueness, path, folder)
            rows[path.name] = [judge.judge(p, stl, folder, diagonal) for p in PROGRAMS]
        cells = [f"{'sound' if r['sound'] else '-----'} {r['gone']} {r['deviation']}" for r in rows[path.name]]
        print(path.name, *cells, sep=" | ", flush=True)
    print(f"\n{len(rows)} files\n")
    print("| program | files made sound | vertices gone | of trueness there | largest deviation, mean | of trueness there |")
    print("|---|---|---|---|---|---|")
    for i, program in enumerate(PROGRAMS):
        made = sum(row[i]["sound"] for row in rows.values())
        both = [row for row in rows.values() if row[i]["sound"] and row[0]["sound"]]
        vertices = [sum(row[k]["gone"] for row in both) for k in (i, 0)]
        mean = [100 * sum(row[k]["deviation"] for row in both) / max(len(both), 1) for k in (i, 0)]
        print(f"| {program} | {made} of {len(rows)} | {vertices[0]} | {vertices[1]} | {mean[0]:.3f} % | {mean[1]:.3f} % |")


main()
