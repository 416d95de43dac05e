//! Whole contours: corners first, then the chains between them, then corners as the places where chains cross.

use super::assembly::Joined;
use super::clean::{Clean, check_row};
use super::convert::segments;
use super::corner::crossing;
use super::corners::{Corners, is_round};
use super::exact::missed;
use super::free_row::free_form;
use super::levels::{MARGIN, SAME, Start, hidden};
use super::plan::{Chains, Plan, RESOLUTION};
use super::resolved::{Among, misses, resolved};
use super::sheet::Sheet;
use super::vertices::vertices;
use super::without::Searched;
use crate::num::special::student_quantile;
use crate::progress::Progress;
use crate::section::model::budget::Budget;
use crate::section::model::crossings::crossings_with_loops;
use crate::section::model::prior::{Known, Prior};
use crate::section::model::result::{Continuity, Contour, Join, Options, SectionError, Taken};
use crate::section::row::direction::from_the_end;
use crate::section::search::span::{Found, single};
use crate::section::search::start::noise;

/// Parts are searched whose chains cost no more than so much above the cheapest found: a search takes off some pieces, hardly more.
const FAR: f64 = 20.0;
/// A loop of a contour is told that is longer than so many distances between points: it goes by points of the row.
const LOOP: f64 = 3.0;
/// A crossing is followed this far from the chains' ends, in distances between points.
const FARTHEST: f64 = 20.0;

/// The lines, arcs and curves of a row of points in order along a contour, and the joins between them, with their
/// uncertainties.
///
/// Corners are where neighboring parts of a first partition differ in heading; between corners, all joins are tangent. The
/// number and kinds of segments come from a penalized likelihood, the intervals from the likelihood with a join held. The
/// points are taken to scatter normally across the contour, all alike. A row given the other way round has the same contour, the
/// other way round. Points that repeat the one before, single points far off what their neighbors tell, and stray ones far off the
/// row are left out and listed; points that may be stray are [`Contour::doubtful`]. A search of more than a dozen seconds ends with the cheapest contour so far, as of
/// spirals of many turns; the contour tells that it was cut short.
///
/// # Errors
/// [`SectionError`]: too few points, numbers that are none, points out of order, options without meaning.
///
/// ```
/// use trueness_geom::section::{contour, SegmentKind, Options};
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
    contour_within(PRODUCTS, points, &Prior::of(options), options, progress)
}

/// The same of points whose noise is known.
pub(crate) fn contour_with(
    points: &[[f64; 2]],
    prior: &Prior,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    contour_within(PRODUCTS, points, prior, options, progress)
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
    let searched = Searched::of(points, options);
    let row = searched.row(points);
    let found =
        prior.among(searched.numbers(), |prior| either_way(products, &row, &prior, options, progress))?;
    Ok(searched.whole(found, points))
}

/// The contour of a row without strays, from whichever end it is found better.
fn either_way(
    products: f64,
    points: &[[f64; 2]],
    prior: &Prior,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let turned: Vec<[f64; 2]> = points.iter().rev().copied().collect();
    let backward = from_the_end(points);
    let back: Option<Vec<f64>> = prior.weights.map(|all| all.iter().rev().copied().collect());
    let priors = [*prior, Prior { weights: back.as_deref(), ..*prior }];
    let rows = [(points, &priors[0]), (&turned[..], &priors[1])];
    let ways = if backward { [rows[1], rows[0]] } else { rows };
    if let Some(form) = prior.free_form
        && Known::given(options).is_none()
        && options.continuity.is_none()
        && let Some(found) = free_form(ways[0].0, form, options, progress)?
    {
        let found = if backward { found.turned_round(points) } else { found };
        return with_crossings(found, points, progress);
    }
    let budget = &Budget::new(products);
    let mut best = in_order(ways[0], options, budget, progress).map(|found| (found, backward));
    // A search that ended badly may end well from the other end.
    let is_bad = match &best {
        Ok((found, _)) => is_doubtful(found, points, prior),
        Err(e) => *e == SectionError::Astray,
    };
    if is_bad && !budget.is_spent(0.0) {
        let other = in_order(ways[1], options, budget, progress).map(|found| (found, !backward));
        best = match (best, other) {
            (_, Err(SectionError::Cancelled(e))) => return Err(e.into()),
            (Ok(a), Ok(b)) if rank(&b.0, points.len()) < rank(&a.0, points.len()) => Ok(b),
            (Err(_), other) => other,
            (best, _) => best,
        };
    }
    let (found, is_backward) = best?;
    let mut found = if is_backward { found.turned_round(points) } else { found };
    found.cut_short = budget.was_cut_short();
    with_crossings(found, points, progress)
}

