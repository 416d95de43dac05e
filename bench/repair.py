"""Repairs broken files with trueness and with other programs and judges all results alike.

    python bench/repair.py --trueness target/release/trueness --python VENV/bin/python FILE…

The python given needs meshlib, pymeshfix, trimesh and numpy; admesh must be on the PATH. Files that are not STL become
binary STL first, so that all programs read the same. A result counts as sound when `trueness check` finds no defect in the file
written. Deviation is the largest of 20,000 samples each way, as a share of the diagonal. Vertices count as moved when
places of the input are gone and others have come: the lesser of the two numbers.
"""
import argparse
import json
import pathlib
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


def places(path):
    """The distinct vertices of a binary STL file."""
    data = path.read_bytes()
    corners = range(84, len(data) - 49, 50)
    zero = lambda b: b"\0\0\0\0" if b == b"\0\0\0\x80" else b
    place = lambda at: b"".join(zero(data[at + i : at + i + 4]) for i in (0, 4, 8))
    return {place(c + 12 + 12 * k) for c in corners for k in range(3)}


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

    def deviation(self, a, b):
        words = [self.trueness, "compare", a, b, "--sample", 20000, "--sign", "none", "--json", "-"]
        found = run(words)
        if found is None or found.returncode > 1:
            return float("inf")
        return json.loads(found.stdout)["comparisons"][0]["deviation"]["all"]["max"]

    def judge(self, program, path, folder, diagonal):
        out = folder / f"{program}.stl"
        out.unlink(missing_ok=True)
        self.repair(program, path, out)
        if not out.exists() or out.stat().st_size <= 84:
            return {"sound": False, "moved": None, "deviation": None}
        before, after = places(path), places(out)
        far = max(self.deviation(path, out), self.deviation(out, path))
        return {
            "sound": self.sound(out),
            "moved": min(len(before - after), len(after - before)),
            "deviation": far / diagonal,
        }


def as_stl(python, trueness, path, folder):
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
            stl, diagonal = as_stl(arguments.python, arguments.trueness, path, folder)
            rows[path.name] = [judge.judge(p, stl, folder, diagonal) for p in PROGRAMS]
        cells = [f"{'sound' if r['sound'] else '-----'} {r['moved']} {r['deviation']}" for r in rows[path.name]]
        print(path.name, *cells, sep=" | ", flush=True)
    common = [row for row in rows.values() if all(r["sound"] for r in row)]
    print(f"\n{len(rows)} files; {len(common)} made sound by all\n")
    print("| program | files made sound | vertices moved | largest deviation, mean over the files made sound by all |")
    print("|---|---|---|---|")
    for i, program in enumerate(PROGRAMS):
        own = [row[i] for row in rows.values()]
        sound, moved = sum(r["sound"] for r in own), sum(r["moved"] or 0 for r in own)
        mean = sum(row[i]["deviation"] for row in common) / max(len(common), 1)
        print(f"| {program} | {sound} of {len(rows)} | {moved} | {100 * mean:.3f} % |")


main()
