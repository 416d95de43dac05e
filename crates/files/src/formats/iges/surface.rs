//! One B-spline surface (entity 128). Control points run along `u` first.

use super::super::step::real;
use super::entry::{Entry, file};
use crate::cad::SplineSurface;
use std::io::{self, Write};

/// Writes the surface.
pub fn write(out: &mut dyn Write, surface: &SplineSurface) -> io::Result<()> {
    let most = surface.points.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let entry = Entry { kind: 128, level: 0, matrix: None, parameters: numbers(surface) };
    file(out, "B-spline surface", "surface", most, &[entry])
}

fn numbers(surface: &SplineSurface) -> Vec<String> {
    let ([m, n], [p, q]) = (surface.counts(), surface.degree);
    let mut all: Vec<String> = [m - 1, n - 1, p, q].map(|k| k.to_string()).to_vec();
    // Not closed in either direction, polynomial, not periodic.
    all.extend([0, 0, 1, 0, 0].map(|k| k.to_string()));
    all.extend(surface.knots.iter().flat_map(|k| k.iter().map(|t| real(*t))));
    all.extend(std::iter::repeat_n(real(1.0), m * n));
    all.extend((0..m * n).flat_map(|k| surface.point(k % m, k / m).map(real)));
    let domain = |k: usize| [surface.knots[k][surface.degree[k]], surface.knots[k][surface.counts()[k]]];
    all.extend([domain(0), domain(1)].concat().into_iter().map(real));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_has_eighty_columns_and_every_number_its_digits() {
        let knots = [0.0, 0.0, 1e-7, 1e22, 1e22];
        let points: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(k) / 3.0, -1e-300, 1.0]).collect();
        let surface = SplineSurface { degree: [1, 1], knots: [&knots, &knots], points: &points };
        let mut bytes = vec![];
        write(&mut bytes, &surface).unwrap();
        let file = String::from_utf8(bytes).unwrap();
        assert!(file.lines().all(|l| l.len() == 80));
        let parameters: String =
            file.lines().filter(|l| l.as_bytes()[72] == b'P').map(|l| l[..64].trim_end()).collect();
        let found: Vec<f64> =
            parameters.trim_end_matches(';').split(',').map(|x| x.parse().unwrap()).collect();
        assert_eq!(found.len(), 10 + 10 + 9 + 27 + 4);
        assert_eq!(found[10..15], knots);
        // The second point along u comes second.
        assert_eq!(found[29 + 3..29 + 6], points[3]);
        assert_eq!(found[56..], [0.0, 1e22, 0.0, 1e22]);
        let last = file.lines().last().unwrap();
        let lines = |section: u8| file.lines().filter(|l| l.as_bytes()[72] == section).count();
        assert_eq!(&last[..32], format!("S      1G{:>7}D      2P{:>7}", lines(b'G'), lines(b'P')));
    }
}
