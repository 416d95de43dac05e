//! Least-squares elements by this project: `fit POINTS.npy SHAPE THREADS REPEAT`, no start given.

use trueness_bench::{Result, read_npy, timed};
use trueness_geom::{
    fit::{Kind, Options, fit},
    progress::Silent,
};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [points, shape, threads, repeat] = words.as_slice() else {
        return Err("usage: POINTS.npy SHAPE THREADS REPEAT".into());
    };
    rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    let solid = |k: &&Kind| k.name() == shape && !k.is_flat();
    let kind = *Kind::ALL.iter().find(solid).ok_or("no such shape")?;
    let points = read_npy(points)?;
    let (mut wall, mut cpu, mut rms) = (vec![], vec![], 0.0);
    for _ in 0..repeat.parse()? {
        let (lap, found) = timed(|| fit(&points, kind, &Options::default(), &Silent));
        rms = found?.residuals.rms;
        wall.push(lap.wall);
        cpu.push(lap.cpu);
    }
    println!("{}", serde_json::json!({ "query_s": wall, "cpu_s": cpu, "rms": rms }));
    Ok(())
}
