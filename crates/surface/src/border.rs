//! Points beyond the border of their surface, and the surface that reaches over them.
//!
//! The parameters of the outermost points are the ends of the domain. Noise across a surface that leans on its base
//! moves their nearest places beyond. Such places then lie on the border, and the distance holds a part along the
//! surface that is no deviation. So the polynomials at the border go on as far as those places lie, and the surface
//! within stays the same. The ends of the domain may have to stay, or the polynomials would have to go on too far. Such
//! points are then beyond the border, and do not count.

use super::SurfaceFit;
use trueness_geom::space::{Point, dot, minus, norm};
use trueness_geom::spline::surface::{Direction, Jet, Patches};

/// Share of the outermost span by which its polynomials go on at most. A cubic of size 1 on a span is at most 9 beyond
/// a quarter of it: farther off the points do not hold it.
const MAX_OVERHANG_SPANS: f64 = 0.25;
/// Part of the way along the surface that is added to it: the surface bends, and the next estimate would be short again.
const ADDED_WAY_SHARE: f64 = 0.2;
/// Times that the way is estimated.
const WAY_ESTIMATES: usize = 4;
/// Length along the surface, as a share of the place and the distance, that the search for a nearest place leaves.
const SETTLED_FOOT_SHARE: f64 = 1e-9;

/// The end of a direction: which one, and whether it is the last.
type End = (usize, bool);

/// How far the parameters go on where a point lies beyond the border, and at which end.
fn ways(jet: &Jet, point: Point, foot: [f64; 2], domain: [(f64, f64); 2]) -> Vec<(End, f64)> {
    let away = minus(point, jet.place);
    let ends = [0, 1].map(|k| (foot[k] <= domain[k].0, foot[k] >= domain[k].1));
    if ends == [(false, false); 2] {
        return vec![];
    }
    let least = SETTLED_FOOT_SHARE * (norm(jet.place) + norm(away));
    let slope = jet.first.map(|d| dot(away, d));
    let mut all = vec![];
    for k in 0..2 {
        for (last, held) in [(false, ends[k].0), (true, ends[k].1)] {
            let outward = if last { slope[k] } else { -slope[k] };
            if held && outward > least * norm(jet.first[k]) {
                let square = dot(jet.first[k], jet.first[k]);
                // That of Newton's method, where the distance is convex enough.
                let bent = square - dot(away, jet.second[2 * k]);
                let by = if bent > 0.5 * square { bent } else { square };
                all.push(((k, last), outward / by));
            }
        }
    }
    all
}

/// Numbers of the points that count and lie beyond the border, ascending.
pub(super) fn beyond(points: &[Point], fit: &SurfaceFit) -> Vec<u32> {
    let (patches, domain) = (Patches::new(&fit.surface), fit.surface.domain());
    let is_beyond = |i: &usize| {
        let foot = fit.feet[*i];
        let inside = (0..2).all(|k| foot[k] > domain[k].0 && foot[k] < domain[k].1);
        !inside && !ways(&patches.jet(foot[0], foot[1]), points[*i], foot, domain).is_empty()
    };
    fit.kept().filter(is_beyond).map(|i| i as u32).collect()
}

/// The fit whose surface reaches over its points, as far as its polynomials may go on.
pub(super) fn reaching_over(points: &[Point], mut fit: SurfaceFit) -> SurfaceFit {
    let own = fit.surface.domain();
    let room = [0, 1].map(|k| {
        let all = fit.surface.knots()[k].distinct();
        let last = all.len() - 1;
        [
            own[k].0 - MAX_OVERHANG_SPANS * (all[1] - all[0]),
            own[k].1 + MAX_OVERHANG_SPANS * (all[last] - all[last - 1]),
        ]
    });
    let mut moved = false;
    for _ in 0..WAY_ESTIMATES {
        let out = beyond(points, &fit);
        let (patches, domain) = (Patches::new(&fit.surface), fit.surface.domain());
        let mut to = domain;
        for i in &out {
            let (point, foot) = (points[*i as usize], fit.feet[*i as usize]);
            for ((k, last), way) in ways(&patches.jet(foot[0], foot[1]), point, foot, domain) {
                let end = |way: f64| if last { domain[k].1 + way } else { domain[k].0 - way };
                if end(way) >= room[k][0] && end(way) <= room[k][1] {
                    let end = end((1.0 + ADDED_WAY_SHARE) * way).clamp(room[k][0], room[k][1]);
                    if last { to[k].1 = to[k].1.max(end) } else { to[k].0 = to[k].0.min(end) }
                }
            }
        }
        if to == domain {
            break;
        }
        let along_u = fit.surface.going_on(Direction::U, to[0]);
        let Ok(surface) = along_u.and_then(|s| s.going_on(Direction::V, to[1])) else { break };
        fit.surface = surface;
        moved = true;
        let patches = Patches::new(&fit.surface);
        for i in out {
            let (n, start) = (i as usize, fit.feet[i as usize]);
            let foot = patches.foot_from(points[n], start);
            (fit.deviations[n], fit.feet[n]) = (foot.signed(points[n]), foot.parameters);
        }
    }
    if moved {
        // The larger surface tells fewer nearest places without a search.
        let reach = Patches::new(&fit.surface).reach();
        let near = |i: usize| fit.deviations[i].abs() < reach;
        let mut doubtful: Vec<u32> =
            (0..points.len()).filter(|i| !near(*i)).map(|i| i as u32).chain(fit.doubtful.drain(..)).collect();
        doubtful.sort_unstable();
        doubtful.dedup();
        fit.doubtful = doubtful;
    }
    fit
}
