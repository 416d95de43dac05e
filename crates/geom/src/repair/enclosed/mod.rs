//! The volume of the places that a closed mesh winds around, whether its bodies cross, touch or contain each other or not.
//!
//! The volume of a set of places is an integral over its boundary (the divergence theorem), and the boundary of the places
//! with winding number 1 or more is made of those parts of facets where the number passes from below 1 to 1. Facets
//! that meet no other are such parts as a whole or not at all, and their neighbours likewise; facets that meet others are
//! cut up where they do (`meeting`, `cells`). The winding number beside a part is found by a ray from its middle, decided
//! exactly. What is rounded are places of cuts alone. The vector area of a closed boundary is zero: what it is off by
//! tells how much of the boundary was missed.

mod cells;
mod meeting;
#[cfg(test)]
mod tests;

use crate::check::intersect;
use crate::check::nesting::Container;
use crate::mesh::Mesh;
use crate::num::sum::Sums;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, Vector, dot, minus, norm, plus, times};
use crate::topology::union::Sets;
use crate::topology::{Properties, Topology};
use cells::{Cell, cells};
use meeting::{Facet, Meeting, meeting};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Volumes, mm³.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Enclosed {
    /// Of the places with winding number 1 or more.
    pub volume: f64,
    /// Of the places with winding number −1 or less: bodies that look inwards.
    pub inverted: f64,
    /// What either may be off by: the vector area of the boundary, which should be zero, times half the diagonal, and
    /// rounding. Estimated, not proved.
    pub error: f64,
    /// Facets that meet no other and bound either, by number.
    pub(super) bounds: Vec<bool>,
    /// Middles of the parts that bound either, of facets that meet others, each with its facet.
    pub(super) middles: Vec<(u32, Point)>,
}

impl Enclosed {
    /// Of a sound mesh: its signed volume.
    pub(super) fn sound(mesh: &Mesh, properties: &Properties) -> Enclosed {
        let error = ROUNDING * properties.area * properties.bounds.diagonal();
        let bounds = vec![true; mesh.faces.len()];
        Enclosed { volume: properties.signed_volume, error, bounds, ..Enclosed::default() }
    }
}

/// Why there is no volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotEnclosed {
    /// Some edges have one facet.
    #[error("the mesh is open")]
    Open,
    /// At some edges not as many facets run one way as the other.
    #[error("at some edges not as many facets run one way as the other")]
    Inconsistent,
    /// Too many facets meet others.
    #[error("too many facets cross")]
    Tangle,
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// What rounding adds at most, as a share of the sum of all terms.
const ROUNDING: f64 = 1e-14;
/// Facets at one place, and pairs of facets that meet beyond eight for each facet, at most.
const HEAP: usize = 64;
const FEW: usize = 10_000;

/// Volume enclosed by a welded mesh. Facets with a coordinate that is not finite must not be there.
///
/// Cost: a search for crossings, and for each part of a facet that meets others a ray past those in its column.
///
/// # Errors
/// [`NotEnclosed`].
pub(super) fn enclosed(
    mesh: &Mesh,
    topology: &Topology,
    progress: &dyn Progress,
) -> Result<Enclosed, NotEnclosed> {
    let open = !topology.boundary_edges.is_empty() || !topology.not_finite.is_empty();
    if open || topology.counting_facets == 0 {
        return Err(NotEnclosed::Open);
    }
    let edges = balanced(mesh).ok_or(NotEnclosed::Inconsistent)?;
    let meets = meets(mesh, topology, progress)?;
    let bounds = Properties::of(mesh, topology).bounds;
    let (sides, mut shortest) = (bounds.sides(), [0, 1, 2]);
    shortest.sort_by(|i: &usize, j| sides[*i].total_cmp(&sides[*j]));
    let solid = Solid {
        mesh,
        shortest,
        centre: times(0.5, plus(bounds.min, bounds.max)),
        rays: Default::default(),
        meets: &meets,
        progress,
    };
    let whole = solid.whole(&edges)?;
    let cut: Vec<u32> = meets.keys().copied().collect();
    let parts: Vec<Part> = cut.par_iter().map(|&f| solid.cut(f)).collect::<Result<_, _>>()?;
    let mut result = Enclosed { bounds: whole.iter().map(|w| w.bounds()).collect(), ..Enclosed::default() };
    let mut sums = Sums::<9>::ZERO;
    for (f, winding) in (0..).zip(&whole) {
        if winding.bounds() && !meets.contains_key(&f) {
            sums.add(solid.facet(f).terms(winding, 0.5, 1.0));
        }
    }
    for part in parts {
        sums.add(part.terms);
        result.middles.extend(part.middles);
    }
    let [v, i, x, y, z, ix, iy, iz, size] = sums.each().map(|s| s.value());
    let missed = norm([x, y, z]).max(norm([ix, iy, iz]));
    (result.volume, result.inverted) = (v, i);
    result.error = 0.5 * missed * bounds.diagonal() + ROUNDING * size;
    Ok(result)
}

