"""Repairs one file with another program: `repair.py PROGRAM IN.stl OUT.stl`, PROGRAM one of meshlib, pymeshfix, admesh."""
import subprocess
import sys


def meshlib(path, out):
    """Everything that MeshLib offers for it, in the order of its own examples."""
    import meshlib.mrmeshpy as mr

    mesh = mr.loadMesh(path)
    diagonal = mesh.computeBoundingBox().diagonal()
    mr.uniteCloseVertices(mesh, 1e-6 * diagonal)
    mr.fixMultipleEdges(mesh)
    degenerate = mr.FixMeshDegeneraciesParams()
    degenerate.maxDeviation = 1e-5 * diagonal
    degenerate.tinyEdgeLength = 1e-6 * diagonal
    mr.fixMeshDegeneracies(mesh, degenerate)
    mr.SelfIntersections.fix(mesh, mr.SelfIntersections.Settings())
    for edge in mesh.topology.findHoleRepresentiveEdges():
        parameters = mr.FillHoleParams()
        parameters.metric = mr.getUniversalMetric(mesh)
        mr.fillHole(mesh, edge, parameters)
    if mesh.volume() < 0:
        mesh.topology.flipOrientation()
    mr.saveMesh(mesh, out)


def pymeshfix(path, out):
    import numpy as np
    import pymeshfix as pm
    import trimesh

    mesh = trimesh.load(path, force="mesh")
    fix = pm.MeshFix(np.asarray(mesh.vertices), np.asarray(mesh.faces))
    fix.repair(joincomp=True, remove_smallest_components=False)
    points = fix.points if hasattr(fix, "points") else fix.v
    faces = fix.faces if hasattr(fix, "faces") else fix.f
    trimesh.Trimesh(points, faces, process=False).export(out)


def admesh(path, out):
    subprocess.run(["admesh", path, f"--write-binary-stl={out}"], check=True, capture_output=True)


{"meshlib": meshlib, "pymeshfix": pymeshfix, "admesh": admesh}[sys.argv[1]](*sys.argv[2:])
