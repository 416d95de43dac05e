"""Partial scans in random poses, aligned by trueness and by Open3D, and how long a whole scan takes all of them.

    python bench/align.py --trueness PROGRAM [--cuts 50] [--seed 1] SCAN NOMINAL

Of the scan a half-space keeps a share of its points: 70 % and 30 %, with and without a fifth of clutter (a table and a ball
beside the part). All get the same points in the same random pose; the nominal stays. Truth is the pose of the whole scan by
trueness, whose median residual is printed. A result is right where the points of the whole scan lie, by their median, within half a
percent of the diagonal of where the true pose brings them. Open3D: features (FPFH), RANSAC over their pairs, point-to-plane ICP, with a
voxel of a 60th of the diagonal. small_gicp has no start of its own: it begins a few degrees off, as does `--from-here` beside it.
trueness is timed as a whole process, with reading and writing; the others without.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile
import time

import numpy as np
import open3d as o3d
import small_gicp
import trimesh
from scipy.spatial.transform import Rotation

from harness.pose import moved, pose_of

REG = o3d.pipelines.registration


def random_pose(rng, size):
    return pose_of(Rotation.random(random_state=rng).as_matrix(), rng.normal(size=3) * size)


def trueness(program, folder, points, nominal, *options):
    """The pose, the seconds, and whether the program relies on it."""
    np.save(folder / "scan.npy", points)
    start = time.perf_counter()
    words = [program, "align", folder / "scan.npy", nominal, "--json", folder / "a.json", "--quiet", *options]
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    seconds = time.perf_counter() - start
    if done.returncode > 1:
        print(done.stderr)
        return np.eye(4), seconds, False
    found = json.loads((folder / "a.json").read_text())
    return np.array(found["transform"]), seconds, done.returncode == 0


class Open3D:
    def __init__(self, mesh, diagonal):
        self.voxel = diagonal / 60
        target = mesh.sample_points_uniformly(200_000)
        self.target = target
        target.estimate_normals(o3d.geometry.KDTreeSearchParamHybrid(radius=2 * self.voxel, max_nn=30))
        self.down, self.features = self.prepared(target)

    def prepared(self, cloud):
        down = cloud.voxel_down_sample(self.voxel)
        down.estimate_normals(o3d.geometry.KDTreeSearchParamHybrid(radius=2 * self.voxel, max_nn=30))
        wide = o3d.geometry.KDTreeSearchParamHybrid(radius=5 * self.voxel, max_nn=100)
        return down, REG.compute_fpfh_feature(down, wide)

    def align(self, points):
        start = time.perf_counter()
        cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
        down, features = self.prepared(cloud)
        limit = 1.5 * self.voxel
        checks = [
            REG.CorrespondenceCheckerBasedOnEdgeLength(0.9),
            REG.CorrespondenceCheckerBasedOnDistance(limit),
        ]
        rough = REG.registration_ransac_based_on_feature_matching(
            down, self.down, features, self.features, True, limit, REG.TransformationEstimationPointToPoint(False), 3,
            checks, REG.RANSACConvergenceCriteria(100_000, 0.999),
        )  # fmt: skip
        fine = REG.registration_icp(
            cloud, self.target, 0.4 * self.voxel, rough.transformation, REG.TransformationEstimationPointToPlane()
        )
        return np.asarray(fine.transformation), time.perf_counter() - start


def with_clutter(rng, points, diagonal):
    """A fifth as many points again: half of them on a table, half on a ball."""
    n = len(points) // 10
    side, middle = diagonal, points.mean(axis=0)
    way = Rotation.random(random_state=rng).as_matrix()
    table = np.c_[rng.uniform(-0.5, 0.5, (n, 2)) * side, np.full(n, -0.5 * side)] @ way.T + middle
    ball = rng.normal(size=(n, 3))
    ball = 0.1 * side * ball / np.linalg.norm(ball, axis=1)[:, None] + middle + way[:, 0] * 0.6 * side
    return np.vstack([points, table, ball])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trueness", required=True)
    parser.add_argument("--cuts", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("scan")
    parser.add_argument("nominal")
    o = parser.parse_args()
    scan = trimesh.load(o.scan, process=True).vertices.view(np.ndarray)
    nominal = trimesh.load(o.nominal)
    diagonal = float(np.linalg.norm(nominal.extents))
    rival = Open3D(o3d.io.read_triangle_mesh(o.nominal), diagonal)
    o3d.utility.random.seed(o.seed)
    o3d.utility.set_verbosity_level(o3d.utility.VerbosityLevel.Error)
    rng = np.random.default_rng(o.seed)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        truth, _, _ = trueness(o.trueness, folder, scan, o.nominal)
        at_home = moved(truth, scan)
        residual = np.median(np.abs(trimesh.proximity.closest_point(nominal, at_home[:: max(1, len(scan) // 2000)])[1]))
        print(f"{len(scan):,} points, diagonal {diagonal:.4g}; median residual of the whole scan {residual:.3g}")

        def right(pose, motion):
            return np.median(np.linalg.norm(moved(pose @ motion, at_home) - at_home, axis=1)) < 0.005 * diagonal

        for share in (0.7, 0.3):
            for clutter in (False, True):
                cases = []
                for _ in range(o.cuts):
                    along = at_home @ (lambda v: v / np.linalg.norm(v))(rng.normal(size=3))
                    part = at_home[along <= np.quantile(along, share)]
                    part = with_clutter(rng, part, diagonal) if clutter else part
                    motion = random_pose(rng, diagonal)
                    given = moved(motion, part)
                    ours, seconds, relied = trueness(o.trueness, folder, given, o.nominal)
                    theirs, their_seconds = rival.align(given)
                    cases.append((right(ours, motion), relied, seconds, right(theirs, motion), their_seconds))
                good, relied, seconds, theirs, their_seconds = map(np.array, zip(*cases))
                print(
                    f"{100 * share:.0f} % of the points{', a fifth of clutter' if clutter else ''}: trueness {good.sum()} of {o.cuts} right"
                    f" ({(~good & relied).sum()} wrong without a word, {(good & ~relied).sum()} right but doubted), {np.median(seconds):.2f} s;"
                    f" Open3D {theirs.sum()}, {np.median(their_seconds):.2f} s",
                    flush=True,
                )

        near = random_pose(rng, 0)
        near = pose_of(Rotation.from_rotvec([0.05, -0.04, 0.03]).as_matrix(), [0.01 * diagonal] * 3)
        motion = random_pose(rng, diagonal)
        ours, open3d, from_here, gicp = [], [], [], []
        target = np.asarray(rival.target.points)
        for _ in range(5):
            ours.append(trueness(o.trueness, folder, moved(motion, at_home), o.nominal)[1])
            pose, seconds = rival.align(moved(motion, at_home))
            open3d.append(seconds)
            from_here.append(trueness(o.trueness, folder, moved(near, at_home), o.nominal, "--from-here")[1])
            start = time.perf_counter()
            found = small_gicp.align(
                target, moved(near, at_home), downsampling_resolution=rival.voxel / 4, num_threads=2,
                max_correspondence_distance=0.05 * diagonal,
            )  # fmt: skip
            gicp.append(time.perf_counter() - start)
        off = np.median(np.linalg.norm(moved(found.T_target_source @ near, at_home) - at_home, axis=1))
        whole = [statistics.median(x) for x in (ours, open3d, from_here, gicp)]
        print(
            f"the whole scan: trueness {whole[0]:.2f} s, Open3D {whole[1]:.2f} s ({whole[1] / whole[0]:.1f} times); from a near pose: trueness"
            f" {whole[2]:.2f} s, small_gicp {whole[3]:.2f} s ({whole[3] / whole[2]:.1f} times), which ends {off:.3g} mm from there"
        )


main()
