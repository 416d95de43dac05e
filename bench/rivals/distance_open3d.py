"""Open3D: RaycastingScene (Embree), single precision."""
import numpy as np
import open3d as o3d
from protocol import Job

job = Job()
points = o3d.core.Tensor(job.points.astype(np.float32))


def build():
    scene = o3d.t.geometry.RaycastingScene(nthreads=job.threads)
    scene.add_triangles(o3d.core.Tensor(job.vertices.astype(np.float32)), o3d.core.Tensor(job.faces.astype(np.uint32)))
    # The tree is made at the first question.
    scene.compute_distance(o3d.core.Tensor(np.zeros((1, 3), np.float32)))
    return scene


def query(scene):
    ask = scene.compute_signed_distance if job.signed else scene.compute_distance
    return ask(points, nthreads=job.threads)


job.report(build, query, lambda found: found.numpy())
