//! Curves whose curvature grows between arcs and lines: where they begin and end, and how long they are.

use super::*;

/// Points along pieces of linear curvature, each with its length and the curvatures at its ends, `spacing` apart.
fn along(pieces: &[(f64, [f64; 2])], spacing: f64, noise: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let whole: f64 = pieces.iter().map(|p| p.0).sum();
    let fine = 400;
    let count = (whole / spacing) as usize;
    let step = whole / (count * fine) as f64;
    let curvature = |s: f64| {
        let mut before = 0.0;
        for (length, [a, b]) in pieces {
            if s <= before + length {
                return a + (b - a) * (s - before) / length;
            }
            before += length;
        }
        0.0
    };
    let (mut at, mut heading, mut all) = ([0.0, 0.0], 0.0, vec![]);
    for i in 0..=count * fine {
        if i % fine == 0 {
            all.push(at.map(|x: f64| x + noise * normal(random)));
        }
        let turn = step * curvature((i as f64 + 0.5) * step);
        let (s, c) = libm::sincos(heading + 0.5 * turn);
        at = [at[0] + step * c, at[1] + step * s];
        heading += turn;
    }
    all
}

/// The stated length of a clothoid holds the true one as often as it says, and is never more uncertain than the contour
/// is long. Where the curvature grows from that of the neighbor, the points locate the join by the square root of their
/// noise alone.
#[test]
fn lengths_of_clothoids_are_as_uncertain_as_stated() {
    let random = &mut Random::new(12);
    let (mut held, mut stated, mut other_kinds) = (0, 0, 0);
    let count = 16;
    for k in 0..count {
        let mut between = |a: f64, b: f64| a + (b - a) * random.unit();
        let (radius, length) = (between(15.0, 40.0), between(12.0, 30.0));
        let first = [1.0 / radius, 0.0][k % 2];
        let last = [-1.0, 1.0][k % 2] / radius;
        let own = [between(15.0, 30.0), between(15.0, 30.0)];
        let pieces = [(own[0], [first; 2]), (length, [first, last]), (own[1], [last; 2])];
        let points = along(&pieces, 0.5, 0.005, random);
        let found = found(&points);
        let whole: f64 = pieces.iter().map(|p| p.0).sum();
        for s in &found.segments {
            let least = s.length_uncertainty.unwrap_or(0.0);
            assert!(least < 0.5 * whole, "{k}: {} ± {least}", s.length);
        }
        let [_, middle, _] = &found.segments[..] else {
            other_kinds += 1;
            continue;
        };
        let Some(own) = middle.length_uncertainty.filter(|_| middle.geometry.kind() == SegmentKind::Spline)
        else {
            other_kinds += 1;
            continue;
        };
        stated += 1;
        held += i32::from((middle.length - length).abs() <= 2.0 * own);
        println!(
            "{k}: {length} {} ± {own} {:?}",
            middle.length,
            found.joins.iter().map(|j| j.uncertainty).collect::<Vec<_>>()
        );
    }
    println!("{held} of {stated}, {other_kinds} of other kinds");
    assert!(10 * held >= 8 * stated && stated > 0, "{held} of {stated}");
}
