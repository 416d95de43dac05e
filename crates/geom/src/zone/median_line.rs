//! The extracted median line of a cylinder (ISO 17450-3:2016). It holds the centers of its sections across the associated axis,
//! each the center of the circle of least squares.

use super::sections::{MIN_POINTS_PER_RING, sections};
use crate::fit::{FitError, Method, Options, fit};
use crate::frame::Pose;
use crate::progress::{Cancelled, Progress};
use crate::shape::{Kind, Shape};
use crate::space::{Point, Vector, plus, times, unit};
use std::f64::consts::{PI, TAU};

/// The centers of the sections of a cylinder.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MedianLine {
    /// One for each section, in the order along the axis, mm.
    pub centers: Vec<Point>,
    /// Sections without a center: too few points, or half of the turn without any.
    pub excluded: usize,
}

/// The median line of the cylinder with the axis through `point` along `direction` (any length but 0), from its points (mm).
///
/// The sections are those of [`sections`]. They are rings where the points lie in such. Else they are up to 24 of equal height,
/// and then a bend shorter than a section is not seen. A point that is not finite belongs to none. Cost: `n log n`.
///
/// # Errors
/// [`Cancelled`].
///
/// ```
/// use trueness_geom::{progress::Silent, zone::median_line};
/// let ring = |x: f64, z: f64| (0..8).map(move |k| {
///     let (sin, cos) = (f64::from(k) * 0.25 * std::f64::consts::PI).sin_cos();
///     [x + 5.0 * cos, 5.0 * sin, z]
/// });
/// // A pin of three rings that is bent by 0.1 mm.
/// let pin: Vec<[f64; 3]> = ring(0.0, 0.0).chain(ring(0.1, 20.0)).chain(ring(0.0, 40.0)).collect();
/// let line = median_line(&pin, [0.0; 3], [0.0, 0.0, 1.0], &Silent)?;
/// assert!(line.excluded == 0 && (line.centers[1][0] - 0.1).abs() < 1e-12);
/// # Ok::<(), trueness_geom::progress::Cancelled>(())
/// ```
pub fn median_line(
    points: &[Point],
    point: Point,
    direction: Vector,
    progress: &dyn Progress,
) -> Result<MedianLine, Cancelled> {
    let Some((direction, _)) = unit(direction) else { return Ok(MedianLine::default()) };
    let frame = Pose::along(point, direction);
    let mut line = MedianLine::default();
    for section in sections(points, direction) {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let section: Vec<Point> = section.into_iter().map(|i| frame.local(points[i])).collect();
        match center(&section, progress)? {
            Some(center) => line.centers.push(global(&frame, center)),
            None => line.excluded += 1,
        }
    }
    Ok(line)
}

/// The place with these coordinates in a frame.
fn global(frame: &Pose, local: Point) -> Point {
    frame.axes.iter().zip(local).fold(frame.origin, |p, (axis, x)| plus(p, times(x, *axis)))
}

/// The center of a section, at its mean height. `None` where the points do not go around.
fn center(section: &[Point], progress: &dyn Progress) -> Result<Option<Point>, Cancelled> {
    if section.len() < MIN_POINTS_PER_RING {
        return Ok(None);
    }
    let flat: Vec<Point> = section.iter().map(|[x, y, _]| [*x, *y, 0.0]).collect();
    let options = Options { method: Method::Gaussian, ..Options::default() };
    let found = match fit(&flat, Kind::Circle2, &options, progress) {
        Err(FitError::Cancelled) => return Err(Cancelled),
        Err(_) => return Ok(None),
        Ok(found) => found,
    };
    let Shape::Circle2 { center: [x, y, _], .. } = found.shape else { return Ok(None) };
    let mut turns: Vec<f64> = flat.iter().map(|p| libm::atan2(p[1] - y, p[0] - x)).collect();
    turns.sort_by(f64::total_cmp);
    let around = turns.first().map_or(0.0, |first| first + TAU);
    let ends = turns.iter().skip(1).copied().chain([around]);
    if turns.iter().zip(ends).any(|(a, b)| b - a >= PI) {
        return Ok(None);
    }
    let height = section.iter().map(|p| p[2]).sum::<f64>() / section.len() as f64;
    Ok(Some([x, y, height]))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::disallowed_methods, clippy::unwrap_used)]
    use super::*;
    use crate::num::random::Random;
    use crate::progress::Silent;

    /// A bow of the axis, radius 5, length 100.
    fn bow(z: f64) -> f64 {
        0.2 * (PI * z / 100.0).sin()
    }

    fn scan(count: usize, sector: f64) -> Vec<Point> {
        let mut random = Random::new(7);
        let mut at = || {
            let (turn, z) = (sector * random.unit(), 100.0 * random.unit());
            [bow(z) + 5.0 * turn.cos(), 5.0 * turn.sin(), z]
        };
        (0..count).map(|_| at()).collect()
    }

    /// Each section of a scan has the bow of its height. Sections are 4 mm high, and the bow bends by less than 1e-4 within
    /// one.
    #[test]
    fn the_centers_of_a_bent_pin_lie_on_its_bow() {
        let line = median_line(&scan(20_000, TAU), [0.0; 3], [0.0, 0.0, 2.0], &Silent).unwrap();
        assert_eq!((line.centers.len(), line.excluded), (24, 0));
        for [x, y, z] in line.centers {
            assert!((x - bow(z)).abs() < 1e-3 && y.abs() < 1e-3, "{x} {y} {z}");
        }
    }

    /// Sections that do not go around have no center, and neither has a point that is not finite a section.
    #[test]
    fn half_a_pin_has_no_median_line() {
        let half = median_line(&scan(2000, 0.9 * PI), [0.0; 3], [0.0, 0.0, 1.0], &Silent).unwrap();
        assert!(half.centers.is_empty() && half.excluded == 24);
        let mut points = scan(2000, TAU);
        let sound = median_line(&points, [0.0; 3], [0.0, 0.0, 1.0], &Silent).unwrap();
        points.push([f64::NAN, 0.0, 0.0]);
        points.push([0.0, 0.0, f64::INFINITY]);
        assert_eq!(median_line(&points, [0.0; 3], [0.0, 0.0, 1.0], &Silent).unwrap(), sound);
        assert_eq!(median_line(&[], [0.0; 3], [0.0; 3], &Silent).unwrap(), MedianLine::default());
    }
}
