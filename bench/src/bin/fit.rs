//! Elements by this project: `fit POINTS.npy SHAPE THREADS REPEAT near|global|zone`.
//!
//! `near`: least squares from an element that leans by 3 degrees and is 2 % off. `global`: without a start.
//! `zone`: minimum zone, without a start.

use trueness_bench::{Result, read_npy, timed};
use trueness_geom::{
    fit::{Method, Options, fit},
    progress::Silent,
    shape::{Kind, Shape},
    space::{Vector, cross, plus, times, unit},
};

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [points, shape, threads, repeat, task] = words.as_slice() else {
        return Err("usage: POINTS.npy SHAPE THREADS REPEAT near|global|zone".into());
    };
    rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    let solid = |k: &&Kind| k.name() == shape && !k.is_flat();
    let kind = *Kind::ALL.iter().find(solid).ok_or("no such shape")?;
    let points = read_npy(points)?;
    let mut options = Options::default();
    match task.as_str() {
        "near" => options.start = Some(off(fit(&points, kind, &options, &Silent)?.shape)),
        "zone" => options.method = Method::MinimumZone,
        "global" => {}
        other => return Err(format!("{other}: expected near, global or zone").into()),
    }
    let (mut wall, mut cpu, mut rms) = (vec![], vec![], 0.0);
    for _ in 0..repeat.parse()? {
        let (lap, found) = timed(|| fit(&points, kind, &options, &Silent));
        rms = found?.residuals.rms;
        wall.push(lap.wall);
        cpu.push(lap.cpu);
    }
    println!("{}", serde_json::json!({ "query_s": wall, "cpu_s": cpu, "rms": rms }));
    Ok(())
}

/// The element leaning by 3 degrees, and 2 % off in its sizes and by 2 % of them aside.
fn off(shape: Shape) -> Shape {
    let lean = |v: Vector| {
        let aside = unit(cross(v, [0.3, 0.5, -0.8])).map_or([1.0, 0.0, 0.0], |(u, _)| u);
        plus(times(3f64.to_radians().cos(), v), times(3f64.to_radians().sin(), aside))
    };
    let (larger, moved) = (1.02, |p, size: f64| plus(p, times(0.02 * size, [0.6, 0.8, 0.0])));
    match shape {
        Shape::Plane { point, normal } => Shape::Plane { point: moved(point, 10.0), normal: lean(normal) },
        Shape::Sphere { center, radius } => {
            Shape::Sphere { center: moved(center, radius), radius: larger * radius }
        }
        Shape::Cylinder { point, direction, radius } => Shape::Cylinder {
            point: moved(point, radius),
            direction: lean(direction),
            radius: larger * radius,
        },
        Shape::Cone { apex, direction, half_angle, point, radius } => Shape::Cone {
            apex: moved(apex, radius),
            direction: lean(direction),
            half_angle: larger * half_angle,
            point: moved(point, radius),
            radius: larger * radius,
        },
        Shape::Torus { center, direction, major_radius, minor_radius } => Shape::Torus {
            center: moved(center, major_radius),
            direction: lean(direction),
            major_radius: larger * major_radius,
            minor_radius: larger * minor_radius,
        },
        other => other,
    }
}
