//! The freedom that the shape leaves: a plane slides, a cylinder spins, a sphere turns every way.

use super::AlignError;
use super::icp::{Problem, moved};
use super::system::{Six, System, eigen_six, padded};
use super::twist::Twist;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, cross, dot, minus, plus, times, unit};

/// A motion that changes nothing in how the measured fits the reference; in the frame of the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Freedom {
    /// It slides along this unit direction.
    Slides {
        /// Where to.
        direction: Vector,
    },
    /// It turns about an axis.
    Turns {
        /// A place on the axis, millimeters.
        point: Point,
        /// Unit direction of the axis.
        direction: Vector,
    },
}

/// Mean square displacement along the facets' normals, per unit of mean square displacement. Above it a motion is held.
pub(super) const HELD_MOTION_SHARE: f64 = 0.02;
/// Share of the radius by which motions that are not held are tried.
pub(super) const FREEDOM_STEP_SHARE: f64 = 0.05;
/// Distance per way up to which a tried motion is free. The edges of a cylinder of facets hold its rotation, but only until the
/// next facet.
pub(super) const FREE_RISE_SHARE: f64 = 0.02;

/// Share of a rotation, counted as displacement, in a motion that counts as a slide.
pub(super) const MAX_SLIDE_ROTATION: f64 = 0.01;
/// Standard deviations from which on no distance counts for more, where it is asked how far a pose may move.
pub(super) const CAPPED_SIGMAS: f64 = 6.0;
/// How often the interval in which a motion begins to cost is halved.
const COST_INTERVAL_HALVINGS: usize = 8;

/// Motions that facets hardly hold though they are not free: unit directions of the unknowns, and how far the pose may move
/// along each. The way ends where the likelihood has fallen by the factor of one standard deviation, to the side where that is
/// farther. Points of a single face are held by its rim: those that lie beyond it, and only once they do. The equations at the
/// pose know of the few that do there, or of none.
pub(super) fn barely_held(
    problem: &Problem,
    system: &System,
    directions: Vec<Six>,
    pose: &Rigid,
    progress: &dyn Progress,
) -> Result<Vec<(Six, f64)>, AlignError> {
    let (sigma, count) = (system.rms(), system.count());
    if directions.is_empty() || sigma <= problem.rounding {
        return Ok(vec![]);
    }
    let cap = CAPPED_SIGMAS * sigma;
    let least = problem.cost(pose, cap, progress)?;
    let most = FREEDOM_STEP_SHARE * system.radius;
    let mut all = vec![];
    for direction in directions {
        let mut widest = 0.0_f64;
        for sign in [-1.0, 1.0] {
            let costs = |way: f64| -> Result<bool, AlignError> {
                let motion = moved(system, &direction.map(|x| sign * way * x));
                Ok(count * (problem.cost(&motion.after(pose), cap, progress)? - least) > sigma * sigma)
            };
            let (mut low, mut high) = (0.0, (sigma / count.sqrt()).max(problem.rounding));
            while high < most && !costs(high)? {
                (low, high) = (high, 2.0 * high);
            }
            for _ in 0..COST_INTERVAL_HALVINGS {
                let middle = 0.5 * (low + high);
                if costs(middle)? { high = middle } else { low = middle }
            }
            widest = widest.max(high);
        }
        all.push((direction, widest));
    }
    Ok(all)
}

/// The motions that orthonormal directions of unknowns about `center` span: slides first, then turns.
pub(super) fn named(center: Point, radius: f64, directions: &[Six]) -> Vec<Freedom> {
    // Combinations without rotation: the null space of the Gram matrix of the rotations.
    let turn = |k: usize| -> Vector { std::array::from_fn(|i| directions[k][i]) };
    let shift = |k: usize| -> Vector { std::array::from_fn(|i| directions[k][i + 3]) };
    let free = directions.len();
    let (values, rows) = eigen_six(&padded(free, &|i, j| dot(turn(i), turn(j))));
    let combined = |row: &Six, of: &dyn Fn(usize) -> Vector| {
        (0..free).fold([0.0; 3], |s, k| plus(s, times(row[k], of(k))))
    };
    let slides: Vec<Vector> = (0..free)
        .filter(|&k| values[k] < MAX_SLIDE_ROTATION)
        .filter_map(|k| unit(combined(&rows[k], &shift)).map(|u| u.0))
        .collect();
    let mut found: Vec<Freedom> =
        slides.iter().map(|&direction| Freedom::Slides { direction: forward(direction) }).collect();
    for row in (0..free).filter(|&k| values[k] >= MAX_SLIDE_ROTATION).map(|k| &rows[k]) {
        let omega = times(1.0 / radius, combined(row, &turn));
        let t = slides.iter().fold(combined(row, &shift), |t, s| minus(t, times(dot(t, *s), *s)));
        let Some((direction, size)) = unit(omega) else { continue };
        let point = plus(center, times(1.0 / (size * size), cross(omega, t)));
        found.push(Freedom::Turns { point, direction: forward(direction) });
    }
    found
}

/// The motions as twists.
pub(super) fn twists(freedoms: &[Freedom]) -> Vec<Twist> {
    let twist = |f: &Freedom| match *f {
        Freedom::Slides { direction } => Twist::slide(direction),
        Freedom::Turns { point, direction } => Twist::about(point, direction),
    };
    freedoms.iter().map(twist).collect()
}

/// The direction whose component of largest magnitude is positive.
fn forward(d: Vector) -> Vector {
    let largest = (0..3).max_by(|&i, &j| d[i].abs().total_cmp(&d[j].abs())).unwrap_or(0);
    times(1f64.copysign(d[largest]), d)
}
