//! Lines (entity 110), arcs and circles (100) and B-splines (126) of a drawing, a level for each layer.
//!
//! Numbers are those of the drawing. A matrix (124) for each layer places its plane in space, unless that is the plane of the
//! first two axes. Arcs run counter-clockwise in IGES, so one of negative sweep is written from its end.

use super::super::step::real;
use super::entry::{Entry, file};
use crate::content::drawing::{Clamped, Entity, Layer, bounds, whole};
use std::io::{self, Write};
use trueness_geom::plane::PlaneFrame;

/// Writes a drawing.
pub fn write(out: &mut dyn Write, layers: &[Layer]) -> io::Result<()> {
    let mut entries = vec![];
    let mut most = 0.0f64;
    for (n, layer) in layers.iter().enumerate() {
        let Some([low, high]) = bounds(std::slice::from_ref(layer)) else { continue };
        let corners = [low, high, [low[0], high[1]], [high[0], low[1]]].map(|p| layer.frame.place(p));
        most = corners.iter().flatten().fold(most, |m, x| m.max(x.abs()));
        let matrix = (layer.frame != PlaneFrame::default()).then_some(entries.len());
        if matrix.is_some() {
            entries.push(Entry { kind: 124, parameters: placing(&layer.frame), ..Entry::default() });
        }
        entries.extend(layer.entities.iter().map(|e| {
            let (kind, parameters) = numbers(e);
            Entry { kind, level: n + 1, matrix, parameters, ..Entry::default() }
        }));
    }
    file(out, "curves of sections", "section", most, &entries)
}

/// Rows of the matrix that turns the axes, each with the origin's coordinate.
fn placing(frame: &PlaneFrame) -> Vec<String> {
    let normal = frame.normal();
    (0..3).flat_map(|k| [frame.x[k], frame.y[k], normal[k], frame.origin[k]]).map(real).collect()
}

fn numbers(entity: &Entity) -> (u32, Vec<String>) {
    let reals = |all: &[f64]| all.iter().map(|x| real(*x)).collect::<Vec<_>>();
    match entity {
        Entity::Line { start, end } => (110, reals(&[start[0], start[1], 0.0, end[0], end[1], 0.0])),
        Entity::Arc { center, radius, start, sweep } => {
            let at = |angle: f64| {
                let (sin, cos) = libm::sincos(angle);
                [center[0] + radius * cos, center[1] + radius * sin]
            };
            let (from, to) = if *sweep >= 0.0 { (*start, start + sweep) } else { (start + sweep, *start) };
            let from = at(from);
            // A circle ends where it starts, to the last bit.
            let to = if whole(*sweep) { from } else { at(to) };
            (100, reals(&[0.0, center[0], center[1], from[0], from[1], to[0], to[1]]))
        }
        Entity::Spline(Clamped { degree, knots, points }) => {
            let mut all: Vec<String> = [points.len() - 1, *degree].map(|k| k.to_string()).to_vec();
            // In a plane, not closed, polynomial, not periodic.
            all.extend([1, 0, 1, 0].map(|k| k.to_string()));
            all.extend(knots.iter().map(|t| real(*t)));
            all.extend(std::iter::repeat_n(real(1.0), points.len()));
            all.extend(points.iter().flat_map(|p| reals(&[p[0], p[1], 0.0])));
            all.extend(reals(&[knots[*degree], knots[points.len()], 0.0, 0.0, 1.0]));
            (126, all)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::content::drawing::tests::one_of_each;

    /// The entries point to their parameters and to the matrix, and these back to the entries.
    #[test]
    fn entries_and_parameters_point_to_each_other() {
        let [line, arc, circle, spline] = one_of_each([0.0, 0.0], [3.0, 4.0]);
        let frame = PlaneFrame { origin: [0.0, 0.0, 7.0], x: [0.0, 1.0, 0.0], y: [-1.0, 0.0, 0.0] };
        let flat = Layer { name: "section-1".into(), entities: vec![line], ..Layer::default() };
        let placed = Layer { name: "section-2".into(), frame, entities: vec![arc, circle, spline] };
        let mut bytes = vec![];
        write(&mut bytes, &[flat, placed]).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.lines().all(|l| l.len() == 80));
        let section = |letter: u8| text.lines().filter(move |l| l.as_bytes()[72] == letter);
        let entries: Vec<&str> = section(b'D').collect();
        let field = |line: &str, k: usize| line[8 * k..8 * k + 8].trim().parse::<usize>().unwrap();
        let kinds: Vec<usize> = entries.iter().step_by(2).map(|l| field(l, 0)).collect();
        assert_eq!(kinds, [110, 124, 100, 100, 126]);
        let parameters: Vec<&str> = section(b'P').collect();
        let mut first = 1;
        for (n, pair) in entries.chunks(2).enumerate() {
            assert_eq!(field(pair[0], 1), first);
            assert_eq!((field(pair[0], 4), field(pair[0], 6)), [(1, 0), (0, 0), (2, 3), (2, 3), (2, 3)][n]);
            let own = &parameters[first - 1..first - 1 + field(pair[1], 3)];
            assert!(own.iter().all(|l| field(l, 8) == 2 * n + 1), "{own:?}");
            let numbers: String = own.iter().map(|l| l[..64].trim_end()).collect();
            assert!(numbers.starts_with(&format!("{},", kinds[n])) && numbers.ends_with(';'), "{numbers}");
            if n == 3 {
                // The circle ends where it starts.
                let all: Vec<f64> =
                    numbers.trim_end_matches(';').split(',').map(|x| x.parse().unwrap()).collect();
                assert_eq!(all[4..6], all[6..8]);
            }
            first += own.len();
        }
    }
}
