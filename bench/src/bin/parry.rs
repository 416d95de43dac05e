//! The rival parry3d, on all cores: `parry MESH POINTS.npy OUT.f64 THREADS REPEAT unsigned|signed`.

use parry3d::{
    math::Vector,
    query::PointQuery,
    shape::{TriMesh, TriMeshFlags},
};
use rayon::prelude::*;
use trueness_bench::{Job, Mode, Result, timed};
use trueness_geom::space::Point;

fn main() -> Result<()> {
    let job = Job::from_args()?;
    let signed = match job.mode {
        Mode::Unsigned => false,
        Mode::Signed => true,
        Mode::Winding => return Err("parry3d has no winding number".into()),
    };
    let (lap, mesh) = timed(|| {
        let corners = job.mesh.positions.iter().map(single).collect();
        let flags = if signed { TriMeshFlags::ORIENTED } else { TriMeshFlags::empty() };
        TriMesh::with_flags(corners, job.mesh.faces.clone(), flags)
    });
    let mesh = mesh?;
    job.report(lap, || {
        // Without `with_min_len` rayon hands out single points, which would be unfair to the rival.
        Ok(job.points.par_iter().with_min_len(2048).map(|p| distance(&mesh, p, signed)).collect())
    })
}

/// parry3d computes in single precision.
fn single(p: &Point) -> Vector {
    Vector::new(p[0] as f32, p[1] as f32, p[2] as f32)
}

fn distance(mesh: &TriMesh, p: &Point, signed: bool) -> f64 {
    let p = single(p);
    let nearest = mesh.project_local_point(p, !signed);
    let length = f64::from((nearest.point - p).length());
    if signed && nearest.is_inside { -length } else { length }
}
