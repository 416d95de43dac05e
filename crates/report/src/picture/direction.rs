//! Where the first view looks from: the side that shows most of the places that matter, the most important first.
//!
//! A place is seen from a direction when nothing lies on the way from it to the eye. That is decided exactly, facet by facet,
//! for a short list of directions; the usual one is kept when it shows everything. What hides places is what is drawn; for a
//! cloud it is the reference, drawn or not: between points one looks through, and the part is there all the same.

use super::super::marks::{Mark, Marks};
use super::super::shown::{mapped, shown_objects};
use super::super::subject::Pick;
use super::super::{Geometry, ReportInput, Up, ViewObject, ViewRole};
use super::camera::vertical_and_front;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point, Vector, cross, dot, minus, norm, plus, times, unit};
use trueness_measure::spacing::spacing;

/// Places that the view is chosen for, at most.
const MAX_VIEW_PLACES: usize = 8;
/// Places beside its own at which a pick is seen, at most.
const MAX_OTHER_PLACES: usize = 8;
/// Picks that may have a flag in the stored picture: several times what its columns hold. Whether each is seen costs a search of all that is drawn.
const MAX_FLAGGED_PICKS: usize = 200;
/// A place farther than this from where it was measured, as a share of the diagonal, is not on the part.
const OFF_PART_SHARE: f64 = 0.02;
/// What is nearer to a place than this share of the diagonal does not hide it: it is the surface itself.
const OWN_SURFACE_SHARE: f64 = 0.002;
/// A way through a surface, seen obliquely, is up to this much longer than straight.
const MAX_OBLIQUE_FACTOR: f64 = 3.0;
/// Cosine of the angle beyond which a surface is too oblique to be seen well.
const MIN_SEEN_COSINE: f64 = 0.35;

/// The first view and what it shows.
pub struct Direction {
    /// From the part to the eye, of length 1.
    pub toward: Vector,
    /// The picks that it was chosen for, most important first, and whether each is hidden.
    pub places: Vec<(usize, bool)>,
    /// For each pick, whether it lies so far off that it is not on the part.
    pub off: Vec<bool>,
    /// For each pick that may have a flag in this view, whether it is hidden.
    pub hidden: Vec<bool>,
    /// For each pick, where its leader ends: at its position, or if that is hidden at another place of its feature.
    pub ends: Vec<Point>,
    /// For each pick, whether its value is reached where its leader ends.
    pub reached: Vec<bool>,
}

/// Chooses the direction for a report.
pub fn direction(input: &ReportInput, picks: &[Pick]) -> Direction {
    let subject = input.result;
    let shown = shown_objects(input.objects);
    let finite = |p: &&Point| p.iter().all(|x| x.is_finite());
    let bounds = Aabb::of(shown.iter().flat_map(|o| o.places()).filter(finite));
    let diagonal = if bounds.is_empty() { 0.0 } else { norm(bounds.sides()) };
    let off: Vec<bool> = picks.iter().map(|p| distance(p) > OFF_PART_SHARE * diagonal).collect();
    let mut important = subject.important(picks);
    // What lies off the part is seen from nearly everywhere: the worst on the part decides.
    important.sort_by_key(|n| off[*n]);
    important.truncate(MAX_VIEW_PLACES);
    let measured = shown.iter().any(|o| o.role == ViewRole::Measured);
    let marks = Marks::numbered(input.marks);
    let place = |n: &usize| {
        let mark = picks[*n].mark.and_then(|m| marks.get(m).copied());
        PlaceToSee::of(&picks[*n], off[*n], mark, measured, diagonal)
    };
    let places: Vec<PlaceToSee> = important.iter().map(place).collect();
    let opaque = opaque(input.objects, &shown);
    let all = candidates(input.options.up, subject.facing(), &places);
    let usual = View::of(&places, &all[..1], &opaque).remove(0);
    // The first of the best: the order of the candidates decides between equals.
    let best_of = |from: View, among: &[Vector]| {
        let views = View::of(&places, among, &opaque);
        views.into_iter().fold(from, |best, v| if v.rank() > best.rank() { v } else { best })
    };
    let mut best = usual;
    if !best.shows_all_well() {
        best = best_of(best, &all);
    }
    if best.hides_the_first() {
        best = best_of(best, &straight(input.options.up, &places));
    }
    let mut hidden = vec![false; picks.len()];
    let mapped = mapped(&shown);
    let flagged = flagged(picks, mapped);
    let flags: Vec<PlaceToSee> = flagged.iter().map(place).collect();
    let mut ends: Vec<Point> = picks.iter().map(|p| p.position).collect();
    let mut reached_there = vec![true; picks.len()];
    let blocked = blocked(&probes(&flags), &[best.toward], &opaque);
    let mut first = 0;
    for (n, place) in flagged.iter().zip(&flags) {
        let mine = &blocked[first..first + place.samples.len()];
        first += mine.len();
        hidden[*n] = !place.is_seen(mine, 0);
        let seen = (0..).zip(&place.samples).zip(mine).find(|(_, blocked)| **blocked == 0);
        if let Some(((sample, end), _)) = seen.filter(|_| place.any) {
            ends[*n] = *end;
            reached_there[*n] = sample <= place.reached;
        }
    }
    let places = important.into_iter().zip(best.seen.iter().map(|s| s.is_none())).collect();
    Direction { toward: best.toward, places, off, hidden, ends, reached: reached_there }
}

