//! The nearest places of all points, from their parameters on: eight points of a cell side by side.
//!
//! Newton's method from a start near the place takes three or four steps, and most points stay in their cell on the
//! way. These go together through loops over arrays. A point begins anew by itself ([`Patches::foot_from`]) that leaves
//! its cell or comes to the edge of the domain. So does one that has no convex distance, or no end after some steps. So
//! the answer for a point depends on no other.

use super::gram::{Binned, within};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::simd::widest::widest;
use trueness_geom::space::Point;
use trueness_geom::spline::surface::Patches;

/// Points side by side.
const POINTS_PER_GROUP: usize = 8;
/// One number of each.
type Lanes = [f64; POINTS_PER_GROUP];
/// Pieces of work whose answers wait to be put in their places.
const ITEMS_PER_BATCH: usize = 256;
/// Steps that are taken side by side.
const STEPS_SIDE_BY_SIDE: usize = 5;
/// Length of a step, relative to the place, after which the next one is rounding: as of the search for one point.
const LAST_STEP_SHARE: f64 = 1e-9;

/// The nearest places of points, and the residuals of the points at their own parameters.
#[derive(Default)]
pub(super) struct Feet {
    /// Signed distances.
    pub deviations: Vec<f64>,
    /// Parameters.
    pub feet: Vec<[f64; 2]>,
    /// Points for which there may be a nearer place.
    pub doubtful: Vec<u32>,
    /// Points whose place was not found to the last digit.
    pub unsettled: usize,
    /// Sum of the squares of the distances from the places of their own parameters.
    pub sum_of_squares: f64,
    /// The greatest of these distances.
    pub max_residual: f64,
}

/// A surface, and the same with the points' center as its origin.
pub(super) struct Found<'a> {
    pub surface: &'a Patches,
    pub centered: &'a Patches,
}

/// Points of one cell.
struct Group {
    /// Coordinates in the cell, from −1 to 1.
    at: [Lanes; 2],
    /// The points less the center.
    point: [Lanes; 3],
    /// Squares of the distances from the places of the start.
    start: Lanes,
    /// Squares of the distances.
    square: Lanes,
    /// Point less place, times the normal: negative on the other side.
    side: Lanes,
    /// 1 where the place was found, −1 where it was given up.
    state: Lanes,
}

/// The nearest places of the points, from the parameters that they were sorted by.
///
/// Cost: four evaluations a point, about 0.1 µs.
pub(super) fn feet(
    data: Binned,
    found: &Found,
    points: &[Point],
    progress: &dyn Progress,
) -> Result<Feet, Cancelled> {
    let reach = found.surface.reach();
    let columns = data.spans[1].count();
    let one = |(cell, from, to): &(u32, u32, u32)| {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let at = [*cell as usize / columns, *cell as usize % columns];
        let limits = [0, 1].map(|k| data.spans[k].limits(at[k]));
        let (own, q) = found.centered.patch(*cell as usize);
        let mut out = Feet::default();
        let (from, to) = (*from as usize, *to as usize);
        for first in (from..to).step_by(POINTS_PER_GROUP) {
            let count = POINTS_PER_GROUP.min(to - first);
            // Lanes beyond the last point repeat it.
            let index = |l: usize| first + l.min(count - 1);
            let mut group = Group {
                at: [0, 1].map(|k| std::array::from_fn(|l| data.local[index(l)][k])),
                point: [0, 1, 2].map(|d| std::array::from_fn(|l| data.points[index(l)][d])),
                start: [0.0; POINTS_PER_GROUP],
                square: [0.0; POINTS_PER_GROUP],
                side: [0.0; POINTS_PER_GROUP],
                state: [0.0; POINTS_PER_GROUP],
            };
            descend(own, q, &mut group);
            for l in 0..count {
                out.sum_of_squares += group.start[l];
                out.max_residual = out.max_residual.max(group.start[l]);
                let number = data.order[first + l];
                if group.state[l] > 0.0 {
                    let distance = group.square[l].sqrt();
                    if distance >= reach {
                        out.doubtful.push(number);
                    }
                    out.deviations.push(if group.side[l] < 0.0 { -distance } else { distance });
                    out.feet.push([0, 1].map(|k| within(limits[k], group.at[k][l])));
                } else {
                    let own = data.parameters(*cell as usize, first + l);
                    let foot = found.surface.foot_from(points[number as usize], own);
                    if !foot.settled || foot.distance >= reach {
                        out.doubtful.push(number);
                    }
                    out.unsettled += usize::from(!foot.settled);
                    out.deviations.push(foot.signed(points[number as usize]));
                    out.feet.push(foot.parameters);
                }
            }
        }
        progress.advance((to - from) as u64);
        Ok(out)
    };
    let items = data.items();
    let (deviations, feet) = (Vec::with_capacity(points.len()), Vec::with_capacity(points.len()));
    let mut all = Feet { deviations, feet, ..Feet::default() };
    // A batch at a time: the contents of its pieces are held twice.
    for batch in items.chunks(ITEMS_PER_BATCH) {
        let parts: Result<Vec<Feet>, Cancelled> = batch.par_iter().map(one).collect();
        for part in parts? {
            all.deviations.extend(part.deviations);
            all.feet.extend(part.feet);
            all.doubtful.extend(part.doubtful);
            all.unsettled += part.unsettled;
            all.sum_of_squares += part.sum_of_squares;
            all.max_residual = all.max_residual.max(part.max_residual);
        }
    }
    // With no more in memory than before: the sorted points go first.
    let Binned { rank, order, local, points: sorted, .. } = data;
    drop((order, local, sorted));
    all.deviations = in_order(&rank, &all.deviations);
    all.feet = in_order(&rank, &all.feet);
    all.doubtful.sort_unstable();
    all.max_residual = all.max_residual.sqrt();
    Ok(all)
}

