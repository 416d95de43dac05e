//! The contour of a row: the cheapest of those that several ways lead to.

use super::candidate::{Candidate, Proposer, Question};
use super::clean::check_row;
use super::direction::from_the_end;
use super::shared_noise::shared_noise;
use super::without_strays::WithoutStrays;
use super::{chains, corners, free_row, resolved, vertices};
use crate::model::budget::Budget;
use crate::model::crossings::crossings_with_loops;
use crate::model::prior::Prior;
use crate::model::result::{Contour, Options, SectionError};
use trueness_geom::progress::Progress;

/// The ways to a contour, in the order in which they are asked.
const PROPOSERS: [Proposer; 8] = [
    free_row::propose,
    vertices::propose,
    resolved::propose,
    chains::propose,
    resolved::propose_instead,
    from_the_other_end,
    corners::propose_circle,
    corners::propose,
];

/// Products that the searches of a row may take: a dozen seconds. Then the cheapest contour found so far is taken.
const MAX_PRODUCTS_PER_ROW: f64 = 1e10;
/// A loop of a contour is listed that is longer than so many distances between points: it goes by points of the row.
const MAX_LOOP_SPACINGS: f64 = 3.0;

/// The lines, arcs and curves of a row of points in order along a contour, and the joins between them, with their
/// uncertainties.
///
/// Corners are where neighboring parts of a first partition differ in heading; between corners, all joins are tangent.
/// The number and kinds of segments come from a penalized likelihood, the intervals from the likelihood with a join
/// held. The points are taken to scatter normally across the contour, all alike. A row given the other way round has
/// the same contour, the other way round. Points that repeat the one before, single points far off their neighbors'
/// course, and stray ones far off the row are left out and listed. Points that may be stray are [`Contour::doubtful`].
/// A search of more than a dozen seconds, as of spirals of many turns, ends with the cheapest contour so far. The
/// contour tells that it was cut short.
///
/// # Errors
/// [`SectionError`]: too few points, numbers that are none, points out of order, options without meaning.
///
/// ```
/// use trueness_section::{contour, SegmentKind, Options};
/// let line = (0..30).map(|i| [f64::from(i) - 30.0, 0.0]);
/// let arc = (0..30).map(|i| f64::from(i) * 0.05).map(|a| [20.0 * a.sin(), 20.0 - 20.0 * a.cos()]);
/// let points: Vec<[f64; 2]> = line.chain(arc).collect();
/// let found = contour(&points, &Options::default(), &trueness_geom::progress::Silent).unwrap();
/// let kinds: Vec<SegmentKind> = found.segments.iter().map(|s| s.geometry.kind()).collect();
/// assert_eq!(kinds, [SegmentKind::Line, SegmentKind::Arc]);
/// assert!(found.joins[0].point[0].abs() < 1e-3 && found.joins[0].point[1].abs() < 1e-6);
/// ```
pub fn contour(
    points: &[[f64; 2]],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    contour_within(MAX_PRODUCTS_PER_ROW, points, &Prior::of(options), options, progress)
}

/// The same of points whose noise is known.
pub(crate) fn contour_with(
    points: &[[f64; 2]],
    prior: &Prior,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    contour_within(MAX_PRODUCTS_PER_ROW, points, prior, options, progress)
}

/// The same with so many products for its searches.
pub(crate) fn contour_within(
    products: f64,
    points: &[[f64; 2]],
    prior: &Prior,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    check_row(points, options)?;
    let searched = WithoutStrays::of(points, options);
    let row = searched.row(points);
    let found =
        prior.among(searched.numbers(), |prior| in_direction(products, &row, &prior, options, progress))?;
    Ok(searched.whole(found, points))
}

/// The contour of a row without strays, looked for in its own direction.
fn in_direction(
    products: f64,
    points: &[[f64; 2]],
    prior: &Prior,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let from_the_end = from_the_end(points);
    let stated = [prior.noise.is_some(), prior.weights.is_some(), options.resolution.is_some()];
    let alike = match (stated.contains(&true), from_the_end) {
        (true, _) => None,
        (false, false) => shared_noise(points),
        (false, true) => shared_noise(&points.iter().rev().copied().collect::<Vec<_>>()),
    };
    let weights = alike.map(|(_, alike)| vec![1.0 / alike; points.len()]);
    let prior = &Prior {
        noise: prior.noise.or(alike.map(|(noise, _)| noise)),
        weights: prior.weights.or(weights.as_deref()),
        ..*prior
    };
    let budget = &Budget::new(products);
    let ask = |points: &[[f64; 2]], prior: Prior| {
        let question = Question::new(points, prior, options, budget)?;
        question.cheapest(&PROPOSERS, progress)?.ok_or(SectionError::Unreliable)
    };
    let mut found = match from_the_end {
        false => ask(points, *prior)?,
        true => turned(points, prior, ask)?.turned_round(points),
    };
    found.cut_short = budget.was_cut_short();
    found.keep_gaps(points);
    found.crossings =
        crossings_with_loops(&found.segments, found.closed, MAX_LOOP_SPACINGS * found.spacing, progress)?;
    Ok(found)
}

/// The answer for a row the other way round.
fn turned<R>(points: &[[f64; 2]], prior: &Prior, ask: impl FnOnce(&[[f64; 2]], Prior) -> R) -> R {
    let turned: Vec<[f64; 2]> = points.iter().rev().copied().collect();
    let back: Option<Vec<f64>> = prior.weights.map(|all| all.iter().rev().copied().collect());
    ask(&turned, Prior { weights: back.as_deref(), ..*prior })
}

/// A search that ended badly may end well from the other end.
fn from_the_other_end(
    question: &Question,
    best: Option<&Contour>,
    progress: &dyn Progress,
) -> Result<Option<Candidate>, SectionError> {
    if question.budget.is_spent(0.0) || best.is_some_and(|b| !question.doubts(b)) {
        return Ok(None);
    }
    let found = turned(question.points, &question.prior, |points, prior| {
        let other = Question::new(points, prior, question.options, question.budget)?;
        other.cheapest(&[chains::propose, resolved::propose_instead], progress)
    });
    Ok(found?.and_then(|found| Candidate::of(found.turned_round(question.points))))
}
