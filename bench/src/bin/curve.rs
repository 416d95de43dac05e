//! B-spline curves by this project: `curve POINTS.npy SPANS COUNT THREADS REPEAT OUT.f64 at|derivatives|fit`, cubic, uniform knots on 0 to 1.
//!
//! `at`: places at COUNT parameters from 0 to 1 of the curve whose control points are given. `derivatives`: the first and the second
//! derivative there. `fit`: the control points of least squares through the points, at evenly spread parameters. OUT gets what was
//! found, row after row.

use trueness_bench::{Result, read_npy, timed};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::{Curve, Ends, fit};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [points, spans, count, _, repeat, out, task] = words.as_slice() else {
        return Err("usage: POINTS.npy SPANS COUNT THREADS REPEAT OUT.f64 at|derivatives|fit".into());
    };
    let points = read_npy(points)?;
    let knots = Knots::uniform(3, spans.parse()?, 0.0, 1.0);
    let evenly = |n: usize| -> Vec<f64> { (0..n).map(|i| i as f64 / (n - 1) as f64).collect() };
    let at = evenly(count.parse()?);
    let work: Box<dyn Fn() -> Result<Vec<f64>>> = match task.as_str() {
        "at" => {
            let curve = Curve::new(knots, points)?;
            Box::new(move || Ok(at.iter().flat_map(|t| curve.at(*t)).collect()))
        }
        "derivatives" => {
            let curve = Curve::new(knots, points)?;
            Box::new(move || {
                let of = |t: &f64| {
                    let mut all = [[0.0; 3]; 3];
                    curve.derivatives_into(*t, &mut all);
                    [all[1], all[2]]
                };
                Ok(at.iter().flat_map(of).flatten().collect())
            })
        }
        "fit" => Box::new(move || {
            let found = fit(&points, &evenly(points.len()), &knots, Ends::FREE, 0.0)?;
            Ok(found.curve.points().iter().flatten().copied().collect())
        }),
        other => return Err(format!("{other}: expected at, derivatives or fit").into()),
    };
    let (mut wall, mut cpu, mut last) = (vec![], vec![], vec![]);
    for _ in 0..repeat.parse()? {
        let (lap, found) = timed(&work);
        last = found?;
        wall.push(lap.wall);
        cpu.push(lap.cpu);
    }
    std::fs::write(out, last.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>())?;
    println!("{}", serde_json::json!({ "query_s": wall, "cpu_s": cpu }));
    Ok(())
}
