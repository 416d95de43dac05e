//! Features that a drawing of a contour would have: relations between its lines and arcs, and whole numbers, as offers.
//!
//! The contour stays as it was found. Each offer is a condition on the segments found that the points allow, and that
//! chance alone would seldom meet. Near the best fit the sum of squares grows by the square of the condition's distance
//! in standard uncertainties, times the variance of the points. That is the likelihood ratio of nested models (S. S.
//! Wilks 1938), so nothing is fitted anew. The covariance is that of [`spread`]: of the points of each segment, under
//! the tangent joins.

mod offer;
mod relation;
mod spread;
#[cfg(test)]
mod tests;
mod whole;

use crate::model::result::Contour;
pub use offer::{Offer, OfferKind, Untidied};
use spread::Spread;

/// The offers for contours in one plane, whose points are `rows`, and why some have none. In the order of the first segment.
///
/// Segments `unreliable`, splines, and those without uncertainty take no part. Pairs of lines that are parallel, and of
/// arcs of one radius or center, are told with the first that there is, not with all. Cost: the cube of the segments of
/// a tangent chain, and the square of lines and of arcs. Where there are more than 200 lines, or arcs, the first 200
/// count.
///
/// ```
/// use trueness_geom::{num::random::Random, progress::Silent};
/// use trueness_section::{contour, tidy, OfferKind, Options};
/// let random = &mut Random::new(1);
/// let points: Vec<[f64; 2]> = (0..200).map(|i| libm::sincos(f64::from(i) * std::f64::consts::TAU / 200.0))
///     .map(|(s, c)| { let r = 5.0 + 0.002 * (random.unit() - 0.5); [r * c, r * s] }).collect();
/// let found = contour(&points, &Options::default(), &Silent).unwrap();
/// let (offers, _) = tidy(&[found], &[&points]);
/// assert!(offers[0].kind == OfferKind::Diameter && offers[0].offered == 10.0);
/// ```
pub fn tidy(contours: &[Contour], rows: &[&[[f64; 2]]]) -> (Vec<Offer>, Vec<Option<Untidied>>) {
    let spreads: Vec<Result<Spread, Untidied>> =
        contours.iter().zip(rows).map(|(c, row)| Spread::new(c, row)).collect();
    let mut offers = relation::all(contours, &spreads);
    offers.extend(whole::all(contours, &spreads));
    offers.sort_by(|a, b| (&a.of, a.kind).cmp(&(&b.of, b.kind)));
    (offers, spreads.into_iter().map(Result::err).collect())
}
