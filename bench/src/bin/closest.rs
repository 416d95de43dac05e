//! Distances from points to a mesh by this project: `closest MESH POINTS.npy OUT.f64 THREADS REPEAT MODE`.

use trueness_bench::{Job, Mode, Result, timed};
use trueness_geom::{
    closest::{Query, Signs, Tree, Winding},
    progress::Silent,
};

fn main() -> Result<()> {
    let job = Job::from_args()?;
    let (query, points) = (Query::default(), &job.points);
    let (lap, tree) = timed(|| Tree::build(&job.mesh));
    let tree = tree?;
    match job.mode {
        Mode::Unsigned => job.report(lap, || Ok(tree.distances(points, &query, &Silent)?)),
        Mode::Signed => {
            let (more, signs) = timed(|| Signs::new(&tree));
            job.report(lap.and(more), || Ok(signs.distances(points, &query, &Silent)?))
        }
        Mode::Winding => {
            let (more, winding) = timed(|| Winding::new(&tree));
            job.report(lap.and(more), || Ok(winding.numbers(points, &Silent)?))
        }
    }
}
