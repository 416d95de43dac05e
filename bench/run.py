#!/usr/bin/env python3
"""trueness beside Open3D, MeshLib and parry3d: same files, one session, ratios.

run.py closest --mesh MESH.ply [--points P.npy | --kind scan|far --count N] [--mode unsigned|signed|winding]
run.py read FILE…                    reading a mesh (and welding it) or a cloud
run.py compare MEASURED REFERENCE    the whole command, wall time and peak memory
run.py check MESH…                   loading, welding, checking, beside MeshLib and ADMesh
run.py fit [--only WORDS]            least-squares elements beside SciPy, minimum zones, on one thread
run.py surface [--only WORDS]        B-spline surfaces through a million points and more, beside FITPACK and G+Smo, on one thread
run.py section --mesh MESH.ply       1,000 planes through a mesh, beside trimesh and MeshLib
run.py curve                         B-spline curves on the same knots, beside SciPy and geomdl, on one thread
run.py table --data FOLDER           all of it, against the goals; FOLDER as `inputs.py all` makes it

See README.md. Ratios above 1 mean: the rival needs that many times longer than we do.
"""
import argparse
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import numpy as np  # noqa: E402
from harness import check, closest, command, data, fit, machine, readers, report, section, surface, table  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))


def main():
    o = arguments()
    tools = Tools(o)
    rows = {"closest": do_closest, "read": do_read, "compare": do_compare, "check": do_check, "fit": do_fit, "surface": do_surface, "section": do_section, "curve": do_curve, "table": do_table}[o.job](o, tools)
    if o.record:
        report.record(o.record, tools.describe(), o.date, rows)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    jobs = parser.add_subparsers(dest="job", required=True)
    shared = argparse.ArgumentParser(add_help=False)
    shared.add_argument("--rounds", type=int, default=3, help="how often every program is started, in turns")
    shared.add_argument("--repeat", type=int, default=3, help="how often it does its work each time")
    shared.add_argument("--threads", type=int, default=os.cpu_count())
    shared.add_argument("--against", default="open3d,meshlib,parry3d", help="rivals; empty for none")
    shared.add_argument("--add", action="append", default=[], metavar="NAME=COMMAND",
                        help="one more program with the command line of src/bin/closest.rs")  # fmt: skip
    shared.add_argument("--no-build", action="store_true", help="use the programs as they were built last")
    shared.add_argument("--record", metavar="FILE", help="add the figures to this file, one line of JSON each")
    shared.add_argument("--date", help="date of the run, for the record")
    one = jobs.add_parser("closest", parents=[shared])
    one.add_argument("--mesh", required=True, help="PLY as inputs.py writes it, or any mesh that trueness reads")
    one.add_argument("--points")
    one.add_argument("--kind", choices=("scan", "far"), default="scan")
    one.add_argument("--count", type=int, default=1_000_000)
    one.add_argument("--seed", type=int, default=1)
    one.add_argument("--mode", choices=("unsigned", "signed", "winding"), default="unsigned")
    one.add_argument("--heavy", action="store_true", help="rivals run once only")
    two = jobs.add_parser("read", parents=[shared])
    two.add_argument("files", nargs="+")
    three = jobs.add_parser("compare", parents=[shared])
    three.add_argument("measured")
    three.add_argument("reference")
    six = jobs.add_parser("check", parents=[shared])
    six.add_argument("meshes", nargs="+")
    five = jobs.add_parser("fit", parents=[shared])
    five.add_argument("--only", default="", help="cases whose name, like `cylinder 1000 near`, contains this")
    seven = jobs.add_parser("surface", parents=[shared])
    seven.add_argument("--only", default="", help="cases whose name, like `1000000 47 once`, contains this")
    eight = jobs.add_parser("section", parents=[shared])
    eight.add_argument("--mesh", required=True, help="PLY as inputs.py writes it")
    eight.add_argument("--planes", type=int, default=1000)
    jobs.add_parser("curve", parents=[shared])
    four = jobs.add_parser("table", parents=[shared])
    four.add_argument("--data", required=True)
    four.add_argument("--only", help="lines whose name contains this")
    o = parser.parse_args()
    if o.record and not o.date:
        parser.error("--record needs --date, the day of the run")
    return o


