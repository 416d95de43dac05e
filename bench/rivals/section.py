"""Sections by parallel planes by other programs: `section.py trimesh|meshlib MESH.ply PLANES THREADS REPEAT`.

The planes lie across z, evenly from the lowest to the highest vertex, half a step off both. `trimesh`: section_multiplane, whose
paths are linked. `meshlib`: extractPlaneSections with its tree, single precision; the tree is made before.
"""
import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import data  # noqa: E402
from protocol import timed  # noqa: E402


def trimesh(vertices, faces, heights):
    import trimesh as tm

    mesh = tm.Trimesh(vertices, faces, process=False)
    # What it keeps for later questions is made before the clock starts.
    mesh.section_multiplane([0, 0, 0], [0, 0, 1], heights[:1])

    def work():
        found = mesh.section_multiplane([0, 0, 0], [0, 0, 1], heights)
        return [path for path in found if path is not None]

    return work, lambda paths: (sum(len(p.entities) for p in paths), sum(p.length for p in paths))


def meshlib(vertices, faces, heights):
    import meshlib.mrmeshnumpy as mn
    import meshlib.mrmeshpy as mr

    mesh = mn.meshFromFacesVerts(faces, vertices)
    mesh.getAABBTree()
    planes = [mr.Plane3f(mr.Vector3f(0, 0, 1), float(h)) for h in heights]
    part = mr.MeshPart(mesh)
    work = lambda: [mr.extractPlaneSections(part, plane, mr.UseAABBTree.Yes) for plane in planes]
    return work, lambda found: (sum(len(sections) for sections in found), float("nan"))


def main():
    who, path, count, _, repeat = sys.argv[1:]
    vertices, faces = data.read_ply(path)
    low, high = vertices[:, 2].min(), vertices[:, 2].max()
    heights = low + (np.arange(int(count)) + 0.5) / int(count) * (high - low)
    work, about = {"trimesh": trimesh, "meshlib": meshlib}[who](vertices, faces, heights)
    wall, cpu, found = [], [], None
    for _ in range(int(repeat)):
        found = None
        (w, c), found = timed(work)
        wall.append(w)
        cpu.append(c)
    loops, length = about(found)
    print(json.dumps({"query_s": wall, "cpu_s": cpu, "loops": loops, "length": length}))


if __name__ == "__main__":
    main()
