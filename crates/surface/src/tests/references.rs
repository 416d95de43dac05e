//! Every set of `corpus/reference_surfaces`.

use super::*;
use std::path::PathBuf;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../corpus/reference_surfaces")
}

pub fn points(file: &str) -> Vec<Point> {
    let text = std::fs::read_to_string(folder().join(file)).unwrap();
    let row = |l: &str| {
        let n: Vec<f64> = l.split_whitespace().map(|w| w.parse().unwrap()).collect();
        [n[0], n[1], n[2]]
    };
    text.lines().map(row).collect()
}

fn strict(knots: [Knots; 2]) -> Options {
    Options {
        layout: Layout::Knots(knots),
        base: BaseKind::Xy,
        fairness: Fairness::Weight(0.0),
        ..Options::default()
    }
}

#[test]
fn coefficients_are_those_of_fifty_digits() {
    let text = std::fs::read_to_string(folder().join("reference.txt")).unwrap();
    let lines: Vec<&str> = text.lines().filter(|l| !l.starts_with('#')).collect();
    assert_eq!(lines.len(), 24);
    for set in lines.chunks(4) {
        let words: Vec<&str> = set[0].split_whitespace().collect();
        let number = |k: usize| words[k].parse::<f64>().unwrap();
        let list = |k: usize| -> Vec<f64> {
            set[k].split_whitespace().skip(1).map(|w| w.parse().unwrap()).collect()
        };
        let knots = [3, 4].map(|k| Knots::new(number(k) as usize, list(k - 2)).unwrap());
        let expected = list(3);
        let found = fit(&points(words[1]), &strict(knots), &Silent).unwrap();
        let size = expected.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        for (control, z) in found.surface.points().iter().zip(&expected) {
            assert!(
                (control[2] - z).abs() <= 1e-9 * z.abs().max(1e-3 * size),
                "{}: {} {z}",
                words[1],
                control[2]
            );
        }
        assert_eq!(found.surface.points().len(), expected.len());
        assert!((found.sum_of_squares / number(6) - 1.0).abs() < 1e-9, "{}", words[1]);
        assert!((found.max_residual / number(8) - 1.0).abs() < 1e-9, "{}", words[1]);
    }
}

#[test]
fn the_example_of_fitpack_has_its_values() {
    // Output of `surfit` for its example data at these knots: weighted sum of squares and values of the surface.
    let inner = [-0.009520451471534103, -0.17704931080085376];
    let knots = inner.map(|t| Knots::clamped(3, -2.0, &[t], 2.0).unwrap());
    let found = fit(&points("dierckx_dasurf_80.txt"), &strict(knots), &Silent).unwrap();
    let sum = found.sum_of_squares / (0.0102569 * 0.0102569);
    assert!((sum / 299.1813095406522 - 1.0).abs() < 1e-9, "{sum}");
    let values = [
        0.13143556472292728,
        0.3969069349659006,
        0.1366552319311695,
        0.37781878712372907,
        0.9446356220945044,
        0.38783505205222063,
        0.1485848494950616,
        0.3859176178763195,
        0.15419963118991084,
    ];
    for (k, value) in values.into_iter().enumerate() {
        let (x, y) = ((k / 3) as f64 - 1.0, (k % 3) as f64 - 1.0);
        assert!((found.surface.at(x, y)[2] - value).abs() < 1e-10, "{x} {y}");
    }
}
