//! B-spline surfaces by this project: `surface POINTS.npy SPANS THREADS REPEAT once|auto`, bicubic, `SPANS` along both directions.
//!
//! `once`: one fit over x and y without a thin-plate term, and the distance of every point. `auto`: automatic fairness and three
//! corrections of the parameters.

use trueness_bench::{Result, read_npy, timed};
use trueness_geom::progress::Silent;
use trueness_surface::{BaseKind, Fairness, Layout, Options, fit};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [points, spans, threads, repeat, task] = words.as_slice() else {
        return Err("usage: POINTS.npy SPANS THREADS REPEAT once|auto".into());
    };
    rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    let spans: usize = spans.parse()?;
    let points = read_npy(points)?;
    let layout = Layout::Spans([spans, spans]);
    let options = match task.as_str() {
        "once" => {
            Options { layout, base: BaseKind::Xy, fairness: Fairness::Weight(0.0), ..Options::default() }
        }
        "auto" => Options { layout, corrections: 3, ..Options::default() },
        other => return Err(format!("{other}: expected once or auto").into()),
    };
    let (mut wall, mut cpu, mut rms) = (vec![], vec![], 0.0);
    for _ in 0..repeat.parse()? {
        let (lap, found) = timed(|| fit(&points, &options, &Silent));
        rms = (found?.sum_of_squares / points.len() as f64).sqrt();
        wall.push(lap.wall);
        cpu.push(lap.cpu);
    }
    println!("{}", serde_json::json!({ "query_s": wall, "cpu_s": cpu, "rms": rms }));
    Ok(())
}
