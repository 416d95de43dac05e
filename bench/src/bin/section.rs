//! Parallel planes through a mesh, and places of a curve: `section MESH COUNT THREADS REPEAT` or
//! `section curve POINTS.npy COUNT REPEAT`.
//!
//! Planes lie at equal distances across the mesh's height. `found` has the number of closed chains, and the area inside all of
//! them together, so that what was found can be compared. Of a curve, the cubic with the control points of the file and uniform
//! clamped knots: places and first derivatives at equal parameters, written to `POINTS.npy.f64`.

use rayon::prelude::*;
use trueness_bench::{Result, read_mesh, read_npy, timed};
use trueness_geom::{
    progress::Silent,
    section::{AT_ONCE, Plane, area, cut_facets, facets_near},
    spline::{basis::Knots, curve::Curve},
};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.as_slice() {
        [curve, points, count, repeat] if curve == "curve" => places(points, count.parse()?, repeat.parse()?),
        [mesh, count, threads, repeat] => {
            rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
            planes(mesh, count.parse()?, repeat.parse()?)
        }
        _ => Err("usage: MESH COUNT THREADS REPEAT, or curve POINTS.npy COUNT REPEAT".into()),
    }
}

fn planes(path: &str, count: usize, repeat: usize) -> Result<()> {
    let mesh = read_mesh(path)?;
    let heights = || mesh.positions.iter().map(|p| p[2]);
    let (low, high) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
    let step = (high - low) / (count + 1) as f64;
    let all: Vec<Plane> = (1..=count)
        .map(|k| Plane { normal: [0.0, 0.0, 1.0], offset: low + step * k as f64 })
        .collect();
    let (mut wall, mut cpu, mut found) = (vec![], vec![], (0, 0.0));
    for _ in 0..repeat {
        let (lap, sections) = timed(|| -> Result<Vec<_>> {
            let mut sections = vec![];
            for some in all.chunks(AT_ONCE) {
                let near = facets_near(&mesh, some, &Silent)?;
                let each = some.par_iter().zip(near).map(|(p, f)| cut_facets(&mesh, p, &f, &Silent));
                sections.extend(each.collect::<std::result::Result<Vec<_>, _>>()?);
            }
            Ok(sections)
        });
        let sections = sections?;
        wall.push(lap.wall);
        cpu.push(lap.cpu);
        let frame = all[0].frame().ok_or("no frame")?;
        let whole: f64 = sections.iter().map(|s| area(s, &frame)).sum();
        found = (sections.iter().flatten().filter(|c| c.closed).count(), whole);
    }
    let line = serde_json::json!({ "query_s": wall, "cpu_s": cpu, "chains": found.0, "area": found.1 });
    println!("{line}");
    Ok(())
}

fn places(path: &str, count: usize, repeat: usize) -> Result<()> {
    let points = read_npy(path)?;
    let knots = Knots::uniform(3, points.len() - 3, 0.0, 1.0);
    let curve = Curve::new(knots, points)?;
    let (mut wall, mut cpu, mut last) = (vec![], vec![], vec![]);
    for _ in 0..repeat {
        let (lap, found) = timed(|| -> Vec<[f64; 3]> {
            (0..count).flat_map(|k| curve.derivatives(k as f64 / (count - 1) as f64, 1)).collect()
        });
        wall.push(lap.wall);
        cpu.push(lap.cpu);
        last = found;
    }
    let bytes: Vec<u8> = last.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    std::fs::write(format!("{path}.f64"), bytes)?;
    println!("{}", serde_json::json!({ "query_s": wall, "cpu_s": cpu }));
    Ok(())
}