/// Places beside its own at which a pick is seen where that is hidden. Of a frame, whose leader may end there, others where its value is reached, and
/// then any of its feature: an axis or a middle lies inside the part. Of a mark that has areas alone: its middle lies inside the shell that it is.
pub fn others(pick: &Pick, mark: Option<&Mark>) -> Vec<Point> {
    let Some(mark) = mark else { return vec![] };
    let shell = mark.segments.is_empty() && mark.points.is_empty();
    let all: Vec<Point> = match (pick.frame.is_some(), shell) {
        (true, _) => mark.segments.iter().map(|segment| segment[0]).collect(),
        (false, true) => mark.triangles.iter().map(|corners| corners[0]).collect(),
        (false, false) => vec![],
    };
    let step = all.len().div_ceil(MAX_OTHER_PLACES).max(1);
    let reached = pick.frame.iter().flat_map(|_| &mark.points).take(MAX_OTHER_PLACES);
    reached.copied().chain(all.into_iter().step_by(step)).collect()
}

/// How many of the first of [`others`] show what the pick says.
pub fn reached(pick: &Pick, mark: Option<&Mark>) -> usize {
    match (&pick.frame, mark) {
        (Some(_), Some(mark)) => mark.points.len().min(MAX_OTHER_PLACES),
        _ => others(pick, mark).len(),
    }
}

/// The picks with a flag in the first view, some of the first: of a value of the first map where that is shown, else of a frame.
pub fn flagged(picks: &[Pick], mapped: bool) -> Vec<usize> {
    let has = |p: &Pick| {
        if mapped { p.value.is_some() && p.map.unwrap_or(0) == 0 } else { p.frame.is_some() }
    };
    (0..picks.len()).filter(|n| has(&picks[*n])).take(MAX_FLAGGED_PICKS).collect()
}

/// What hides places: of a measured cloud the reference's surface, drawn or not, where there is one; else what is drawn and
/// not looked through.
fn opaque<'a>(objects: &'a [ViewObject<'a>], shown: &[&'a ViewObject<'a>]) -> Vec<&'a ViewObject<'a>> {
    let surface =
        |o: &&ViewObject| o.role == ViewRole::Reference && o.mesh().is_some_and(|m| !m.faces.is_empty());
    let references: Vec<&ViewObject> =
        objects.iter().filter(surface).filter(|o| o.comparison.unwrap_or(0) == 0).collect();
    let cloud = shown.iter().any(|o| o.role == ViewRole::Measured && o.points().is_some());
    match cloud && !references.is_empty() {
        true => references,
        false => shown.iter().copied().filter(|o| o.role != ViewRole::Element).collect(),
    }
}

/// How far a pick lies from where it was measured.
fn distance(pick: &Pick) -> f64 {
    pick.surface.map_or(0.0, |s| norm(minus(pick.position, s)))
}

/// A place that ought to be seen.
struct PlaceToSee {
    samples: Vec<Point>,
    normal: Option<Vector>,
    /// What is nearer to it does not hide it, millimeters.
    near: f64,
    /// It is seen where any of the samples is; else most of them must be.
    any: bool,
    /// How many of the first samples beside the anchor show what the pick says.
    reached: usize,
}

impl PlaceToSee {
    /// Whether it is seen from direction `d`, by the bits of [`blocked`] of its samples.
    fn is_seen(&self, blocked: &[u64], d: usize) -> bool {
        let free = blocked.iter().filter(|b| *b & (1 << d) == 0).count();
        2 * free > blocked.len() || self.any && free > 0
    }

    fn of(pick: &Pick, off: bool, mark: Option<&Mark>, measured: bool, diagonal: f64) -> PlaceToSee {
        // A mark lies where its row says, as the script has it: a facet of it may be seen where the fault is not.
        let on = mark.is_some() || off || measured;
        let anchor = pick.surface.filter(|_| !on).unwrap_or(pick.position);
        let others = others(pick, mark);
        let any = !others.is_empty();
        let samples = [vec![anchor], others].concat();
        let under = if off { 0.0 } else { MAX_OBLIQUE_FACTOR * distance(pick) };
        let normal = pick.normal.or(mark.and_then(|m| m.normal));
        PlaceToSee {
            samples,
            normal: normal.and_then(|n| unit(n).map(|(n, _)| n)),
            near: under.max(OWN_SURFACE_SHARE * diagonal),
            any,
            reached: reached(pick, mark),
        }
    }
}

