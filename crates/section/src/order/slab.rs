//! Points of a cloud near a plane, and the contours of those that were put in order.

use super::ways::Ordered;
use crate::measure::nominal::Outline;
use crate::model::result::{Contour, Options, SectionError};
use crate::row::contour::contour;
use std::collections::HashSet;
use trueness_geom::plane::{Plane, PlaneFrame};
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, dot, norm};

/// Numbers of the points in a slab around a plane, and their places in it. Points that hold no number are left out, and
/// so are those that fall upon an earlier one. Copies would let the points look nearer to each other than they are.
///
/// `thickness` is that of the slab, half on either side.
pub fn slab(
    points: &[Point],
    plane: &Plane,
    frame: &PlaneFrame,
    thickness: f64,
) -> (Vec<usize>, Vec<[f64; 2]>) {
    let reach = 0.5 * thickness * norm(plane.normal);
    let inside = |p: &Point| (dot(plane.normal, *p) - plane.offset).abs() <= reach;
    let mut seen = HashSet::new();
    let mut first = |p: &[f64; 2]| seen.insert(p.map(|x| (x + 0.0).to_bits()));
    let near = points.iter().enumerate().filter(|(_, p)| inside(p)).map(|(i, p)| (i, frame.flat(*p)));
    near.filter(|(_, p)| first(p)).unzip()
}

/// A contour that is so many times as long as the way along its points goes to and fro between them.
const MAX_LENGTH_RATIO: f64 = 2.0;

/// The contour of points in order that were found among `points` in the plane.
///
/// Points that cover an area follow no curve, as those of a slab that is thick for how obliquely it cuts. The segments
/// may be more than twice as long as the way along which the points were put in order. Or points scatter from one side
/// of the contour to the other. Then all segments are [`Contour::unreliable`].
///
/// # Errors
/// As [`contour`].
pub fn ordered_contour(
    points: &[[f64; 2]],
    row: &Ordered,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let own: Vec<[f64; 2]> = row.numbers.iter().map(|i| points[*i]).collect();
    let closed = options.closed.unwrap_or(row.closed);
    let options = Options { closed: Some(closed), ordered: true, ..*options };
    let mut found = contour(&own, &options, progress)?;
    if found.length() > MAX_LENGTH_RATIO * row.way || scatters_across(&found) {
        found.unreliable = (0..found.segments.len()).collect();
    }
    found.layered = row.layered;
    Ok(found)
}

/// Whether the band of two standard deviations on either side of a contour is too wide. It is wider than the mean width
/// within a closed one, or than half the length of an open one. Then nothing tells which points are of which side.
fn scatters_across(found: &Contour) -> bool {
    let (band, length) = (4.0 * found.rms(), found.length());
    if found.closed { band * length > 2.0 * Outline::of(found).area().abs() } else { 2.0 * band > length }
}

#[cfg(test)]
mod tests {
    use super::super::ways::order;
    use super::*;
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;

    /// Every point of a shuffled ring and a shuffled wave comes in order, though the scatter is three spacings.
    #[test]
    fn shuffled_contours_come_in_order() {
        let random = &mut Random::new(7);
        let mut points: Vec<([f64; 2], f64)> = vec![];
        for i in 0..1500 {
            let a = f64::from(i) * std::f64::consts::TAU / 1500.0;
            let (sin, cos) = libm::sincos(a);
            let r = 20.0 + 0.5 * (random.unit() - 0.5);
            points.push(([r * cos, r * sin], a));
        }
        for i in 0..600 {
            let x = f64::from(i) * 0.1;
            points.push(([x - 30.0, 40.0 + 3.0 * libm::sin(0.2 * x) + 0.1 * random.unit()], 100.0 + x));
        }
        (1..points.len()).rev().for_each(|i| points.swap(i, random.below(i as u64 + 1) as usize));
        let flat: Vec<[f64; 2]> = points.iter().map(|p| p.0).collect();
        let rows = order(&flat, None, &Silent).unwrap().rows;
        assert_eq!(
            rows.iter().map(|r| (r.numbers.len(), r.closed)).collect::<Vec<_>>(),
            [(1500, true), (600, false)]
        );
        for row in &rows {
            let along: Vec<f64> = row.numbers.iter().map(|i| points[*i].1).collect();
            let period = if row.closed { std::f64::consts::TAU } else { f64::INFINITY };
            let forward = along.windows(2).filter(|w| w[1] > w[0]).count() * 2 > along.len();
            // Back by no more than the scatter hides: half a millimeter.
            let most = if row.closed { 0.5 / 20.0 } else { 0.5 };
            for w in along.windows(2) {
                let step = if forward { w[1] - w[0] } else { w[0] - w[1] };
                let step = if period.is_finite() { step - period * (step / period).round() } else { step };
                assert!(step > -most && step < 3.0 * most, "{step}");
            }
        }
    }

