"""All goals in one run: what is asked, what was measured, whether it is met.

A goal is met when wall time *or* processor time meets it: on a busy machine the one, on a machine whose processors share
execution units the other is the honest figure. Both stand in the table.
"""
import os

from . import check, closest, command, program, readers, report

# Cloud, how many times faster than Open3D, whether Open3D needs minutes for it.
AGAINST_OPEN3D = [
    ("rocker20k.scan1M", 8.0, False),
    ("bunny69k.scan1M", 6.5, False),
    ("arma346k.scan1M", 11.0, False),
    ("lucy1600k.scan1M", 12.0, False),
    ("lucy1600k.scan20M", 15.0, True),
    ("arma346k.far1M", 30.0, True),
]
OF_PROOF = 0.95
SIGNED_CLOUDS = ["rocker20k.scan1M", "arma346k.scan1M", "lucy1600k.scan1M"]
SIGNED_COST = 1.20
WINDING_CLOUD, WINDING_MPTS = "arma346k.scan1M", 0.5
XYZ_MPTS = 15.0
STL_SECONDS = 0.35


def run(o, tools):
    """Prints the tables and returns all rows."""
    print("Goals; ratios above 1 mean that the rival needs that many times longer.\n", flush=True)
    rows, goals = [], []
    wanted = lambda name: not o.only or o.only in name
    for cloud, goal, heavy in AGAINST_OPEN3D:
        if wanted(cloud):
            rows += _distances(o, tools, cloud, goal, heavy, goals)
    for cloud in SIGNED_CLOUDS:
        if wanted(cloud + " signed"):
            rows += _signed(o, tools, cloud, goals)
    if wanted(WINDING_CLOUD + " winding"):
        rows += _winding(o, tools, goals)
    if wanted("read"):
        rows += _reading(o, tools, goals)
    if wanted("check"):
        rows += _checking(o, tools, goals)
    if wanted("compare"):
        rows += _command(o, tools, goals)
    print("\n## Goals\n")
    print(report.markdown(goals, report.GOALS))
    return rows + goals


def _case(o, cloud, mode="unsigned", heavy=False):
    at = lambda name: os.path.join(o.data, name)
    return closest.Case(at(cloud.split(".")[0] + ".ply"), at(cloud + ".npy"), mode, heavy)


def _show(rows):
    print(f"\n### {rows[0]['case']}, {rows[0]['points']} points, {rows[0]['threads']} threads\n")
    print(report.markdown(rows, report.CLOSEST), flush=True)
    return rows


def _goal(goals, what, goal, wall, cpu, met):
    goals.append({"what": what, "goal": goal, "wall": wall, "cpu": cpu, "met": "" if goal == "–" else "met" if met else "MISSED"})


def _distances(o, tools, cloud, goal, heavy, goals):
    # MeshLib and parry3d on every small case; on the two that take minutes Open3D alone.
    programs = {n: c for n, c in tools.programs.items() if not heavy or n not in ("meshlib", "parry3d")}
    rows = _show(closest.measure(_case(o, cloud, heavy=heavy), programs, o.rounds, o.repeat, o.threads))
    for row in rows:
        wall, cpu = row["times_ours"], row["times_ours_cpu"]
        if row["program"] == "open3d":
            _goal(goals, f"{cloud}: times Open3D", f"≥ {goal:g}", wall, cpu, max(wall, cpu) >= goal)
        elif row["program"] == "proof":
            _goal(goals, f"{cloud}: of the proof", f"≥ {OF_PROOF:g}", wall, cpu, max(wall, cpu) >= OF_PROOF)
    return rows


def _signed(o, tools, cloud, goals):
    """Signed beside unsigned by the same program, in turns: the unsigned run stands in as another program."""
    ours, proof = tools.programs["trueness"], tools.programs.get("proof")
    rows = {"unsigned": [], "signed": []}
    rivals = {n: c for n, c in tools.programs.items() if n in ("open3d", "meshlib", "parry3d")}
    for mode in rows:
        programs = {"trueness": ours, **({"proof": proof} if proof else {}), **(rivals if mode == "signed" else {})}
        rows[mode] = closest.measure(_case(o, cloud, mode), programs, o.rounds, o.repeat, o.threads)
    _show(rows["signed"])
    wall, cpu = (rows["signed"][0][key] / rows["unsigned"][0][key] for key in ("query_s", "cpu_s"))
    _goal(goals, f"{cloud}: signed / unsigned", f"≤ {SIGNED_COST:g}", wall, cpu, min(wall, cpu) <= SIGNED_COST)
    return rows["signed"]


def _winding(o, tools, goals):
    programs = {n: c for n, c in tools.programs.items() if n in ("trueness", "proof")}
    rows = _show(closest.measure(_case(o, WINDING_CLOUD, "winding"), programs, o.rounds, 1, o.threads))
    wall, quiet = rows[0]["mpts_per_s"], rows[0]["quiet_mpts_per_s"]
    _goal(goals, "winding number, Mpts/s", f"≥ {WINDING_MPTS:g}", wall, quiet, max(wall, quiet) >= WINDING_MPTS)
    return rows


def _reading(o, tools, goals):
    large = os.path.join(o.data, "lucy1600k")
    files = [large + end for end in (".scan20M.xyz", ".scan20M.f32.ply", ".scan20M.f64.ply", ".stl", ".ply")]
    rows = [readers.measure(tools.reader, file, o.rounds, o.repeat, o.threads) for file in files]
    print("\n### Reading\n\n" + report.markdown(rows, readers.COLUMNS), flush=True)
    wall, quiet = rows[0]["per_s"], rows[0]["quiet_per_s"]
    _goal(goals, "XYZ text, Mpts/s", f"≥ {XYZ_MPTS:g}", wall, quiet, max(wall, quiet) >= XYZ_MPTS)
    wall, quiet = rows[3]["query_s"], rows[3]["cpu_s"] / o.threads
    _goal(goals, "STL 1.6 M read and weld, s", f"≤ {STL_SECONDS:g}", wall, quiet, min(wall, quiet) <= STL_SECONDS)
    return rows


def _checking(o, tools, goals):
    try:
        rows = check.measure(os.path.join(o.data, "lucy1600k.stl"), tools.checkers, o.rounds, 1, o.threads)
    except program.Failed as reason:
        print(f"!! check: {reason}")
        return []
    print("\n### Load, weld, check\n\n" + report.markdown(rows, check.COLUMNS), flush=True)
    for row in rows[1:]:
        _goal(goals, f"load and check: times {row['program']}", "–", row["times_ours"], row["times_ours_cpu"], True)
    return rows


def _command(o, tools, goals):
    large = os.path.join(o.data, "lucy1600k")
    try:
        trueness = tools.command_line()
        row = command.measure(trueness, large + ".scan20M.f32.ply", large + ".stl", o.rounds, o.threads)
    except program.Failed as reason:
        print(f"!! compare: {reason}")
        return []
    print("\n### Whole command\n\n" + report.markdown([row], command.COLUMNS), flush=True)
    _goal(goals, "compare 20 M points, s", "–", row["wall_s"], row["quiet_s"], True)
    return [row]