/// All samples of places, with what does not hide them.
fn probes(places: &[PlaceToSee]) -> Vec<(Point, f64)> {
    places.iter().flat_map(|p| p.samples.iter().map(|s| (*s, p.near))).collect()
}

/// Directions to look from, the usual one first: corners, sides, then what faces each place obliquely.
fn candidates(up: Up, facing: Option<Vector>, places: &[PlaceToSee]) -> Vec<Vector> {
    let (vertical, front) = vertical_and_front(up);
    let right = cross(front, times(-1.0, vertical));
    let of = |[x, y, z]: [f64; 3]| plus(plus(times(x, right), times(y, front)), times(z, vertical));
    const SIDES: [[f64; 3]; 14] = [
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
        [1.0, -1.0, 1.0],
        [-1.0, -1.0, 1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [1.0, -1.0, -1.0],
        [-1.0, -1.0, -1.0],
        [0.25, 1.0, 0.3],
        [0.25, -1.0, 0.3],
        [1.0, 0.25, 0.3],
        [-1.0, 0.25, 0.3],
        [0.15, 0.25, 1.0],
        [0.15, 0.25, -1.0],
    ];
    let along = |v: Vector| unit(v).map(|(v, _)| v).filter(|v| v.iter().all(|x| x.is_finite()));
    let across = [vertical[1], vertical[2], vertical[0]];
    let oblique = |n: Vector| along(plus(plus(times(1.6, n), vertical), times(0.4, across)));
    let corner = along(of(SIDES[0])).unwrap_or(vertical);
    let first = facing.filter(|n| dot(corner, *n) <= MIN_SEEN_COSINE).and_then(oblique);
    let sides = SIDES.iter().filter_map(|s| along(of(*s)));
    first.into_iter().chain(sides).chain(places.iter().filter_map(|p| oblique(p.normal?))).collect()
}

/// Directions straight on each side and each place: deep in a bore there is no other way out. Hardly tilted, so that there is an
/// upright from above too.
fn straight(up: Up, places: &[PlaceToSee]) -> Vec<Vector> {
    let (vertical, front) = vertical_and_front(up);
    let right = cross(front, times(-1.0, vertical));
    let sides = [vertical, front, right].into_iter().flat_map(|v| [v, times(-1.0, v)]);
    let all = places.iter().filter_map(|p| p.normal).chain(sides);
    all.filter_map(|v| unit(plus(v, times(0.02, front))).map(|(v, _)| v)).collect()
}

/// What a direction shows.
struct View {
    toward: Vector,
    /// For each place how squarely it is seen, 0 to 1; `None` where it is hidden.
    seen: Vec<Option<f64>>,
}

impl View {
    fn of(places: &[PlaceToSee], directions: &[Vector], opaque: &[&ViewObject]) -> Vec<View> {
        let blocked = blocked(&probes(places), directions, opaque);
        let view = |(d, toward): (usize, &Vector)| {
            let mut first = 0;
            let seen = places.iter().map(|p| {
                let mine = &blocked[first..first + p.samples.len()];
                first += p.samples.len();
                let square = p.normal.map_or(1.0, |n| (dot(n, *toward) / MIN_SEEN_COSINE).clamp(0.0, 1.0));
                p.is_seen(mine, d).then_some(square)
            });
            View { toward: *toward, seen: seen.collect() }
        };
        directions.iter().enumerate().map(view).collect()
    }

    fn shows_all_well(&self) -> bool {
        self.seen.iter().all(|s| s.is_some_and(|s| s >= 0.5))
    }

    fn hides_the_first(&self) -> bool {
        self.seen.first().is_some_and(Option::is_none)
    }

    /// The most important place first, from its own side rather than from behind; then how many, then how squarely by and
    /// large.
    fn rank(&self) -> (u8, usize, u32) {
        let seen = || self.seen.iter().flatten();
        let squarely = 2.0 * seen().sum::<f64>() / seen().count().max(1) as f64;
        let first = match self.seen.first() {
            Some(Some(square)) if *square >= 0.5 => 2,
            Some(Some(_)) => 1,
            _ => 0,
        };
        (first, seen().count(), squarely.round() as u32)
    }
}

/// For each probe (a place, and how near to it nothing counts) the directions that something lies in, as bits.
fn blocked(probes: &[(Point, f64)], directions: &[Vector], opaque: &[&ViewObject]) -> Vec<u64> {
    let none = || vec![0u64; probes.len()];
    let join = |mut a: Vec<u64>, b: Vec<u64>| {
        a.iter_mut().zip(b).for_each(|(a, b)| *a |= b);
        a
    };
    let by_triangle = |mesh: &Mesh| {
        let part = |mut bits: Vec<u64>, faces: &[[u32; 3]]| {
            patch_blocks(&mut bits, probes, directions, &corners(mesh, faces));
            bits
        };
        mesh.faces.par_chunks(FACETS_PER_PATCH).fold(none, part).reduce(none, join)
    };
    let by_point = |points: &[Point]| {
        // Scattered at random, points of this size leave a thousandth of their surface open.
        let finite: Vec<Point> = points.iter().filter(|p| p.iter().all(|x| x.is_finite())).copied().collect();
        let radius = 1.5 * spacing(&finite);
        let part = |mut bits: Vec<u64>, p: &Point| {
            for ((from, near), bits) in probes.iter().zip(&mut bits) {
                *bits |= passing(*from, directions, (*p, radius), near + MAX_OBLIQUE_FACTOR * radius, 0.0);
            }
            bits
        };
        points.par_iter().fold(none, part).reduce(none, join)
    };
    opaque.iter().fold(none(), |bits, o| {
        let more = match o.geometry {
            Geometry::Mesh(mesh) => by_triangle(mesh),
            Geometry::Points(points) => by_point(points),
        };
        join(bits, more)
    })
}

/// Facets looked at together: in most files neighbors follow each other.
const FACETS_PER_PATCH: usize = 64;

/// The corners of the facets that are there and finite.
fn corners(mesh: &Mesh, faces: &[[u32; 3]]) -> Vec<[Point; 3]> {
    let at = |v: u32| mesh.positions.get(v as usize).copied().filter(|p| p.iter().all(|x| x.is_finite()));
    let of = |[a, b, c]: &[u32; 3]| Some([at(*a)?, at(*b)?, at(*c)?]);
    faces.iter().filter_map(of).collect()
}

/// Sets the bits of the directions that one of the facets lies in.
fn patch_blocks(bits: &mut [u64], probes: &[(Point, f64)], directions: &[Vector], facets: &[[Point; 3]]) {
    let around = Aabb::of(facets.iter().flatten());
    if around.is_empty() {
        return;
    }
    let middle = times(0.5, plus(around.min, around.max));
    let ball = |corners: &[Point; 3]| {
        let [a, b, c] = *corners;
        let middle = times(1.0 / 3.0, plus(plus(a, b), c));
        (middle, corners.iter().map(|p| norm(minus(*p, middle))).fold(0.0, f64::max))
    };
    let balls: Vec<(Point, f64)> = facets.iter().map(ball).collect();
    let radius = balls.iter().map(|(m, r)| norm(minus(*m, middle)) + r).fold(0.0, f64::max);
    for ((from, near), bits) in probes.iter().zip(bits) {
        let mut open = passing(*from, directions, (middle, radius), near - radius, ROUNDING_SHARE) & !*bits;
        for ([a, b, c], ball) in facets.iter().zip(&balls) {
            if open == 0 {
                break;
            }
            let mut left = open & passing(*from, directions, *ball, near - ball.1, 0.0);
            while left != 0 {
                let n = left.trailing_zeros();
                left &= left - 1;
                if crossing(*from, directions[n as usize], *a, *b, *c).is_some_and(|t| t > *near) {
                    *bits |= 1 << n;
                    open &= !(1 << n);
                }
            }
        }
    }
}

/// More than what rounding can make of a square, as a share of it.
const ROUNDING_SHARE: f64 = 1e-12;

/// The directions, as bits, in which a line from a place passes a ball, and its middle lies farther than `nearest`; with `slack`,
/// a share of the squared distance, also those that rounding would lose.
fn passing(
    from: Point,
    directions: &[Vector],
    (middle, radius): (Point, f64),
    nearest: f64,
    slack: f64,
) -> u64 {
    let way = minus(middle, from);
    let square = dot(way, way);
    let beside = square - radius * radius - slack * (square + radius * radius);
    let nearest = nearest - slack * (nearest.abs() + radius + square.sqrt());
    let passes = |d: &Vector| {
        let t = dot(way, *d);
        t * t >= beside && t > nearest
    };
    directions.iter().enumerate().fold(0, |bits, (n, d)| bits | u64::from(passes(d)) << n)
}

/// How far along a line a triangle lies (Möller and Trumbore 1997); `None` beside it and along it.
fn crossing(from: Point, toward: Vector, a: Point, b: Point, c: Point) -> Option<f64> {
    let (ab, ac, way) = (minus(b, a), minus(c, a), minus(from, a));
    let across = cross(toward, ac);
    let determinant = dot(ab, across);
    if determinant == 0.0 {
        return None;
    }
    let u = dot(way, across) / determinant;
    let other = cross(way, ab);
    let v = dot(toward, other) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| dot(ac, other) / determinant)
}

#[cfg(test)]
mod tests;
