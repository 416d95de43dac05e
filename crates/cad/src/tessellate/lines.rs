//! Rows and columns of parameters between which facets keep to the tolerance.

use super::bend::Bend;
use crate::surface::Surface;
use crate::trim::Trim;
use trueness_geom::space::norm;

/// What facets are made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Greatest distance between facets and the surface, millimeters.
    pub distance: f64,
    /// Greatest angle between neighboring facets of one face, radians; of splines about that.
    pub angle: f64,
}

/// Of the tolerance, what cells of lines take: facets between lines and edges are a little larger.
const CELL_SHARE: f64 = 0.6;
/// Lines of one direction at most: what asks for more does so by mistake.
pub const MAX_LINES: usize = 1 << 20;
/// Parts of a whole turn at least: with fewer, both sides of a facet would be one.
const LEAST_PARTS: f64 = 4.0;

/// Values of both parameters, ascending, from one side of the window to the other; `finer` times as many as the tolerance asks for.
pub fn lines(trim: &Trim, bend: &Bend, fineness: Fineness, finer: usize) -> [Vec<f64>; 2] {
    let distance = CELL_SHARE * fineness.distance;
    let window = trim.window;
    let widths = window.map(|[a, b]| b - a);
    let surface = trim.chart.surface();
    if matches!(surface, Surface::Plane(_)) {
        return window.map(|w| w.to_vec());
    }
    // A distance function takes care of how the radius of a cone or the parallels of a sphere change.
    let has_mixed = !matches!(surface, Surface::Cone { .. } | Surface::Sphere { .. });
    let ([uu, _, vv], _) = bend.seconds(window);
    let floor = [0, 1].map(|k| 8.0 * distance / (widths[k] * widths[k]));
    let ratio = (uu.max(floor[0]) / vv.max(floor[1])).sqrt();
    [0, 1].map(|k| {
        let mut stops = vec![window[k][0]];
        stops.extend(bend.stops(k, window[k]));
        stops.push(window[k][1]);
        let mut all = vec![window[k][0]];
        for w in stops.windows(2) {
            let mut sides = window;
            sides[k] = [w[0], w[1]];
            let ([uu, uv, vv], _) = bend.seconds(sides);
            let uv = if has_mixed { uv } else { 0.0 };
            let second = if k == 0 { uu + ratio * uv } else { vv + uv / ratio };
            let width = w[1] - w[0];
            let by_distance = width * (second / (8.0 * distance * SHARE_OF_DIRECTION)).sqrt();
            let by_angle = width * turning(trim, k, sides, [uu, vv][k]) / fineness.angle;
            let by_turn = trim.chart.periods[k].map_or(1.0, |p| LEAST_PARTS * width / p);
            let n = by_distance.max(by_angle).max(by_turn).ceil().clamp(1.0, MAX_LINES as f64) as usize;
            let n =
                if n == 1 && widths[k] == width && by_distance.max(by_angle) < 0.5 { 1 } else { n * finer };
            all.extend((1..=n).map(|i| if i == n { w[1] } else { w[0] + width * i as f64 / n as f64 }));
        }
        all
    })
}

/// Of the distance, what either direction may take.
const SHARE_OF_DIRECTION: f64 = 0.5;

/// By how much the direction of the surface turns with a parameter, about.
fn turning(trim: &Trim, k: usize, sides: [[f64; 2]; 2], second: f64) -> f64 {
    match (trim.chart.surface(), k) {
        (Surface::Plane(_), _)
        | (Surface::Cylinder { .. } | Surface::Cone { .. } | Surface::Extrusion { .. }, 1) => 0.0,
        (
            Surface::Cylinder { .. } | Surface::Cone { .. } | Surface::Sphere { .. } | Surface::Torus { .. },
            _,
        )
        | (Surface::Revolution { .. }, 0) => 1.0,
        _ => {
            let speed = |share: f64| {
                let at = [0, 1].map(|j| sides[j][0] + share * (sides[j][1] - sides[j][0]));
                norm(trim.chart.jet(at).first[k])
            };
            let most = [0.1, 0.5, 0.9].map(speed).into_iter().fold(0.0, f64::max);
            if most > 0.0 { second / most } else { 0.0 }
        }
    }
}

/// Places of the grid within the window, not on its sides: where lines cross. On a sphere columns are fewer towards the poles, where the
/// parallels are shorter.
pub fn nodes(trim: &Trim, [us, vs]: &[Vec<f64>; 2]) -> Vec<[f64; 2]> {
    let inner = |x: &[f64]| x.get(1..x.len() - 1).unwrap_or_default().to_vec();
    let rows = inner(vs);
    if matches!(trim.chart.surface(), Surface::Sphere { .. }) {
        let [from, to] = trim.window[0];
        let most = (us.len() - 1) as f64;
        let row = |(j, v): (usize, &f64)| {
            let n = (most * libm::cos(*v)).ceil().max(3.0) as usize;
            // Every other row by half a step.
            let shift = if j % 2 == 0 { 0.5 } else { 1.0 };
            let v = *v;
            (0..n).map(move |i| [from + (to - from) * (i as f64 + shift) / n as f64, v]).collect::<Vec<_>>()
        };
        let inside = |at: &[f64; 2]| at[0] > from && at[0] < to;
        return rows.iter().enumerate().flat_map(row).filter(inside).collect();
    }
    inner(us).iter().flat_map(|u| rows.iter().map(|v| [*u, *v])).collect()
}