/// A contour with where it crosses itself, and the gaps of its row.
fn with_crossings(
    found: Contour,
    points: &[[f64; 2]],
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let mut found = found;
    found.keep_gaps(points);
    found.crossings = crossings_with_loops(&found.segments, found.closed, LOOP * found.spacing, progress)?;
    Ok(found)
}

/// Products that the searches of a row may take: a dozen seconds. Then the cheapest found so far is taken.
const PRODUCTS: f64 = 3e10;

/// Noise of up to so many times that of rounding is rounding.
const ROUNDED: f64 = 3.0;

/// Points scatter about a contour this many times as much as about local fits where it hides form.
const DOUBTFUL: f64 = 1.3;

/// Whether segments of a contour are astray, or its points scatter more than about local fits.
fn is_doubtful(found: &Contour, points: &[[f64; 2]], prior: &Prior) -> bool {
    let own = prior.noise.map_or_else(|| noise(points, found.closed).0, |n| n.deviation);
    !found.astray.is_empty() || own > 0.0 && found.rms() > DOUBTFUL * own
}

/// By which of two contours of a row the one to take is told: segments astray first, then twice the negative logarithm of the
/// likelihood and the penalty for the unknowns.
fn rank(found: &Contour, count: usize) -> (usize, f64) {
    let (count, floor) = (count as f64, RESOLUTION * found.spacing);
    let off = found.rms();
    let cost = count * libm::log(off * off + floor * floor)
        + (found.unknowns + found.joins.len() as f64) * libm::log(count);
    (found.astray.len(), cost)
}

/// The contour of a row, found from its first point, or the polygon whose corners its points are where these speak for no other contour.
fn in_order(
    (points, prior): (&[[f64; 2]], &Prior),
    options: &Options,
    budget: &Budget,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let found = searched(points, prior, options, budget, progress);
    let free = prior.noise.is_none() && options.continuity.is_none() && options.resolution.is_none();
    // Points put in order, of a cloud or a scan, are none that somebody chose.
    let is_given = !options.ordered && matches!(found, Ok(_) | Err(SectionError::Astray));
    let Some(corners) = (if free && is_given { Corners::of(points, options) } else { None }) else {
        return found;
    };
    let found = found.ok();
    let noise = corners.off_a_circle(found.as_ref());
    let options = &Options { noise, ..*options };
    let circle = match noise {
        Some(_) => searched(points, &Prior::of(options), options, budget, progress).ok().filter(is_round),
        None => None,
    };
    Ok(corners.or(circle.or(found), options))
}

/// The contour that the search finds.
fn searched(
    points: &[[f64; 2]],
    prior: &Prior,
    options: &Options,
    budget: &Budget,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let clean = Clean::new(points, options)?;
    if progress.cancelled() {
        return Err(SectionError::Cancelled(crate::progress::Cancelled));
    }
    let free = prior.noise.is_none() && options.continuity.is_none();
    let mut start = Start::new(clean, prior, options);
    if free
        && !start.exact
        && options.resolution.is_none()
        && let Some(found) = by_vertices(points, options)
    {
        return Ok(found);
    }
    if free && let Some(found) = resolved(&start, options, Among::Rows) {
        return Ok(found.whole(points.len()));
    }
    let mut chains = start.plan(options, budget).chains(&start.parts, progress)?;
    let fine = start.fine();
    let mut finer = start.finer(options, fine, &chains.founds);
    while let Some(other) = finer.pop_front().filter(|_| !budget.is_spent(0.0)) {
        let bar = start.cost(&chains.founds);
        if !promises(&other, options, budget, bar, progress)? {
            continue;
        }
        let found = match other.plan(options, budget).chains(&other.parts, progress) {
            Err(SectionError::Cancelled(e)) => return Err(e.into()),
            Err(_) => continue,
            Ok(found) => found,
        };
        if found.founds.len() > 1
            && let Some(tangent) = other.tangent()
        {
            finer.push_front(tangent);
        }
        let gain = bar - other.cost(&found.founds);
        if gain.abs() < SAME && !other.tangent {
            // The search leads back to where it was.
            break;
        }
        let margin = if other.tangent { 0.0 } else { MARGIN };
        if gain > margin {
            (start, chains) = (other, found);
        }
    }
    let mut found = start.plan(options, budget).join(chains)?;
    // Points that are rounded lie on lines and circles by chance, and about them with a period.
    let is_rounded = found.contour.noise <= ROUNDED * start.clean.rounding;
    if prior.noise.is_none() && options.resolution.is_none() && !is_rounded {
        found.astray(missed(&start.clean.points, &found.contour));
        found.astray(fine.map_or(vec![], |fine| hidden(&found.contour, fine)));
    }
    let is_doubtful = free && (is_cornered(&found.contour) || misses(&found.contour, 0.0));
    let other = if is_doubtful { resolved(&start, options, Among::Contours) } else { None };
    if let Some(other) = other.filter(|r| r.is_better_than(&found.contour)) {
        return Ok(other.whole(points.len()));
    }
    found.finish(&start.clean, start.turned, points.len(), start.outliers);
    let mut contour = found.contour;
    // Outliers were brought in for the search: they are as far off as they lie.
    for k in contour.outliers.clone() {
        contour.residuals[k] = contour.segments[contour.labels[k] as usize].nearest(points[k]).distance;
    }
    Ok(contour)
}