/// From the order of the cells to that of the points.
fn in_order<T: Copy + Send + Sync>(rank: &[u32], sorted: &[T]) -> Vec<T> {
    rank.par_iter().map(|at| sorted[*at as usize]).collect()
}

widest! {
    fn descend [] [] (own: &[[f64; 3]], q: usize, group: &mut Group) = {
        // The degrees in use have loops of known length.
        match q {
            4 => newton(own.as_chunks::<4>().0, group),
            3 => newton(own.as_chunks::<3>().0, group),
            _ => {
                // Rows of other lengths go one by one.
                group.state = [-1.0; POINTS_PER_GROUP];
                let rows = own.chunks_exact(q);
                for l in 0..POINTS_PER_GROUP {
                    let place = value(rows.clone(), group.at[0][l], group.at[1][l]);
                    let away = |d: usize| place[d] - group.point[d][l];
                    group.start[l] = away(0) * away(0) + away(1) * away(1) + away(2) * away(2);
                }
            }
        }
    }
}

/// The value of a polynomial whose rows are polynomials of `t`, for powers of `s`.
fn value<'a>(rows: impl DoubleEndedIterator<Item = &'a [[f64; 3]]>, s: f64, t: f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for row in rows.rev() {
        let mut inner = [0.0; 3];
        for c in row.iter().rev() {
            (0..3).for_each(|d| inner[d] = inner[d] * t + c[d]);
        }
        (0..3).for_each(|d| sum[d] = sum[d] * s + inner[d]);
    }
    sum
}

/// Sums over the three coordinates that Newton's method needs at the places.
struct Sums {
    /// `away · away`, `away` from the point to the place.
    square: Lanes,
    /// `away · S_s`, `away · S_t`.
    gradient: [Lanes; 2],
    /// `S_s · S_s`, `S_s · S_t`, `S_t · S_t`.
    gauss: [Lanes; 3],
    /// `away · S_ss`, `away · S_st`, `away · S_tt`.
    bend: [Lanes; 3],
    /// Square of the place.
    place: Lanes,
    /// Point less place, times `S_s` times `S_t`.
    side: Lanes,
}

