//! One fit after the other: parameters of the nearest places.

use super::feet::{Feet, Found, feet};
use super::gram::Binned;
use super::hold::HoldGround;
use super::solve::EarlierSolution;
use super::{Base, Fairness, Options, SurfaceError, SurfaceFit, border, solve};
use trueness_geom::progress::Progress;
use trueness_geom::space::{Aabb, Point, dot, plus, times};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::surface::{Patches, Surface};

/// Corrections go on while they take away this share of the root mean square.
const MIN_CORRECTION_GAIN: f64 = 0.01;
/// Later weights of the thin plate are at least this share of the first fit's, as far as the residuals did not fall.
/// Rows of a scanner lie between control points so that parameters corrected along them have no noise left.
/// Cross-validation then lets the surface go where there are no points.
const MIN_FAIRNESS_SHARE: f64 = 0.01;

/// The fit over these knots, with parameters corrected as the options say.
pub(super) fn corrected(
    points: &[Point],
    parameters: Vec<[f64; 2]>,
    base: Base,
    knots: [Knots; 2],
    options: &Options,
    progress: &dyn Progress,
) -> Result<SurfaceFit, SurfaceError> {
    let corrections = options.corrections_made();
    // Ends of the domain are parameters as well.
    let reaching =
        |found: SurfaceFit| if options.ends_move() { border::reaching_over(points, found) } else { found };
    let mut best = reaching(once(points, parameters, base, &knots, None, options, progress)?);
    let mut known = None;
    for n in 1..=corrections {
        let knots = best.surface.knots().clone();
        let mut next = once(points, best.feet.clone(), base, &knots, known, options, progress)?;
        if let (None, Some(degrees_of_freedom)) = (known, best.degrees_of_freedom) {
            let fell = (rms(&next.deviations) / rms(&best.deviations)).min(1.0);
            let fairness = MIN_FAIRNESS_SHARE * best.fairness * fell * fell;
            if next.fairness < fairness {
                let held = Some(EarlierSolution { fairness, degrees_of_freedom, stiffness: best.stiffness });
                next = once(points, best.feet.clone(), base, &knots, held, options, progress)?;
            }
        }
        next = reaching(next);
        // The weight of the thin plate settles with the first correction.
        known = next.degrees_of_freedom.map(|degrees_of_freedom| EarlierSolution {
            fairness: next.fairness,
            degrees_of_freedom,
            stiffness: next.stiffness,
        });
        let (before, after) = (rms(&best.deviations), rms(&next.deviations));
        if after.is_nan() || after >= before {
            break;
        }
        best = SurfaceFit { corrections: n, ..next };
        if after > (1.0 - MIN_CORRECTION_GAIN) * before {
            break;
        }
    }
    Ok(best)
}

/// Root mean square.
pub(super) fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|d| d * d).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

/// The fit at these parameters.
fn once(
    points: &[Point],
    parameters: Vec<[f64; 2]>,
    base: Base,
    knots: &[Knots; 2],
    known: Option<EarlierSolution>,
    options: &Options,
    progress: &dyn Progress,
) -> Result<SurfaceFit, SurfaceError> {
    let hull = Aabb::of(points);
    let center = times(0.5, plus(hull.min, hull.max));
    let data = Binned::new(knots, points, &parameters, center);
    let ground = HoldGround { knots, base: &base, points, parameters: &parameters, center };
    let solved = solve::solve(&data, &ground, known, options, progress)?;
    // The sorted points know them too, and this is where most memory is in use.
    drop(parameters);
    let counts = data.counts;
    let centered = Patches::of(data.spans.clone(), &solved.points, counts[1]);
    let control: Vec<Point> = solved.points.iter().map(|p| plus(*p, center)).collect();
    let surface = Surface::new(knots.clone(), control).map_err(|_| SurfaceError::Undetermined {
        total: counts[0] * counts[1],
        points: points.len(),
        unsupported: solved.support.unsupported,
    })?;
    let patches = Patches::new(&surface);
    let both = Found { surface: &patches, centered: &centered };
    let Feet { deviations, feet, doubtful, unsettled, sum_of_squares, max_residual } =
        feet(data, &both, points, progress)?;
    let far = far(&base, points, 0.5 * hull.diagonal());
    Ok(SurfaceFit {
        far_control_points: surface.points().iter().filter(|p| far(p)).count(),
        deviations,
        feet,
        doubtful,
        unsettled,
        sum_of_squares,
        max_residual,
        fairness: solved.fairness,
        degrees_of_freedom: solved.degrees_of_freedom.filter(|_| options.fairness == Fairness::Auto),
        support: solved.support,
        stiffness: solved.stiffness,
        surface,
        base,
        corrections: 0,
        left_out: vec![],
        beyond_border: vec![],
        reached: None,
    })
}

/// Whether a place lies outside of twice the box of the points along the axes of the base. Where that is flat it is no
/// nearer than `least`.
fn far(base: &Base, points: &[Point], least: f64) -> impl Fn(&Point) -> bool {
    let axes = base.axes;
    let limits = axes.map(|axis| {
        let (low, high) = points
            .iter()
            .map(|p| dot(*p, axis))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        (0.5 * (low + high), (high - low).max(least))
    });
    move |p| axes.iter().zip(limits).any(|(axis, (middle, most))| (dot(*p, *axis) - middle).abs() > most)
}
