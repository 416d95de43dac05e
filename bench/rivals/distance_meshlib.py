"""MeshLib: PointsToMeshProjector, or findSignedDistances for signed ones, single precision. It always takes all threads."""
import meshlib.mrmeshnumpy as mn
import meshlib.mrmeshpy as mr
import numpy as np
from protocol import Job

job = Job()
single = np.ascontiguousarray(job.points, np.float32)
FAR, SAME_PLACE = 3.4e38, mr.AffineXf3f()


def unsigned():
    points, out = mn.fromNumpyArray(single), mr.std_vector_MeshProjectionResult()

    def build():
        mesh = mn.meshFromFacesVerts(job.faces, job.vertices)
        projector = mr.PointsToMeshProjector()
        projector.updateMeshData(mesh)
        # The tree is made at the first question.
        projector.findProjections(out, mn.fromNumpyArray(np.zeros((1, 3), np.float32)), SAME_PLACE, SAME_PLACE, FAR, 0.0)
        return mesh, projector

    def query(built):
        built[1].findProjections(out, points, SAME_PLACE, SAME_PLACE, FAR, 0.0)
        return out

    job.report(build, query, lambda found: [found[i].distSq ** 0.5 for i in range(len(single))])


def signed():
    points, all_of_them = mr.VertCoords(), mn.vertBitSetFromBools(np.ones(len(single), bool))
    points.vec = mn.fromNumpyArray(single)

    def build():
        mesh = mn.meshFromFacesVerts(job.faces, job.vertices)
        mr.findProjection(mr.Vector3f(0, 0, 0), mr.MeshPart(mesh))
        return mesh

    job.report(
        build,
        lambda mesh: mr.findSignedDistances(mesh, points, all_of_them),
        lambda found: [found.vec[i] for i in range(len(single))],
    )


signed() if job.signed else unsigned()
