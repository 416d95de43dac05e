"""A whole scan from many random poses: do all of them end at one pose, and is it that of an independent least-squares fit?

    python bench/poses.py --trueness PROGRAM [--poses 200] [--seed 1] [--reference reference.json] SCAN NOMINAL

The independent pose is that with the least integral of the squared distance from the nominal over the surface of the scan: 16 places
a facet, each weighted by its area, nearest places by trimesh, Newton's steps in Python. Each random pose turns the scan by a rotation
that is uniform over all rotations and shifts it by up to ten diagonals. What is told: the angle between the poses, the distance
between where they bring the middle of the part, and the greatest distance over all of its vertices. `--reference` adds a known
pose: a JSON object with rotation_rows and translation, from the part to the scan.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy as np
import trimesh
from scipy.spatial.transform import Rotation

from harness.pose import moved, pose_of


def trueness(program, folder, mesh, nominal):
    """The pose, and whether the program relies on it."""
    # 64-bit coordinates: a turned STL would be another part, rounded.
    path = folder / "scan.ply"
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh.vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
    head += f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    faces = np.zeros(len(mesh.faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, mesh.faces
    path.write_bytes(head.encode() + np.ascontiguousarray(mesh.vertices, "<f8").tobytes() + faces.tobytes())
    words = [program, "align", path, nominal, "--json", folder / "a.json", "--quiet"]
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode > 1:
        raise SystemExit(done.stderr)
    return np.array(json.loads((folder / "a.json").read_text())["transform"]), done.returncode == 0


def places(mesh, rows=4):
    """The middles of rows² equal parts of each facet, and their areas."""
    at = []
    for i in range(rows):
        for j in range(rows - i):
            at.append(((i + 1 / 3) / rows, (j + 1 / 3) / rows))
            if i + j + 1 < rows:
                at.append(((i + 2 / 3) / rows, (j + 2 / 3) / rows))
    a, b, c = (mesh.triangles[:, k] for k in range(3))
    points = [a + s * (b - a) + t * (c - a) for s, t in at]
    return np.vstack(points), np.tile(mesh.area_faces / len(at), len(at))


def independent(scan, nominal, pose):
    """The least-squares pose near `pose`, and its root mean square distance."""
    points, weights = places(scan)
    weights = weights / weights.sum()
    for _ in range(12):
        here = moved(pose, points)
        foot = np.empty_like(here)
        face = np.empty(len(here), int)
        for k in range(0, len(here), 100_000):
            foot[k : k + 100_000], _, face[k : k + 100_000] = trimesh.proximity.closest_point(nominal, here[k : k + 100_000])
        away = here - foot
        middle = here.mean(axis=0)
        normals = nominal.face_normals[face]
        rows = np.hstack([np.cross(here - middle, normals), normals])
        slopes = np.hstack([np.cross(here - middle, away), away])
        step = np.linalg.solve((rows * weights[:, None]).T @ rows, -(slopes * weights[:, None]).sum(axis=0))
        turn = pose_of(Rotation.from_rotvec(step[:3]).as_matrix(), np.zeros(3))
        turn[:3, 3] = middle - turn[:3, :3] @ middle + step[3:]
        pose = turn @ pose
        if np.abs(step[3:]).max() < 1e-9 and np.abs(step[:3]).max() < 1e-11:
            break
    return pose, float(np.sqrt((weights * (away**2).sum(axis=1)).sum()))


def apart(one, other, vertices):
    """Degrees between two poses; mm between where they bring the middle; the greatest of all vertices."""
    angle = np.degrees(Rotation.from_matrix(one[:3, :3] @ other[:3, :3].T).magnitude())
    between = moved(one, vertices) - moved(other, vertices)
    return angle, float(np.linalg.norm(between.mean(axis=0))), float(np.linalg.norm(between, axis=1).max())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trueness", required=True)
    parser.add_argument("--poses", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--reference", type=pathlib.Path)
    parser.add_argument("scan")
    parser.add_argument("nominal")
    o = parser.parse_args()
    scan, nominal = trimesh.load(o.scan, process=True), trimesh.load(o.nominal, process=True)
    diagonal = float(np.linalg.norm(nominal.extents))
    rng = np.random.default_rng(o.seed)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        given, relied = trueness(o.trueness, folder, scan, o.nominal)
        truth, rms = independent(scan, nominal, given)
        print(f"{len(scan.faces):,} facets, diagonal {diagonal:.4g}; independent pose: root mean square distance {rms:.6g}")
        show = lambda name, x: print(f"{name}: {x[0]:.2g} degrees, {x[1]:.2g} mm at the middle, {x[2]:.2g} mm at most", flush=True)
        show(f"given pose{'' if relied else ' (doubted)'} from independent", apart(given, truth, scan.vertices))
        if o.reference:
            known = json.loads(o.reference.read_text())
            known = np.linalg.inv(pose_of(np.array(known["rotation_rows"]), known["translation"]))
            show("given pose from the reference pose", apart(given, known, scan.vertices))
            show("independent from the reference pose", apart(truth, known, scan.vertices))
        found, doubted = [], 0
        for _ in range(o.poses):
            motion = pose_of(Rotation.random(random_state=rng).as_matrix(), rng.uniform(-10, 10, 3) * diagonal)
            turned = trimesh.Trimesh(moved(motion, scan.vertices), scan.faces, process=False)
            pose, relied = trueness(o.trueness, folder, turned, o.nominal)
            found.append(apart(pose @ motion, truth, scan.vertices))
            doubted += not relied
        found = np.array(found)
        show(f"worst of {o.poses} random poses from independent ({doubted} doubted)", found.max(axis=0))
        print(f"within 0.0005 degrees and 0.00015 mm (at most): {np.sum((found[:, 0] < 5e-4) & (found[:, 2] < 1.5e-4))} of {o.poses}")


main()
