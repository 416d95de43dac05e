//! Reading, welding and checking a mesh: `check FILE THREADS REPEAT`.

use std::path::Path;
use trueness_bench::{Lap, Result, timed};
use trueness_files::{Body, ReadOptions};
use trueness_geom::{
    check::{Options, check},
    progress::Silent,
};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [path, threads, repeat] = words.as_slice() else { return Err("usage: FILE THREADS REPEAT".into()) };
    rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    let (mut reading, mut checking, mut found) = (vec![], vec![], serde_json::Map::new());
    for _ in 0..repeat.parse()? {
        let (lap, input) = timed(|| trueness_files::open(Path::new(path), &ReadOptions::default()));
        let Body::Mesh(source) = input?.body else { return Err("expected a mesh, found points".into()) };
        reading.push(lap);
        let normals = source.stored_normals.as_deref();
        let (lap, report) = timed(|| check(&source.mesh, normals, &Options::default(), &Silent));
        checking.push(lap);
        let counts = report?.defects.into_iter().filter_map(|(kind, found)| Some((kind.name, found?.count)));
        found = counts.filter(|(_, n)| *n > 0).map(|(name, n)| (name.to_string(), n.into())).collect();
    }
    let wall = |laps: &[Lap]| laps.iter().map(|l| l.wall).collect::<Vec<_>>();
    let cpu = |laps: &[Lap]| laps.iter().map(|l| l.cpu).collect::<Vec<_>>();
    let line = serde_json::json!({
        "load_s": wall(&reading), "load_cpu_s": cpu(&reading),
        "query_s": wall(&checking), "cpu_s": cpu(&checking), "found": found,
    });
    println!("{line}");
    Ok(())
}