/// The edges of all facets as lower vertex, higher vertex, facet, direction; sorted. `None` where the directions at an edge do
/// not cancel.
fn balanced(mesh: &Mesh) -> Option<Vec<(u32, u32, u32, i8)>> {
    let sides = |(f, face): (usize, &[u32; 3])| {
        let face = *face;
        (0..3).map(move |k| {
            let (a, b) = (face[k], face[(k + 1) % 3]);
            (a.min(b), a.max(b), f as u32, if a < b { 1 } else { -1 })
        })
    };
    let mut edges: Vec<_> = mesh.faces.iter().enumerate().flat_map(sides).filter(|e| e.0 != e.1).collect();
    edges.par_sort_unstable();
    let even = |e: &[(u32, u32, u32, i8)]| e.iter().map(|e| i32::from(e.3)).sum::<i32>() == 0;
    edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).all(even).then_some(edges)
}

/// For each facet that meets others anywhere but in common vertices and edges: those others, ascending.
fn meets(
    mesh: &Mesh,
    topology: &Topology,
    progress: &dyn Progress,
) -> Result<BTreeMap<u32, Vec<u32>>, NotEnclosed> {
    let most = FEW + 8 * mesh.faces.len();
    let all = vec![true; mesh.faces.len()];
    let pairs = intersect::few_self_intersections(mesh, topology, &all, most, progress)?
        .ok_or(NotEnclosed::Tangle)?;
    let mut meets = BTreeMap::<u32, Vec<u32>>::new();
    let mut add = |a: u32, b: u32| {
        meets.entry(a).or_default().push(b);
        meets.entry(b).or_default().push(a);
    };
    pairs.iter().for_each(|&[a, b]| add(a, b));
    let mut same = topology.duplicate_facets.clone();
    same.sort_unstable();
    for group in same.chunk_by(|a, b| a[0] == b[0]) {
        if group.len() > HEAP {
            return Err(NotEnclosed::Tangle);
        }
        for (i, [first, again]) in group.iter().enumerate() {
            add(*first, *again);
            group[..i].iter().for_each(|earlier| add(earlier[1], *again));
        }
    }
    meets.values_mut().for_each(|others| others.sort_unstable());
    Ok(meets)
}

/// Winding numbers before and behind a part of a facet.
#[derive(Clone, Copy, Default)]
struct Winding {
    outside: i32,
    inside: i32,
}

impl Winding {
    /// +1 where the part bounds places wound around, material behind it; −1 where in front of it.
    fn step(self) -> f64 {
        f64::from(i32::from(self.inside >= 1) - i32::from(self.outside >= 1))
    }

    /// The same of places wound around the other way.
    fn inverted(self) -> f64 {
        f64::from(i32::from(self.inside <= -1) - i32::from(self.outside <= -1))
    }

