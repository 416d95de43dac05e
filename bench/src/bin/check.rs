//! Reading, welding and checking a mesh: `check FILE THREADS REPEAT [plain]`; `plain` leaves out the self-intersections.
//!
//! `core_s` is the time of what every checker does: topology, area and volume, self-intersections.

use std::path::Path;
use trueness_bench::{Lap, Result, timed};
use trueness_files::{Body, ReadOptions};
use trueness_geom::{
    check::{Options, check, intersect::self_intersections},
    mesh::Mesh,
    progress::Silent,
    topology::{Properties, Topology},
};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (path, threads, repeat, plain) = match words.as_slice() {
        [path, threads, repeat] => (path, threads, repeat, false),
        [path, threads, repeat, word] if word == "plain" => (path, threads, repeat, true),
        _ => return Err("usage: FILE THREADS REPEAT [plain]".into()),
    };
    let options = Options { self_intersections: !plain, ..Options::default() };
    rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    let (mut reading, mut checking, mut core, mut found) = (vec![], vec![], vec![], serde_json::Map::new());
    for _ in 0..repeat.parse()? {
        let (lap, input) = timed(|| trueness_files::open(Path::new(path), &ReadOptions::default()));
        let Body::Mesh(source) = input?.body else { return Err("expected a mesh, found points".into()) };
        reading.push(lap);
        let normals = source.stored_normals.as_deref();
        let (lap, report) = timed(|| check(&source.mesh, normals, &options, &Silent));
        checking.push(lap);
        core.push(timed(|| without_the_rest(&source.mesh, plain)).0);
        let counts = report?.defects.into_iter().filter_map(|(kind, found)| Some((kind.name, found?.count)));
        found = counts.filter(|(_, n)| *n > 0).map(|(name, n)| (name.to_string(), n.into())).collect();
    }
    let wall = |laps: &[Lap]| laps.iter().map(|l| l.wall).collect::<Vec<_>>();
    let cpu = |laps: &[Lap]| laps.iter().map(|l| l.cpu).collect::<Vec<_>>();
    let line = serde_json::json!({
        "load_s": wall(&reading), "load_cpu_s": cpu(&reading),
        "query_s": wall(&checking), "cpu_s": cpu(&checking), "core_s": wall(&core), "core_cpu_s": cpu(&core),
        "found": found,
    });
    println!("{line}");
    Ok(())
}

fn without_the_rest(mesh: &Mesh, plain: bool) -> Result<usize> {
    let topology = Topology::of(mesh)?;
    let properties = Properties::of(mesh, &topology);
    let pairs = if plain { vec![] } else { self_intersections(mesh, &topology, &Silent)? };
    Ok(pairs.len() + properties.shell_areas.len())
}
