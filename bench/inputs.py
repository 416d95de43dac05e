#!/usr/bin/env python3
"""Makes the inputs of the benchmarks.

inputs.py mesh SOURCE STEM [--loop N]     any mesh -> STEM.ply and STEM.stl: longest side 1000 mm, low corner at
                                          (500, 500, 500), N times Loop-subdivided, vertices rounded to float32
                                          (needs trimesh; --loop needs libigl)
inputs.py points MESH.ply OUT.npy [--kind scan|far] [--count N] [--seed N]
inputs.py clouds POINTS.npy STEM          the same points as STEM.f32.ply, STEM.f64.ply and STEM.xyz
inputs.py long POINTS.npy OUT.ply --count N   N points, more than there are: the same over again with noise
inputs.py all FOLDER                      everything that `run.py table` needs, from the source meshes in FOLDER
"""
import argparse
import os
import sys

sys.dont_write_bytecode = True
import numpy as np  # noqa: E402
from harness import data  # noqa: E402

# Source file in the folder, stem of what is made of it, subdivisions.
MESHES = [
    ("rocker-arm.obj", "rocker20k", 0),
    ("stanford-bunny.obj", "bunny69k", 0),
    ("armadillo.obj", "arma346k", 1),
    ("lucy.obj", "lucy1600k", 2),
]
MILLION = 1_000_000


def mesh(source, stem, loop=0, side=1000.0, corner=500.0):
    import trimesh

    found = trimesh.load(source, process=False, force="mesh")
    found.merge_vertices(merge_tex=True, merge_norm=True)
    vertices, faces = np.asarray(found.vertices, float), np.asarray(found.faces, np.int64)
    faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 0] != faces[:, 2])]
    if loop:
        import igl

        vertices, faces = igl.loop(vertices, faces, loop)[:2]
    low, high = vertices.min(0), vertices.max(0)
    vertices = ((vertices - low) * (side / (high - low).max()) + corner).astype(np.float32)
    data.write_ply(stem + ".ply", vertices, faces)
    data.write_stl(stem + ".stl", vertices, faces)
    print(f"{stem}: {len(vertices)} vertices, {len(faces)} triangles", flush=True)


def points(mesh_path, out, kind, count, seed=1):
    vertices, faces = data.read_ply(mesh_path)
    np.save(out, data.points(vertices, faces, kind, count, seed))
    print(f"{out}: {count} points", flush=True)


def clouds(source, stem):
    cloud = np.load(source, mmap_mode="r")
    data.write_ply_points(stem + ".f32.ply", cloud, "float")
    data.write_ply_points(stem + ".f64.ply", cloud, "double")
    data.write_xyz(stem + ".xyz", cloud)


def long(source, out, count):
    cloud, random = np.load(source, mmap_mode="r"), np.random.default_rng(60)

    class Repeated:
        """Looks like an array to the writer, which asks for slices in turn."""

        def __len__(self):
            return count

        def __getitem__(self, part):
            which = np.arange(part.start, min(part.stop, count)) % len(cloud)
            return cloud[which] + random.normal(0, 0.05, (len(which), 3))

    data.write_ply_points(out, Repeated())


def everything(folder):
    at = lambda name: os.path.join(folder, name)
    for source, stem, loop in MESHES:
        if not os.path.exists(at(stem + ".ply")):
            mesh(at(source), at(stem), loop)
        for kind in ("scan", "far"):
            if not os.path.exists(at(f"{stem}.{kind}1M.npy")):
                points(at(stem + ".ply"), at(f"{stem}.{kind}1M.npy"), kind, MILLION)
    large = at("lucy1600k.scan20M")
    if not os.path.exists(large + ".npy"):
        points(at("lucy1600k.ply"), large + ".npy", "scan", 20 * MILLION)
    if not os.path.exists(large + ".xyz"):
        clouds(large + ".npy", large)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    jobs = parser.add_subparsers(dest="job", required=True)
    one = jobs.add_parser("mesh")
    one.add_argument("source")
    one.add_argument("stem")
    one.add_argument("--loop", type=int, default=0)
    two = jobs.add_parser("points")
    two.add_argument("mesh")
    two.add_argument("out")
    two.add_argument("--kind", choices=("scan", "far"), default="scan")
    two.add_argument("--count", type=int, default=MILLION)
    two.add_argument("--seed", type=int, default=1)
    three = jobs.add_parser("clouds")
    three.add_argument("points")
    three.add_argument("stem")
    four = jobs.add_parser("long")
    four.add_argument("points")
    four.add_argument("out")
    four.add_argument("--count", type=int, required=True)
    five = jobs.add_parser("all")
    five.add_argument("folder")
    o = parser.parse_args()
    if o.job == "mesh":
        mesh(o.source, o.stem, o.loop)
    elif o.job == "points":
        points(o.mesh, o.out, o.kind, o.count, o.seed)
    elif o.job == "clouds":
        clouds(o.points, o.stem)
    elif o.job == "long":
        long(o.points, o.out, o.count)
    else:
        everything(o.folder)


if __name__ == "__main__":
    main()