/// Steps of Newton's method until all lanes have a state.
#[inline(always)]
fn newton<const Q: usize>(rows: &[[[f64; 3]; Q]], group: &mut Group) {
    let mut sums = evaluated(rows, &group.at, &group.point);
    group.start = sums.square;
    group.square = sums.square;
    group.side = sums.side;
    for _ in 0..STEPS_SIDE_BY_SIDE {
        let mut tried = group.at;
        let mut moved = [0.0; POINTS_PER_GROUP];
        let mut fine = [0.0; POINTS_PER_GROUP];
        for l in 0..POINTS_PER_GROUP {
            let [a, b, c] = [0, 1, 2].map(|k| sums.gauss[k][l] + sums.bend[k][l]);
            let determinant = a * c - b * b;
            let convex = a > 0.0 && determinant > 1e-6 * a * c.abs();
            let [g, h] = [sums.gradient[0][l], sums.gradient[1][l]];
            let divisor = if convex { determinant } else { 1.0 };
            let (x, y) = ((b * h - c * g) / divisor, (b * g - a * h) / divisor);
            let [s, t] = [group.at[0][l] + x, group.at[1][l] + y];
            let inside = s > -1.0 && s < 1.0 && t > -1.0 && t < 1.0;
            tried[0][l] = s;
            tried[1][l] = t;
            // Squares of the moves along the two directions.
            let (by_s, by_t) = (x * x * sums.gauss[0][l], y * y * sums.gauss[2][l]);
            moved[l] = if by_s > by_t { by_s } else { by_t };
            fine[l] = if convex && inside { 1.0 } else { 0.0 };
        }
        let next = evaluated(rows, &tried, &group.point);
        for l in 0..POINTS_PER_GROUP {
            let scale = sums.place[l] + group.square[l];
            let last = moved[l] <= LAST_STEP_SHARE * LAST_STEP_SHARE * scale
                && next.square[l] <= group.square[l] * (1.0 + 1e-9);
            let nearer = next.square[l] < group.square[l];
            let open = group.state[l] == 0.0;
            let goes = open && fine[l] > 0.0 && (last || nearer);
            group.at[0][l] = if goes { tried[0][l] } else { group.at[0][l] };
            group.at[1][l] = if goes { tried[1][l] } else { group.at[1][l] };
            group.square[l] = if goes { next.square[l] } else { group.square[l] };
            group.side[l] = if goes { next.side[l] } else { group.side[l] };
            let state = if goes { if last { 1.0 } else { 0.0 } } else { -1.0 };
            group.state[l] = if open { state } else { group.state[l] };
        }
        if group.state.iter().all(|s| *s != 0.0) {
            return;
        }
        sums = next;
    }
}