    /// Points all over an area have no contours, at random or in a grid, with holes or not, few or many. Points of a
    /// thin band, of many rings and of a thick line have.
    #[test]
    fn an_area_has_no_contours() {
        let random = &mut Random::new(3);
        let fills = |points: &[[f64; 2]]| {
            let found = order(points, None, &Silent).unwrap();
            assert!(!found.fills_area || found.rows.is_empty());
            found.fills_area
        };
        for round in 0..20 {
            let [width, height] = [40.0, 10.0 + 30.0 * random.unit()];
            let count = 3000 + random.below(5000) as usize;
            let is_hole = |p: &[f64; 2]| round % 2 == 0 && libm::hypot(p[0] - 12.0, p[1] - 5.0) < 4.0;
            let mut area: Vec<[f64; 2]> =
                (0..count).map(|_| [width * random.unit(), height * random.unit()]).collect();
            area.retain(|p| !is_hole(p));
            assert!(fills(&area), "{round}, {count} over {height}");
            let rings: Vec<[f64; 2]> = (0..count)
                .map(|i| {
                    let (s, c) = libm::sincos(std::f64::consts::TAU * random.unit());
                    let r = 20.0 * (1 + i % 4) as f64 / 4.0 + 0.3 * random.unit();
                    [r * c, r * s]
                })
                .collect();
            assert!(!fills(&rings), "{round}, {count} on rings");
        }
        let grid = |rows: u32, step: f64, random: &mut Random| -> Vec<[f64; 2]> {
            let all =
                (0..300).flat_map(|i| (0..rows).map(move |j| [f64::from(i) * 0.1, f64::from(j) * step]));
            all.map(|[x, y]| [x, y + 0.01 * random.unit()]).collect()
        };
        assert!(fills(&grid(30, 0.1, random)) && !fills(&grid(3, 0.02, random)));
    }

    /// A regular grid is an area, at any pitch and attitude, and with a hole. Its rows are contours where they lie much farther apart than
    /// their points.
    #[test]
    fn a_regular_grid_is_an_area() {
        let fills = |rows: i32, [across, along]: [f64; 2], hole: f64, attitude: f64| {
            let (sin, cos) = libm::sincos(attitude);
            let all = (0..60).flat_map(|i| (0..rows).map(move |j| [f64::from(i - 30), f64::from(j - 20)]));
            let all = all.map(|[x, y]| [x * along, y * across]).filter(|[x, y]| libm::hypot(*x, *y) >= hole);
            let points: Vec<[f64; 2]> = all.map(|[x, y]| [x * cos - y * sin, x * sin + y * cos]).collect();
            order(&points, None, &Silent).unwrap().fills_area
        };
        for attitude in [0.0, 0.1, 0.5] {
            for pitch in [0.1, 0.5, 0.7] {
                assert!(fills(60, [pitch; 2], 0.0, attitude), "{pitch} {attitude}");
            }
            assert!(fills(60, [0.5, 0.5], 4.0, attitude), "{attitude}");
            assert!(!fills(60, [5.0, 0.5], 0.0, attitude), "{attitude}");
            assert!(!fills(1, [0.5, 0.5], 0.0, attitude), "{attitude}");
        }
    }

    /// A ring whose points scatter by more than a quarter of its radius is a disk. A row that does so by more than an
    /// eighth of its length has no direction.
    #[test]
    fn scatter_from_side_to_side_is_no_contour() {
        let contour = |sigma: f64, closed: bool| {
            let (random, count) = (&mut Random::new(7), if closed { 400 } else { 40 });
            let points: Vec<[f64; 2]> = (0..count)
                .map(|i| {
                    let off = sigma * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
                    let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(count));
                    if closed { [(10.0 + off) * c, (10.0 + off) * s] } else { [f64::from(i), off] }
                })
                .collect();
            let row =
                Ordered { numbers: (0..points.len()).collect(), closed, way: f64::INFINITY, layered: None };
            let options = Options { noise: Some(sigma), ..Options::default() };
            let found = ordered_contour(&points, &row, &options, &Silent).unwrap();
            (found.unreliable.len() == found.segments.len(), found.rms(), found.length())
        };
        for (sigma, closed, want) in
            [(1.0, true, false), (3.5, true, true), (1.0, false, false), (8.0, false, true)]
        {
            let (across, rms, length) = contour(sigma, closed);
            assert_eq!(across, want, "{sigma} {closed}: {rms} {length}");
        }
    }

    #[test]
    fn nothing_comes_of_nothing() {
        assert!(order(&[], None, &Silent).unwrap().rows.is_empty());
        assert!(order(&[[1.0, 2.0]; 50], None, &Silent).unwrap().rows.is_empty());
        // A gap divides, or not, as told.
        let line: Vec<[f64; 2]> =
            (0..200).map(|i| [f64::from(i) + if i < 100 { 0.0 } else { 20.0 }, 0.0]).collect();
        assert_eq!(order(&line, Some(3.0), &Silent).unwrap().rows.len(), 2);
        assert_eq!(order(&line, Some(30.0), &Silent).unwrap().rows.len(), 1);
    }
}