    fn bounds(self) -> bool {
        self.step() != 0.0 || self.inverted() != 0.0
    }
}

impl Facet {
    /// What a part of the facet adds: two volumes, two vector areas, the size of the term. The part is `share` of the
    /// facet's vector, and counts by its weight.
    fn terms(&self, winding: &Winding, share: f64, weight: f64) -> [f64; 9] {
        let vector = times(share * weight, self.vector());
        let volume = dot(vector, self.local[0]) / 3.0;
        let (s, t) = (winding.step(), winding.inverted());
        let ([x, y, z], [ix, iy, iz]) = (times(s, vector), times(t, vector));
        [s * volume, t * volume, x, y, z, ix, iy, iz, volume.abs()]
    }
}

/// What the parts of one facet add.
#[derive(Default)]
struct Part {
    terms: [f64; 9],
    middles: Vec<(u32, Point)>,
}

struct Solid<'a> {
    mesh: &'a Mesh,
    centre: Point,
    /// The axes, by the extent of the mesh along them.
    shortest: [usize; 3],
    /// For rays along each axis, made when first needed.
    rays: [OnceLock<Container<'a>>; 3],
    meets: &'a BTreeMap<u32, Vec<u32>>,
    progress: &'a dyn Progress,
}

impl Solid<'_> {
    fn facet(&self, f: u32) -> Facet {
        let vertices = self.mesh.faces[f as usize];
        let places = vertices.map(|v| self.mesh.positions[v as usize]);
        Facet { vertices, places, local: places.map(|p| minus(p, self.centre)) }
    }

    /// The axis for rays from a facet with this normal: of those that it is not too steep to, the one along which the mesh is
    /// shortest, so that rays pass little of it.
    fn axis(&self, vector: Vector) -> usize {
        /// Share of the greatest coordinate of the normal.
        const STEEP: f64 = 0.25;
        let most = vector[steepest(vector)].abs();
        self.shortest.into_iter().find(|&k| vector[k].abs() >= STEEP * most).unwrap_or(0)
    }

    fn rays(&self, axis: usize) -> &Container<'_> {
        let all = || (0..self.mesh.faces.len() as u32).collect::<Vec<_>>();
        self.rays[axis].get_or_init(|| Container::new(self.mesh, &all(), axis))
    }

    /// Winding numbers before and behind the facet where it is seen at `p` along its axis. `upon`: other facets that lie upon it there, and
    /// +1 if they look the same way, −1 if not.
    fn winding(&self, f: u32, vector: Vector, p: &Point, upon: &[(u32, i32)]) -> Winding {
        let axis = self.axis(vector);
        let mut beyond = 0;
        self.rays(axis).behind(f, p, |g, around| {
            if upon.iter().all(|u| u.0 != g) {
                beyond += around;
            }
        });
        let layers = 1 + upon.iter().map(|u| u.1).sum::<i32>();
        match vector[axis] > 0.0 {
            true => Winding { outside: beyond, inside: beyond + layers },
            false => Winding { outside: beyond - layers, inside: beyond },
        }
    }

    /// Winding numbers at the facets that meet no other: the same for all that hang together.
    fn whole(&self, edges: &[(u32, u32, u32, i8)]) -> Result<Vec<Winding>, NotEnclosed> {
        let faces = self.mesh.faces.len();
        let sets = Sets::new(faces);
        for edge in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            if let [a, b] = edge {
                let free = |f: u32| !self.meets.contains_key(&f);
                if free(a.2) && free(b.2) {
                    sets.join(a.2, b.2);
                }
            }
        }
        let mut largest = BTreeMap::<u32, (f64, u32)>::new();
        for f in (0..faces as u32).filter(|f| !self.meets.contains_key(f)) {
            let size = norm(self.facet(f).vector());
            let entry = largest.entry(sets.root(f)).or_insert((size, f));
            if size > entry.0 {
                *entry = (size, f);
            }
        }
        let asked: Vec<(u32, u32)> = largest.into_iter().map(|(root, (_, f))| (root, f)).collect();
        let found = asked.par_iter().map(|&(root, f)| {
            if self.progress.cancelled() {
                return Err(Cancelled.into());
            }
            let facet = self.facet(f);
            let [a, b, c] = facet.local;
            let middle = plus(self.centre, times(1.0 / 3.0, plus(a, plus(b, c))));
            Ok((root, self.winding(f, facet.vector(), &middle, &[])))
        });
        let found: BTreeMap<u32, Winding> = found.collect::<Result<_, NotEnclosed>>()?;
        Ok((0..faces as u32).map(|f| found.get(&sets.root(f)).copied().unwrap_or_default()).collect())
    }

    /// What a facet adds that meets others.
    fn cut(&self, f: u32) -> Result<Part, NotEnclosed> {
        if self.progress.cancelled() {
            return Err(Cancelled.into());
        }
        let facet = self.facet(f);
        let vector = facet.vector();
        let axis = steepest(vector);
        if vector[axis] == 0.0 {
            return Ok(Part::default());
        }
        let flat = |p: &Point| [p[(axis + 1) % 3], p[(axis + 2) % 3]];
        let (mut segments, mut upon) = (vec![], vec![]);
        for &g in self.meets.get(&f).into_iter().flatten() {
            let other = self.facet(g);
            match if f < g { meeting(&facet, &other) } else { meeting(&other, &facet) } {
                Meeting::Nothing => {}
                Meeting::Segment(s) => segments.push(s.map(|p| flat(&p))),
                Meeting::Coplanar => {
                    let [a, b, c] = other.local.map(|p| flat(&p));
                    segments.extend([[a, b], [b, c], [c, a]]);
                    upon.push((g, if dot(other.vector(), vector) > 0.0 { 1 } else { -1 }, [a, b, c]));
                }
            }
        }
        let found = cells(&facet.local.map(|p| flat(&p)), &segments).ok_or(NotEnclosed::Tangle)?;
        let (mut sums, mut middles) = (Sums::<9>::ZERO, vec![]);
        for Cell { centre, area } in found {
            let there = upon.iter().filter(|u| holds(&u.2, &centre)).map(|u| (u.0, u.1));
            let there: Vec<(u32, i32)> = there.collect();
            let p = plus(self.centre, lifted(&facet, vector, axis, centre));
            let winding = self.winding(f, vector, &p, &there);
            if winding.bounds() {
                let weight = 1.0 / (1 + there.len()) as f64;
                sums.add(facet.terms(&winding, area / vector[axis].abs(), weight));
                if area > HAIR * vector[axis].abs() {
                    middles.push((f, p));
                }
            }
        }
        Ok(Part { terms: sums.each().map(|s| s.value()), middles })
    }
}

/// Parts of less than this share of their facet may reach across a segment that ends a hair too early: their middle says nothing of
/// where they lie.
const HAIR: f64 = 1e-9;

/// The axis along which a facet with this normal is seen largest.
fn steepest(vector: Vector) -> usize {
    let [x, y, z] = vector.map(f64::abs);
    if x >= y && x >= z { 0 } else { usize::from(z > y) + 1 }
}

/// The place of the facet's plane that is seen at `p` along the axis.
fn lifted(facet: &Facet, vector: Vector, axis: usize, p: [f64; 2]) -> Point {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let origin = facet.local[0];
    let mut place = [0.0; 3];
    (place[u], place[v]) = (p[0], p[1]);
    place[axis] =
        origin[axis] - (vector[u] * (p[0] - origin[u]) + vector[v] * (p[1] - origin[v])) / vector[axis];
    place
}

/// Whether the triangle holds the place.
fn holds(triangle: &[[f64; 2]; 3], p: &[f64; 2]) -> bool {
    let side = |i: usize| {
        let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    };
    let sides = [side(0), side(1), side(2)];
    sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0)
}