/// The sums at these coordinates.
#[inline(always)]
fn evaluated<const Q: usize>(rows: &[[[f64; 3]; Q]], [s, t]: &[Lanes; 2], point: &[Lanes; 3]) -> Sums {
    const ZERO: Lanes = [0.0; POINTS_PER_GROUP];
    let mut sums = Sums {
        square: ZERO,
        gradient: [ZERO; 2],
        gauss: [ZERO; 3],
        bend: [ZERO; 3],
        place: ZERO,
        side: ZERO,
    };
    let mut jets = [[ZERO; 3]; 3];
    for d in 0..3 {
        // The polynomial and its derivatives by s, t, ss, st, tt; the second ones by s or t alone halved.
        let mut six = [ZERO; 6];
        for row in rows.iter().rev() {
            let mut inner = [ZERO; 3];
            for c in row.iter().rev() {
                for l in 0..POINTS_PER_GROUP {
                    inner[2][l] = inner[2][l] * t[l] + inner[1][l];
                    inner[1][l] = inner[1][l] * t[l] + inner[0][l];
                    inner[0][l] = inner[0][l] * t[l] + c[d];
                }
            }
            for l in 0..POINTS_PER_GROUP {
                six[3][l] = six[3][l] * s[l] + six[1][l];
                six[1][l] = six[1][l] * s[l] + six[0][l];
                six[4][l] = six[4][l] * s[l] + six[2][l];
                six[0][l] = six[0][l] * s[l] + inner[0][l];
                six[2][l] = six[2][l] * s[l] + inner[1][l];
                six[5][l] = six[5][l] * s[l] + inner[2][l];
            }
        }
        let [place, by_s, by_t, ss, st, tt] = six;
        let mut away = ZERO;
        for l in 0..POINTS_PER_GROUP {
            away[l] = place[l] - point[d][l];
            sums.place[l] += place[l] * place[l];
            sums.square[l] += away[l] * away[l];
            sums.gradient[0][l] += away[l] * by_s[l];
            sums.gradient[1][l] += away[l] * by_t[l];
            sums.gauss[0][l] += by_s[l] * by_s[l];
            sums.gauss[1][l] += by_s[l] * by_t[l];
            sums.gauss[2][l] += by_t[l] * by_t[l];
            sums.bend[0][l] += 2.0 * (away[l] * ss[l]);
            sums.bend[1][l] += away[l] * st[l];
            sums.bend[2][l] += 2.0 * (away[l] * tt[l]);
        }
        jets[d] = [away, by_s, by_t];
    }
    let [[ax, ux, vx], [ay, uy, vy], [az, uz, vz]] = jets;
    for l in 0..POINTS_PER_GROUP {
        let x = uy[l] * vz[l] - uz[l] * vy[l];
        let y = uz[l] * vx[l] - ux[l] * vz[l];
        let z = ux[l] * vy[l] - uy[l] * vx[l];
        sums.side[l] = -(ax[l] * x + ay[l] * y + az[l] * z);
    }
    sums
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;
    use trueness_geom::spline::basis::Knots;
    use trueness_geom::spline::surface::Surface;

    /// As one by one, for points near and far, inside and beside, over few and many cells.
    #[test]
    fn side_by_side_is_as_one_by_one() {
        let random = &mut Random::new(17);
        let mut together = 0;
        for (degree, spans, height, off) in
            [(3, 6, 1.0, 0.01), (2, 9, 2.0, 0.1), (4, 3, 1.0, 0.01), (3, 12, 6.0, 1.0), (1, 5, 1.0, 0.3)]
        {
            let knots = [spans, spans + 1].map(|n| Knots::uniform(degree, n, 0.0, 10.0));
            let counts = knots.each_ref().map(Knots::count);
            let control: Vec<Point> = (0..counts[0] * counts[1])
                .map(|k| [k / counts[1], k % counts[1]].map(|k| 10.0 * k as f64))
                .map(|[i, j]| {
                    [i / (counts[0] - 1) as f64, j / (counts[1] - 1) as f64, height * random.unit()]
                })
                .collect();
            let center = [5.0, 5.0, 1.0];
            let centered: Vec<Point> =
                control.iter().map(|p| std::array::from_fn(|d| p[d] - center[d])).collect();
            let surface = Surface::new(knots.clone(), control).unwrap();
            let patches = Patches::new(&surface);
            let parameters: Vec<[f64; 2]> = (0..3000)
                .map(|_| [random.unit(), random.unit()].map(|x| (12.0 * x - 1.0).clamp(0.0, 10.0)))
                .collect();
            let points: Vec<Point> = parameters
                .iter()
                .map(|[u, v]| surface.at(*u, *v).map(|x| x + off * (random.unit() - 0.5)))
                .collect();
            let data = Binned::new(&knots, &points, &parameters, center);
            let centered = Patches::of(data.spans.clone(), &centered, counts[1]);
            let found = Found { surface: &patches, centered: &centered };
            let feet = feet(data, &found, &points, &Silent).unwrap();
            let mut square = 0.0;
            for (i, point) in points.iter().enumerate() {
                let alone = patches.foot_from(*point, parameters[i]);
                let [a, b] = [feet.deviations[i], alone.signed(*point)];
                // Another place may be as near, or nearer, where the surface bends to the point.
                assert!((a.abs() - b.abs()).abs() < 1e-9 || a.abs() < b.abs(), "{degree} {i}: {a} {b}");
                let near = (0..2).all(|k| (feet.feet[i][k] - alone.parameters[k]).abs() < 1e-6);
                assert!(!near || (a - b).abs() < 1e-12, "{degree} {i}: {a} {b}");
                let place = surface.at(feet.feet[i][0], feet.feet[i][1]);
                let distance = trueness_geom::space::norm(trueness_geom::space::minus(*point, place));
                assert!((distance - a.abs()).abs() < 1e-9, "{degree} {i}: {distance} {a}");
                together += usize::from(near);
                let own = surface.at(parameters[i][0], parameters[i][1]);
                square += trueness_geom::space::norm(trueness_geom::space::minus(*point, own)).powi(2);
            }
            assert!((feet.sum_of_squares - square).abs() < 1e-10 * square, "{degree}");
        }
        assert!(together > 14_500, "{together}");
    }
}
