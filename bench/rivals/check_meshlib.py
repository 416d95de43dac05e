"""MeshLib: loading (which welds) and the checks it has. `check_meshlib.py FILE THREADS REPEAT`; it takes all threads."""
import json
import sys

import meshlib.mrmeshpy as mr
from protocol import timed


def check(mesh):
    part, topology = mr.MeshPart(mesh), mesh.topology
    return {
        "holes": len(topology.findHoleRepresentiveEdges()),
        "components": len(mr.MeshComponents.getAllComponents(part)),
        "degenerate": mr.findDegenerateFaces(part, 1e6).count(),
        "multiple_edges": len(mr.findMultipleEdges(topology)),
        "self_intersecting": len(mr.findSelfCollidingTriangles(part)),
    }


path, _, repeat = sys.argv[1:]
line = {"load_s": [], "load_cpu_s": [], "query_s": [], "cpu_s": []}
for _ in range(int(repeat)):
    (wall, cpu), mesh = timed(lambda: mr.loadMesh(path))
    line["load_s"].append(wall)
    line["load_cpu_s"].append(cpu)
    (wall, cpu), found = timed(lambda: check(mesh))
    line["query_s"].append(wall)
    line["cpu_s"].append(cpu)
print(json.dumps({**line, "found": {name: count for name, count in found.items() if count}}))
