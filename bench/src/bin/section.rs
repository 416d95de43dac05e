//! Sections of a mesh by parallel planes, by this project: `section MESH PLANES THREADS REPEAT`.
//!
//! The planes lie across z, evenly from the lowest to the highest vertex, half a step off both. Chains alone: no segments are fitted.

use rayon::prelude::*;
use trueness_bench::{Result, read_mesh, timed};
use trueness_geom::{
    plane::Plane,
    progress::{Cancelled, Silent},
};
use trueness_section::{Chain, cut_facets, facets_near};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [mesh, planes, threads, repeat] = words.as_slice() else {
        return Err("usage: MESH PLANES THREADS REPEAT".into());
    };
    rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    let mesh = read_mesh(mesh)?;
    let heights = || mesh.positions.iter().map(|p| p[2]);
    let (low, high) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
    let count: usize = planes.parse()?;
    let at = |k: usize| low + (k as f64 + 0.5) / count as f64 * (high - low);
    let planes: Vec<Plane> = (0..count).map(|k| Plane { normal: [0.0, 0.0, 1.0], offset: at(k) }).collect();
    let work = || -> std::result::Result<Vec<Chain>, Cancelled> {
        let mut all = vec![];
        facets_near::<Cancelled>(&mesh, &planes, &Silent, |some| {
            let cut = |(k, own): (usize, Vec<u32>)| cut_facets(&mesh, &planes[k], &own, &Silent);
            let cut: std::result::Result<Vec<_>, _> = some.into_par_iter().map(cut).collect();
            all.extend(cut?.into_iter().flatten());
            Ok(())
        })?;
        Ok(all)
    };
    let (mut wall, mut cpu, mut loops, mut length) = (vec![], vec![], 0, 0.0);
    for _ in 0..repeat.parse()? {
        let (lap, found) = timed(work);
        let chains = found?;
        (loops, length) = (chains.len(), chains.iter().map(Chain::length).sum::<f64>());
        wall.push(lap.wall);
        cpu.push(lap.cpu);
    }
    println!(
        "{}",
        serde_json::json!({ "query_s": wall, "cpu_s": cpu, "loops": loops, "length": length, "facets": mesh.faces.len() })
    );
    Ok(())
}