/// The contour of a row of the ends of lines and the vertices of arcs, where it is one.
fn by_vertices(points: &[[f64; 2]], options: &Options) -> Option<Contour> {
    let clean = Clean::new(points, options).ok()?;
    let given: Vec<[f64; 2]> = clean.numbers.iter().map(|i| points[*i]).collect();
    let found = vertices(&clean.points, &given, clean.closed, options.closed == Some(false))?;
    let (rounding, polygon) = (found.rounding, found.polygon);
    let closed = polygon.closed;
    let contour = Sheet { points: &clean.points, polygon, rounding, options }.exact(&found.items);
    let mut all = Joined::of(Contour { taken: Taken::Row, ..contour });
    all.finish(&Clean { closed, ..clean }, 0, points.len(), vec![]);
    Some(all.contour)
}

/// Whether segments do not run along their points, or join in corners.
fn is_cornered(contour: &Contour) -> bool {
    !contour.astray.is_empty() || contour.joins.iter().any(|j| j.continuity == Continuity::G0)
}

/// Whether a search from these parts may lead to chains that cost less than `bar`: those of the parts as they are cost little more.
/// That takes a hundredth of the search.
fn promises(
    start: &Start,
    options: &Options,
    budget: &Budget,
    bar: f64,
    progress: &dyn Progress,
) -> Result<bool, SectionError> {
    if bar.is_infinite() {
        return Ok(true);
    }
    let plan = Plan { draft: true, ..start.plan(options, budget) };
    match plan.all(&start.parts, progress) {
        Err(SectionError::Cancelled(e)) => Err(e.into()),
        Err(_) => Ok(false),
        Ok(found) => Ok(start.cost(&found.founds) < bar + FAR),
    }
}

impl Plan<'_> {
    /// Puts the chains together.
    fn join(&self, chains: Chains) -> Result<Joined, SectionError> {
        let Chains { mut founds, cornered, .. } = chains;
        let closed = self.clean.closed;
        let count = founds.len();
        let mut all = Joined::default();
        let quantile = |f: &Found| {
            let degrees = (f.span.weights.iter().sum::<f64>() - 4.0).max(1.0)
                + self.known_noise.map_or(0.0, |n| n.degrees);
            student_quantile(1.0 - self.options.level, degrees)
        };
        let crossings: Vec<Option<Join>> = (0..count)
            .map(|k| {
                let last = k + 1 == count;
                if !cornered || last && !closed {
                    return None;
                }
                let (a, b) = (&founds[k], &founds[(k + 1) % count]);
                Some(crossing(a, b, quantile(a), FARTHEST * self.spacing * self.step as f64))
            })
            .collect();
        for k in 0..count {
            let before = match k {
                0 if closed => crossings[count - 1].as_ref(),
                0 => None,
                _ => crossings[k - 1].as_ref(),
            };
            let ends = [before.map(|j| j.point), crossings[k].as_ref().map(|j| j.point)];
            let found = &mut founds[k];
            all.add(found, segments(found, ends, self.spacing), self.clean.points.len());
            if let Some(join) = &crossings[k] {
                all.contour.joins.push(join.clone());
            } else if found.state.chain.closed && !single(&found.state) {
                // The join over the seam is the chain's first.
                all.contour.joins.rotate_left(1);
            }
        }
        let sum: f64 = all.contour.residuals.iter().zip(self.weights).map(|(r, w)| w * r * r).sum();
        let unknowns: f64 = founds.iter().map(Found::unknowns).sum();
        all.contour.unknowns = unknowns;
        all.contour.independent = self.weights.iter().sum();
        let degrees = (self.weights.iter().sum::<f64>() - unknowns).max(1.0);
        all.contour.noise = self.known_noise.map_or_else(
            || (sum / degrees).sqrt(),
            |n| ((sum + n.degrees * n.deviation.powi(2)) / (degrees + n.degrees)).sqrt(),
        );
        (all.contour.closed, all.contour.spacing) = (closed, self.spacing);
        all.misdrawn(&self.clean.points, self.weights, self.step);
        all.leaving(self.weights);
        all.contour.end_lengths();
        Ok(all)
    }
}
