//! The smallest box around a face.

use crate::surface::Surface;
use crate::trim::Trim;
use std::f64::consts::{FRAC_PI_2, PI};
use trueness_geom::space::{Aabb, Point, Vector, dot, norm, plus, times, unit};

/// Places along each parameter among which extremes are looked for, and places for each span between knots.
const GRID: usize = 24;
const PER_SPAN: usize = 4;
/// Places along each parameter at most.
const MAX_GRID: usize = 96;
/// Steps of Newton's method, which doubles its digits.
const STEPS: usize = 30;

/// The smallest box around a face: around its edges and those places within where it turns back along an axis.
///
/// Exact for planes, cylinders, cones, spheres and tori. On other surfaces Newton's method starts from a grid: an extreme within less than a
/// cell of it, beside a greater one, may be missed. Box of the border for a face without edges.
pub fn bounds(trim: &Trim) -> Aabb {
    let edges = trim.spans.iter().map(|s| s.bounds()).fold(Aabb::EMPTY, |a, b| a.union(&b));
    let mut places: Vec<Point> = trim.chart.poles.iter().flatten().flatten().copied().collect();
    places.retain(|p| trim.contains(trim.chart.parameters(*p, None)));
    if trim.spans.is_empty() {
        // Its sides may be without edges.
        places.extend(trim.rings.iter().flat_map(|r| r.places()).map(|(at, _)| trim.chart.place(at)));
    }
    for k in 0..3 {
        let mut axis = [0.0; 3];
        axis[k] = 1.0;
        let held = |at: &[f64; 2]| trim.contains(*at);
        places.extend(still(trim, axis).iter().filter(|at| held(at)).map(|at| trim.chart.place(*at)));
    }
    edges.union(&Aabb::of(&places))
}

/// Parameters where the surface may be extreme along a direction.
fn still(trim: &Trim, axis: Vector) -> Vec<[f64; 2]> {
    match trim.chart.surface() {
        // Where these stand still they do so along a line, to an edge.
        Surface::Plane(_) | Surface::Cylinder { .. } | Surface::Cone { .. } => vec![],
        Surface::Sphere { frame, radius } => [-radius, *radius]
            .map(|r| trim.chart.parameters(plus(frame.origin, times(r, axis)), None))
            .to_vec(),
        Surface::Torus { frame, .. } => {
            let [x, y, z] = frame.axes.map(|a| dot(a, axis));
            let (u, v) = (libm::atan2(y, x), libm::atan2(z, libm::hypot(x, y)));
            let mut all = vec![[u, v], [u, v + PI], [u + PI, -v], [u + PI, PI - v]];
            // Along the axis of the torus a whole circle is extreme; it reaches an edge, or any place of it is within.
            let anywhere = trim.window[0][0];
            all.extend([[anywhere, FRAC_PI_2], [anywhere, -FRAC_PI_2]]);
            all
        }
        _ => by_grid(trim, axis),
    }
}

/// Places of a grid that are higher, or lower, than those around them, moved to where the surface stands still.
fn by_grid(trim: &Trim, axis: Vector) -> Vec<[f64; 2]> {
    let lines = [0, 1].map(|k| {
        let spans = match trim.chart.surface() {
            Surface::Spline(nurbs) => PER_SPAN * nurbs.knots()[k].distinct().len(),
            _ => GRID,
        };
        let n = spans.clamp(GRID, MAX_GRID);
        let [from, to] = trim.window[k];
        (0..=n).map(|i| from + (to - from) * i as f64 / n as f64).collect::<Vec<f64>>()
    });
    let [us, vs] = &lines;
    let heights: Vec<Vec<f64>> =
        us.iter().map(|u| vs.iter().map(|v| dot(axis, trim.chart.place([*u, *v]))).collect()).collect();
    let mut found = vec![];
    for i in 0..us.len() {
        for j in 0..vs.len() {
            let own = heights[i][j];
            let around = || {
                (i.saturating_sub(1)..(i + 2).min(us.len()))
                    .flat_map(move |a| (j.saturating_sub(1)..(j + 2).min(vs.len())).map(move |b| (a, b)))
                    .map(|(a, b)| heights[a][b])
            };
            if around().all(|h| h <= own) || around().all(|h| h >= own) {
                found.extend(descend(trim, axis, [us[i], vs[j]]));
            }
        }
    }
    found
}

/// Newton's method to where both derivatives along the axis are 0; `None` where it leads astray.
fn descend(trim: &Trim, axis: Vector, start: [f64; 2]) -> Option<[f64; 2]> {
    let mut at = start;
    for _ in 0..STEPS {
        let jet = trim.chart.jet(at);
        let g = jet.first.map(|w| dot(axis, w));
        let [a, b, c] = jet.second.map(|w| dot(axis, w));
        let det = a * c - b * b;
        let step = if det.abs() > 1e-12 * (a * a + 2.0 * b * b + c * c) {
            [(b * g[1] - c * g[0]) / det, (b * g[0] - a * g[1]) / det]
        } else if a.abs() >= c.abs() {
            [if a == 0.0 { 0.0 } else { -g[0] / a }, 0.0]
        } else {
            [0.0, -g[1] / c]
        };
        let next: [f64; 2] = std::array::from_fn(|k| {
            let [from, to] = trim.window[k];
            (at[k] + step[k]).clamp(from, to)
        });
        let is_same = next == at;
        at = next;
        if is_same {
            break;
        }
    }
    let jet = trim.chart.jet(at);
    let [du, dv] = jet.first;
    let normal = unit(trueness_geom::space::cross(du, dv))?.0;
    // Good enough where the direction is that of the normal: what is left moves the place by its square.
    (norm(trueness_geom::space::cross(normal, axis)) < 1e-4).then_some(at)
}
