//! Reading speed: `read FILE THREADS REPEAT` reads a mesh (and welds it) or a cloud and says how long that took.

use std::path::Path;
use trueness_bench::{Result, timed};
use trueness_files::{Body, ReadOptions};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [path, threads, repeat] = words.as_slice() else { return Err("usage: FILE THREADS REPEAT".into()) };
    rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    let (mut wall, mut cpu, mut items) = (vec![], vec![], 0);
    for _ in 0..repeat.parse()? {
        let (lap, count) = timed(|| read(Path::new(path)));
        items = count?;
        wall.push(lap.wall);
        cpu.push(lap.cpu);
    }
    println!("{}", serde_json::json!({ "items": items, "query_s": wall, "cpu_s": cpu }));
    Ok(())
}

/// Number of facets or of points; points are looked at block by block and not kept.
fn read(path: &Path) -> Result<usize> {
    match trueness_files::open(path, &ReadOptions::default())?.body {
        Body::Mesh(source) => Ok(source.mesh.faces.len()),
        Body::Splines(_) | Body::Cad(_) | Body::Drawing(_) => Err("expected a mesh or points".into()),
        Body::Points(mut stream) => {
            let (mut block, mut count) = (vec![], 0);
            loop {
                stream.next_block(&mut block)?;
                if block.is_empty() {
                    return Ok(count);
                }
                count += block.len();
            }
        }
    }
}