class Tools:
    """The programs that are measured, built if need be."""

    def __init__(self, o):
        self.python = sys.executable
        if not o.no_build:
            cargo("build", "--release", "--bins", folder=HERE)
        binary = lambda name: os.path.join(target(HERE), "release", name)
        rival = lambda name: [self.python, os.path.join(HERE, "rivals", f"{name}.py")]
        known = {"open3d": rival("distance_open3d"), "meshlib": rival("distance_meshlib"), "parry3d": [binary("parry")]}
        self.reader = [binary("read")]
        self.checkers = {"trueness": [binary("check")], "meshlib": rival("check_meshlib")}
        self.fitters = {"trueness": [binary("fit")], "scipy": rival("fit_scipy")}
        self.surfaces = {"trueness": [binary("surface")], **{n: [*rival("surface"), n] for n in ("fitpack", "gismo")}}
        self.sections = {"trueness": [binary("section")], **{n: [*rival("section"), n] for n in ("trimesh", "meshlib")}}
        self.curves = {"trueness": [binary("curve")], **{n: [*rival("curve"), n] for n in ("scipy", "geomdl")}}
        self.programs = {"trueness": [binary("closest")]}
        for added in o.add:
            name, _, words = added.partition("=")
            self.programs[name] = words.split()
        self.rivals = [r for r in o.against.split(",") if r]
        for name in self.rivals:
            if name not in known:
                raise SystemExit(f"--against {name}: known rivals are {', '.join(known)}")
            self.programs[name] = known[name]
        self._no_build = o.no_build

    def command_line(self):
        """The program itself, built from the project that this folder lies in."""
        root = os.path.dirname(HERE)
        if not self._no_build:
            cargo("build", "--release", "-p", "trueness", folder=root)
        return [os.path.join(target(root), "release", "trueness")]

    def describe(self):
        packages = machine.versions(self.python, ["open3d", "meshlib", "numpy", "scipy", "pygismo", "trimesh", "geomdl"])
        packages["parry3d"] = machine.crate_version(os.path.join(HERE, "Cargo.lock"), "parry3d")
        return {"machine": machine.describe(), "versions": packages}


def cargo(*words, folder):
    subprocess.run(["cargo", *words], cwd=folder, check=True)


def target(folder):
    return os.environ.get("CARGO_TARGET_DIR") or os.path.join(folder, "target")


def do_closest(o, tools):
    with tempfile.TemporaryDirectory() as folder:
        mesh, cloud = o.mesh, o.points
        if cloud is None:
            cloud = os.path.join(folder, f"{os.path.basename(mesh)}.{o.kind}.npy")
            np.save(cloud, data.points(*data.read_ply(mesh), o.kind, o.count, o.seed))
        programs = tools.programs
        if o.mode != "unsigned":
            programs = {n: c for n, c in programs.items() if n not in closest.RIVALS or o.mode == "signed"}
        rows = closest.measure(closest.Case(mesh, cloud, o.mode, o.heavy), programs, o.rounds, o.repeat, o.threads)
    print(f"\n{rows[0]['case']}, {rows[0]['points']} points, {o.threads} threads\n")
    print(report.markdown(rows, report.CLOSEST))
    return rows


def do_read(o, tools):
    rows = [readers.measure(tools.reader, file, o.rounds, o.repeat, o.threads) for file in o.files]
    print(report.markdown(rows, readers.COLUMNS))
    return rows


def do_compare(o, tools):
    rows = [command.measure(tools.command_line(), o.measured, o.reference, o.rounds, o.threads)]
    print(report.markdown(rows, command.COLUMNS))
    return rows


def do_check(o, tools):
    rows = []
    for mesh in o.meshes:
        rows += check.measure(mesh, tools.checkers, o.rounds, o.repeat, o.threads)
    print(report.markdown(rows, check.COLUMNS))
    return rows


def do_fit(o, tools):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for case in fit.CASES:
            shape, count, task, _, beside = case
            if o.only not in f"{shape} {count} {task}":
                continue
            path = os.path.join(folder, f"{shape}.npy")
            np.save(path, fit.points(shape, count))
            programs = tools.fitters if beside else {"trueness": tools.fitters["trueness"]}
            rows += fit.measure(case, path, programs, o.rounds, o.repeat)
    print(report.markdown(rows, fit.COLUMNS))
    return rows


def do_surface(o, tools):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for case in surface.CASES:
            count, spans, task, _, beside = case
            if o.only not in f"{count} {spans} {task}":
                continue
            path = os.path.join(folder, f"{count}.npy")
            if not os.path.exists(path):
                np.save(path, surface.points(count))
            programs = tools.surfaces if beside else {"trueness": tools.surfaces["trueness"]}
            rows += surface.measure(case, path, programs, o.rounds, o.repeat)
    print(report.markdown(rows, surface.COLUMNS))
    return rows


def do_section(o, tools):
    rows = section.stack(o.mesh, o.planes, tools.sections, o.rounds, o.repeat, o.threads)
    print(report.markdown(rows, section.COLUMNS))
    return rows


def do_curve(o, tools):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for case in section.CURVES:
            rows += section.curve(case, folder, tools.curves, o.rounds, o.repeat)
    print(report.markdown(rows, section.CURVE_COLUMNS))
    return rows


def do_table(o, tools):
    return table.run(o, tools)


if __name__ == "__main__":
    main()
