//! Parameters of places, until the projections of the surfaces themselves are there.

use super::chart::Chart;
use crate::curve::Curve;
use crate::surface::Surface;
use std::f64::consts::TAU;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm};

fn closed(curve: &Curve) -> Option<f64> {
    if let Some(period) = curve.period() {
        return Some(period);
    }
    let [a, b] = curve.domain();
    let is_closed = a.is_finite() && b.is_finite() && {
        let places: Vec<Point> = (0..=8).map(|i| curve.at(a + (b - a) * i as f64 / 8.0)).collect();
        let size = places.iter().map(|p| norm(minus(*p, places[0]))).fold(0.0, f64::max);
        norm(minus(places[8], places[0])) <= 1e-7 * size
    };
    is_closed.then_some(b - a)
}

pub fn periods(surface: &Surface) -> [Option<f64>; 2] {
    match surface {
        Surface::Plane(_) => [None, None],
        Surface::Cylinder { .. } | Surface::Cone { .. } | Surface::Sphere { .. } => [Some(TAU), None],
        Surface::Torus { .. } => [Some(TAU), Some(TAU)],
        Surface::Extrusion { curve, .. } => [closed(curve), None],
        Surface::Revolution { curve, .. } => [Some(TAU), closed(curve)],
        Surface::Offset { basis, .. } => periods(basis),
        Surface::Spline(nurbs) => {
            let domain: [(f64, f64); 2] = nurbs.knots().each_ref().map(|k| k.domain());
            let at = |k: usize, end: bool, share: f64| {
                let (a, b) = domain[1 - k];
                let fixed = if end { domain[k].1 } else { domain[k].0 };
                let moving = a + share * (b - a);
                if k == 0 { surface.at(fixed, moving) } else { surface.at(moving, fixed) }
            };
            let size = norm(minus(at(0, false, 0.0), at(0, true, 0.5)))
                .max(norm(minus(at(1, false, 0.0), at(1, true, 0.5))))
                .max(norm(minus(at(1, false, 0.5), at(1, true, 0.5))))
                .max(norm(minus(at(1, false, 0.0), at(1, false, 0.5))))
                .max(norm(minus(at(0, false, 0.0), at(0, false, 0.5))));
            [0, 1].map(|k| {
                let same = (0..=16).all(|i| {
                    let s = i as f64 / 16.0;
                    norm(minus(at(k, false, s), at(k, true, s))) <= 1e-6 * size
                });
                same.then_some(domain[k].1 - domain[k].0)
            })
        }
    }
}

pub fn parameters(chart: &Chart, p: Point, near: Option<[f64; 2]>) -> [f64; 2] {
    match &chart.surface {
        Surface::Plane(frame) => {
            let [x, y, _] = frame.local(p);
            [x, y]
        }
        Surface::Cylinder { frame, .. } => {
            let [x, y, z] = frame.local(p);
            [libm::atan2(y, x), z]
        }
        Surface::Sphere { frame, .. } => {
            let [x, y, z] = frame.local(p);
            [libm::atan2(y, x), libm::atan2(z, libm::hypot(x, y))]
        }
        Surface::Cone { frame, radius, half_angle } => {
            let [x, y, z] = frame.local(p);
            let slope = libm::tan(*half_angle);
            let probe = if chart.domain[1][0].is_finite() { chart.domain[1][0] + 1.0 } else { chart.domain[1][1] - 1.0 };
            let side = if radius + probe * slope < 0.0 { -1.0 } else { 1.0 };
            let c = libm::cos(*half_angle);
            let v = c * c * ((side * libm::hypot(x, y) - radius) * slope + z);
            [libm::atan2(side * y, side * x), v]
        }
        Surface::Torus { frame, major, minor } => {
            let [x, y, z] = frame.local(p);
            let middle = 0.5 * (chart.domain[1][0] + chart.domain[1][1]);
            let inner = minor >= major && major + minor * libm::cos(middle) < 0.0;
            let side = if inner { -1.0 } else { 1.0 };
            let v = libm::atan2(z, side * libm::hypot(x, y) - major);
            [libm::atan2(side * y, side * x), if inner && v < 0.0 { v + TAU } else { v }]
        }
        Surface::Offset { basis, .. } => {
            let inner = Chart { surface: (**basis).clone(), ..chart.clone() };
            parameters(&inner, p, near)
        }
        _ => {
            if let Some(n) = near {
                let (at, off) = descend(chart, p, n);
                let scale = norm(minus(p, chart.place(n)));
                if off <= 0.3 * scale.max(1e-9) || off < 1e-3 {
                    return at;
                }
            }
            let mut best = ([0.0; 2], f64::INFINITY);
            let mut seeds: Vec<(f64, [f64; 2])> =
                seeds(chart, p).into_iter().map(|s| (norm(minus(chart.place(s), p)), s)).collect();
            seeds.sort_by(|a, b| a.0.total_cmp(&b.0));
            for (_, seed) in seeds.into_iter().take(8) {
                let found = descend(chart, p, seed);
                if found.1 < best.1 {
                    best = found;
                }
            }
            best.0
        }
    }
}

