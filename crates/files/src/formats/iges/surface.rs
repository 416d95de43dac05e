//! One B-spline surface (entity 128), whole or cut into faces (144). Control points run along `u` first.
//!
//! A face names its surface and, for each bound, a curve on it (142). The curve has lines (110) in the parameters and B-splines (126) in
//! space, each in a composite curve (102), in the same order.

use super::super::step::real;
use super::entry::{Entry, file};
use crate::content::spline_surface::{Bound, SplineSurface};
use std::io::{self, Write};
use trueness_geom::spline::curve::Curve;

/// Writes the surface.
pub fn write(out: &mut dyn Write, surface: &SplineSurface) -> io::Result<()> {
    let most = surface.points.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let whole = surface.faces.is_empty();
    let status = if whole { "" } else { STATUS_DEPENDENT };
    let mut entries = vec![Entry { kind: 128, status, parameters: numbers(surface), ..Entry::default() }];
    for face in surface.faces {
        let outer = bound(&mut entries, &face.outer);
        let holes: Vec<usize> = face.holes.iter().map(|hole| bound(&mut entries, hole)).collect();
        // The surface, an outer bound of its own, the number of holes, and the bounds.
        let numbers = [1, 1, holes.len(), pointer(outer)].into_iter().chain(holes.into_iter().map(pointer));
        let parameters = numbers.map(|n| n.to_string()).collect();
        entries.push(Entry { kind: 144, parameters, ..Entry::default() });
    }
    file(out, "B-spline surface", "surface", most, &entries)
}

/// Status of an entity that only other entities use, and of one that they use in the parameters of a surface.
const STATUS_DEPENDENT: &str = "00010000";
const STATUS_IN_PARAMETERS: &str = "00010500";

/// How other entities name the one with this number, counted from 0: by its first line.
fn pointer(entry: usize) -> usize {
    2 * entry + 1
}

/// Adds a bound; its number.
fn bound(entries: &mut Vec<Entry>, bound: &Bound) -> usize {
    let next = bound.corners.iter().cycle().skip(1);
    let lines: Vec<Entry> = bound
        .corners
        .iter()
        .zip(next)
        .map(|(a, b)| {
            let parameters = [a[0], a[1], 0.0, b[0], b[1], 0.0].map(real).to_vec();
            Entry { kind: 110, status: STATUS_IN_PARAMETERS, parameters, ..Entry::default() }
        })
        .collect();
    let curves: Vec<Entry> = bound
        .sides
        .iter()
        .map(|side| Entry {
            kind: 126,
            status: STATUS_DEPENDENT,
            parameters: curve(side),
            ..Entry::default()
        })
        .collect();
    let in_parameters = composite(entries, lines, STATUS_IN_PARAMETERS);
    let in_space = composite(entries, curves, STATUS_DEPENDENT);
    // How it was made is not told; the surface; both curves, of which none is preferred.
    let parameters = [0, 1, pointer(in_parameters), pointer(in_space), 3].map(|n| n.to_string()).to_vec();
    entries.push(Entry { kind: 142, status: STATUS_DEPENDENT, parameters, ..Entry::default() });
    entries.len() - 1
}

/// Adds curves and a composite of them; its number.
fn composite(entries: &mut Vec<Entry>, parts: Vec<Entry>, status: &'static str) -> usize {
    let (first, count) = (entries.len(), parts.len());
    entries.extend(parts);
    let numbers = std::iter::once(count).chain((first..first + count).map(pointer));
    let parameters = numbers.map(|n| n.to_string()).collect();
    entries.push(Entry { kind: 102, status, parameters, ..Entry::default() });
    entries.len() - 1
}

fn curve(curve: &Curve<[f64; 3]>) -> Vec<String> {
    let points = curve.points();
    let mut all: Vec<String> = [points.len() - 1, curve.knots().degree()].map(|k| k.to_string()).to_vec();
    // Not in a plane, not closed, polynomial, not periodic.
    all.extend([0, 0, 1, 0].map(|k| k.to_string()));
    all.extend(curve.knots().values().iter().map(|t| real(*t)));
    all.extend(std::iter::repeat_n(real(1.0), points.len()));
    all.extend(points.iter().flatten().map(|x| real(*x)));
    let (from, to) = curve.domain();
    all.extend([from, to, 0.0, 0.0, 0.0].map(real));
    all
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
        let surface = SplineSurface { degree: [1, 1], knots: [&knots, &knots], points: &points, faces: &[] };
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
