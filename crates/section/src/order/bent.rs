//! Slabs of a cloud across which a surface bends: the effect on radii.
//!
//! The section of a ball of radius `R` by a slab of thickness `t` about its middle holds points of all circles in the
//! slab. They lie `h² / 2R` inside of the great circle at a height
//! `h`. The circle through all is too small by the mean of that, `t² / 24R`. The points tell it: their distances from
//! the arc follow the squares of their heights.

use crate::model::result::{Contour, Geometry};

/// An arc of a cloud whose points lie the farther in, or out, the farther they are from the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bent {
    /// Number of the segment.
    pub segment: usize,
    /// Change of its radius by the slab, below 0 where it takes off.
    pub bias: f64,
    /// Uncertainty of the radius.
    pub uncertainty: f64,
}

/// Standard deviations from which on distances follow the squares of heights, and are no chance.
const MIN_SLOPE_SIGMAS: f64 = 4.0;
/// Fewest points that tell it.
const MIN_POINTS_TO_TELL_BEND: usize = 20;

/// The arcs of a contour whose radii a slab moves by more than their standard uncertainty. `heights` are those of the
/// contour's points above the plane, mm. Points left out as outliers do not count; where heights are all alike there is
/// none.
///
/// ```
/// use trueness_section::{Options, bent_across, contour};
/// // A ring of a ball, up and down by 1 mm: the radius of its middle is 10 mm.
/// let heights: Vec<f64> = (0..600).map(|i| f64::from(i * 37 % 201) / 100.0 - 1.0).collect();
/// let at = |(i, h): (usize, &f64)| {
///     let (sin, cos) = (i as f64 * std::f64::consts::TAU / 600.0).sin_cos();
///     let radius = (100.0 - h * h).sqrt();
///     [radius * cos, radius * sin]
/// };
/// let row: Vec<[f64; 2]> = heights.iter().enumerate().map(at).collect();
/// let options = Options { noise: Some(0.02), ..Options::default() };
/// let found = contour(&row, &options, &trueness_geom::progress::Silent).unwrap();
/// let bent = bent_across(&found, &heights);
/// assert!((bent[0].bias + 1.0 / 60.0).abs() < 1e-3);
/// ```
pub fn bent_across(contour: &Contour, heights: &[f64]) -> Vec<Bent> {
    let of = |(segment, own): (usize, &crate::Segment)| -> Option<Bent> {
        let Geometry::Arc { sweep, .. } = &own.geometry else { return None };
        let Some(crate::Uncertainty::Arc { radius: uncertainty, .. }) = own.uncertainty else {
            return None;
        };
        // Left of an arc that turns to the left is inside of it.
        let outward = -sweep.signum();
        let kept =
            |i: &usize| contour.labels[*i] as usize == segment && contour.outliers.binary_search(i).is_err();
        let points: Vec<[f64; 2]> = (0..contour.labels.len().min(heights.len()))
            .filter(kept)
            .map(|i| [heights[i] * heights[i], outward * contour.residuals[i]])
            .collect();
        let n = points.len() as f64;
        if points.len() < MIN_POINTS_TO_TELL_BEND {
            return None;
        }
        let [square, off] = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for [x, y] in &points {
            let (x, y) = (x - square, y - off);
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
        }
        let slope = xy / xx;
        let chance = ((yy - slope * xy).max(0.0) / (n - 2.0) / xx).sqrt();
        let bias = slope * square;
        let significant = slope.abs() > MIN_SLOPE_SIGMAS * chance && bias.abs() > uncertainty;
        significant.then_some(Bent { segment, bias, uncertainty })
    };
    contour.segments.iter().enumerate().filter_map(of).collect()
}