fn seeds(chart: &Chart, p: Point) -> Vec<[f64; 2]> {
    let range = |a: [f64; 2], n: usize| -> Vec<f64> { (0..=n).map(|i| a[0] + (a[1] - a[0]) * i as f64 / n as f64).collect() };
    match &chart.surface {
        Surface::Extrusion { curve, direction } => {
            let d = curve.domain();
            let d = if d[0].is_finite() { d } else { [-100.0, 100.0] };
            range(d, 96)
                .into_iter()
                .map(|u| [u, dot(minus(p, curve.at(u)), *direction) / dot(*direction, *direction)])
                .collect()
        }
        Surface::Revolution { curve, origin, axis } => {
            let d = curve.domain();
            let d = if d[0].is_finite() { d } else { [-100.0, 100.0] };
            let flat = |q: Point| {
                let w = minus(q, *origin);
                let a = dot(w, *axis);
                [0, 1, 2].map(|k| w[k] - a * axis[k])
            };
            range(d, 96)
                .into_iter()
                .map(|v| {
                    let (a, b): (Vector, Vector) = (flat(curve.at(v)), flat(p));
                    let u = libm::atan2(dot(cross(a, b), *axis), dot(a, b));
                    [u, v]
                })
                .collect()
        }
        _ => {
            let spans = |k: usize| match &chart.surface {
                Surface::Spline(n) => (3 * n.knots()[k].distinct().len()).clamp(12, 48),
                _ => 16,
            };
            let us = range(chart.domain[0], spans(0));
            let vs = range(chart.domain[1], spans(1));
            us.iter().flat_map(|u| vs.iter().map(|v| [*u, *v])).collect()
        }
    }
}

/// Newton's method from a start; parameters and distance.
fn descend(chart: &Chart, p: Point, start: [f64; 2]) -> ([f64; 2], f64) {
    let clamp = |at: [f64; 2]| -> [f64; 2] {
        std::array::from_fn(|k| match chart.periods[k] {
            Some(_) => at[k],
            None => at[k].clamp(chart.domain[k][0], chart.domain[k][1]),
        })
    };
    let mut at = clamp(start);
    let mut jet = chart.jet(at);
    let mut off = norm(minus(jet.place, p));
    for _ in 0..40 {
        let w = minus(jet.place, p);
        let [du, dv] = jet.first;
        let g = [dot(w, du), dot(w, dv)];
        let gauss = [dot(du, du), dot(du, dv), dot(dv, dv)];
        let full: [f64; 3] = std::array::from_fn(|i| gauss[i] + dot(w, jet.second[i]));
        let is_convex = full[0] > 0.0 && full[0] * full[2] - full[1] * full[1] > 1e-3 * gauss[0] * gauss[2];
        let mut h = if is_convex { full } else { gauss };
        // On the border only the other parameter moves.
        for k in 0..2 {
            let blocked = chart.periods[k].is_none()
                && ((at[k] <= chart.domain[k][0] && g[k] > 0.0) || (at[k] >= chart.domain[k][1] && g[k] < 0.0));
            if blocked {
                h[1] = 0.0;
            }
        }
        let det = h[0] * h[2] - h[1] * h[1];
        let step = if det > 1e-14 * h[0] * h[2] {
            [(-g[0] * h[2] + g[1] * h[1]) / det, (g[0] * h[1] - g[1] * h[0]) / det]
        } else {
            [if h[0] > 0.0 { -g[0] / h[0] } else { 0.0 }, if h[2] > 0.0 { -g[1] / h[2] } else { 0.0 }]
        };
        let mut share = 1.0;
        let mut moved = false;
        while share > 1e-6 {
            let next = clamp([at[0] + share * step[0], at[1] + share * step[1]]);
            let next_jet = chart.jet(next);
            let next_off = norm(minus(next_jet.place, p));
            if next_off < off {
                let length = (next[0] - at[0]).abs() * norm(du) + (next[1] - at[1]).abs() * norm(dv);
                (at, jet) = (next, next_jet);
                moved = length > 1e-16 * norm(jet.place);
                off = next_off;
                break;
            }
            share *= 0.5;
        }
        if !moved {
            break;
        }
    }
    (at, off)
}
