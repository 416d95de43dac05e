//! The volume of the places that a closed mesh winds around, whether its bodies cross, touch or contain each other or not.
//!
//! The volume of a set of places is an integral over its boundary (the divergence theorem). The boundary of the places
//! with winding number 1 or more is made of parts of facets. The number passes from below 1 to 1 there. A facet that
//! meets no other is such a part as a whole or not at all, and its neighbors likewise. Facets that meet others are cut
//! up where they do (`meeting`, `cells`). The winding number beside a part is found by a ray from its middle, decided
//! exactly. Only places of cuts are rounded. The vector area of a closed boundary is zero: its difference from that
//! tells how much of the boundary was missed.

mod cells;
mod meeting;
#[cfg(test)]
mod tests;

use cells::{Cell, Point2, cells};
use meeting::{Facet, Meeting, meeting};
use std::collections::BTreeMap;
use std::convert::Infallible;
use trueness_geom::check::Known;
use trueness_geom::check::nesting::Container;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::sum::Sums;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, Vector, dot, minus, norm, plus, times};
use trueness_geom::topology::union::Sets;
use trueness_geom::topology::{EdgeAt, Properties, Topology};

/// Volumes, mm³.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Enclosed {
    /// Volume of the places with winding number 1 or more.
    pub volume: f64,
    /// Volume of the places with winding number −1 or less: bodies that look inwards.
    pub inverted: f64,
    /// Bound of the error of either. It is the vector area of the boundary, which should be zero, times half the
    /// diagonal, and rounding. Estimated, not proved.
    pub error: f64,
    /// Facets that meet no other and bound either, by number.
    pub(super) bounds: Vec<bool>,
    /// The parts that bound either, of facets that meet others.
    pub(super) pieces: Vec<Piece>,
}

/// A part of a facet.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    pub facet: u32,
    pub middle: Point,
    pub corners: [Point; 4],
}

impl Enclosed {
    /// A sound mesh encloses its signed volume.
    pub(super) fn sound(mesh: &Mesh, properties: &Properties) -> Enclosed {
        let error = VOLUME_ROUNDING_SHARE * properties.area * properties.bounds.diagonal();
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

/// Error that rounding adds at most, as a share of the sum of all terms.
const VOLUME_ROUNDING_SHARE: f64 = 1e-14;
/// Facets at one place, at most.
const MAX_FACETS_AT_ONE_PLACE: usize = 64;

/// Whether every facet that counts has a neighbor at each edge.
pub(super) fn is_closed(topology: &Topology) -> bool {
    topology.boundary_edges.is_empty() && topology.not_finite.is_empty() && topology.counting_facets > 0
}

/// Volume enclosed by a welded mesh. Facets with a coordinate that is not finite must not be there. `pairs`: all its facets
/// that meet where they should not, `None` if they are too many.
///
/// Cost: linear, and for each part of a facet that meets others a ray past those in its column.
///
/// # Errors
/// [`NotEnclosed`].
pub(super) fn enclosed(
    mesh: &Mesh,
    Known { topology, properties, .. }: &Known,
    pairs: Option<Vec<[u32; 2]>>,
    progress: &dyn Progress,
) -> Result<Enclosed, NotEnclosed> {
    if !is_closed(topology) {
        return Err(NotEnclosed::Open);
    }
    if !is_balanced(mesh, topology) {
        return Err(NotEnclosed::Inconsistent);
    }
    let meets = meets(topology, &pairs.ok_or(NotEnclosed::Tangle)?)?;
    let bounds = properties.bounds;
    let (sides, mut shortest) = (bounds.sides(), [0, 1, 2]);
    shortest.sort_by(|i: &usize, j| sides[*i].total_cmp(&sides[*j]));
    let mut is_whole = vec![true; mesh.faces.len()];
    meets.keys().for_each(|f| is_whole[*f as usize] = false);
    let center = times(0.5, plus(bounds.min, bounds.max));
    let solid = Solid { mesh, shortest, center, meets: &meets, is_whole: &is_whole, progress };
    let sheets = solid.sheets(topology);
    let cut: Vec<u32> = meets.keys().copied().collect();
    let parts: Vec<Vec<Part>> = cut.par_iter().map(|&f| solid.cut(f)).collect::<Result<_, _>>()?;
    let rays = Rays::new(&solid, sheets.representative.iter().flatten().chain(parts.iter().flatten()));
    let whole = sheets.windings(&rays)?;
    let windings = |of: &Vec<Part>| of.iter().map(|part| rays.winding(part)).collect();
    let sum_of_whole = || {
        let mut sums = Sums::<9>::ZERO;
        for (f, winding) in (0..).zip(&whole) {
            if winding.bounds() && is_whole[f as usize] {
                sums.add(solid.facet(f).terms(winding, 0.5, 1.0));
            }
        }
        sums
    };
    // The sum goes on in the order of the facets, beside the rays.
    let all_windings = || parts.par_iter().map(windings).collect::<Vec<Vec<Winding>>>();
    let (mut sums, windings) = rayon::join(sum_of_whole, all_windings);
    if progress.cancelled() {
        return Err(Cancelled.into());
    }
    let mut result = Enclosed { bounds: whole.iter().map(|w| w.bounds()).collect(), ..Enclosed::default() };
    for (parts, windings) in parts.iter().zip(&windings) {
        sums.add(solid.sum(parts, windings, &mut result.pieces));
    }
    let [v, i, x, y, z, ix, iy, iz, size] = sums.each().map(|s| s.value());
    let missed = norm([x, y, z]).max(norm([ix, iy, iz]));
    // Rounding alone may leave less than nothing.
    (result.volume, result.inverted) = (v.max(0.0), i.max(0.0));
    result.error = 0.5 * missed * bounds.diagonal() + VOLUME_ROUNDING_SHARE * size;
    Ok(result)
}

/// Whether the directions at each edge cancel.
fn is_balanced(mesh: &Mesh, topology: &Topology) -> bool {
    let even = |e: &EdgeAt| {
        let [a, b] = e.vertices;
        let facets = topology.facets_at_edge(mesh, e.vertices);
        let runs = |f: &&u32| {
            let face = mesh.faces[**f as usize];
            (0..3).any(|k| face[k] == a && face[(k + 1) % 3] == b)
        };
        2 * facets.iter().filter(runs).count() == facets.len()
    };
    topology.inconsistent_edges.is_empty() && topology.non_manifold_edges.par_iter().all(even)
}

/// For each facet that meets others anywhere but in common vertices and edges: those others, ascending. `pairs`: those that
/// do not coincide.
fn meets(topology: &Topology, pairs: &[[u32; 2]]) -> Result<BTreeMap<u32, Vec<u32>>, NotEnclosed> {
    let mut meets = BTreeMap::<u32, Vec<u32>>::new();
    let mut add = |a: u32, b: u32| {
        meets.entry(a).or_default().push(b);
        meets.entry(b).or_default().push(a);
    };
    pairs.iter().for_each(|&[a, b]| add(a, b));
    let mut same = topology.duplicate_facets.clone();
    same.sort_unstable();
    for group in same.chunk_by(|a, b| a[0] == b[0]) {
        if group.len() > MAX_FACETS_AT_ONE_PLACE {
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
    /// Terms of a part of the facet: two volumes, two vector areas, the size of the term. The part is `share` of the
    /// facet's vector, and counts by its weight.
    fn terms(&self, winding: &Winding, share: f64, weight: f64) -> [f64; 9] {
        let vector = times(share * weight, self.vector());
        let volume = dot(vector, self.local[0]) / 3.0;
        let (s, t) = (winding.step(), winding.inverted());
        let ([x, y, z], [ix, iy, iz]) = (times(s, vector), times(t, vector));
        [s * volume, t * volume, x, y, z, ix, iy, iz, volume.abs()]
    }
}

/// The part of a facet that is asked about, or the whole of one.
struct Part {
    facet: u32,
    /// Its middle.
    at: Point,
    corners: [Point; 4],
    /// As seen along the axis along which the facet is seen largest.
    area: f64,
    /// Other facets that lie upon it, and +1 if they look the same way, −1 if not.
    coincident: Vec<(u32, i32)>,
}

struct Solid<'a> {
    mesh: &'a Mesh,
    center: Point,
    /// The axes, by the extent of the mesh along them.
    shortest: [usize; 3],
    meets: &'a BTreeMap<u32, Vec<u32>>,
    /// Which facets meet no other.
    is_whole: &'a [bool],
    progress: &'a dyn Progress,
}

impl Solid<'_> {
    fn facet(&self, f: u32) -> Facet {
        let vertices = self.mesh.faces[f as usize];
        let places = self.mesh.places(&vertices);
        Facet { vertices, places, local: places.map(|p| minus(p, self.center)) }
    }

    /// The axis for rays from a facet with this normal. It is the one along which the mesh is shortest, so that rays
    /// pass little of it. The facet must not be too steep to it.
    fn axis(&self, vector: Vector) -> usize {
        /// Share of the greatest coordinate of the normal.
        const MIN_STEEP_SHARE: f64 = 0.25;
        let most = vector[steepest(vector)].abs();
        self.shortest.into_iter().find(|&k| vector[k].abs() >= MIN_STEEP_SHARE * most).unwrap_or(0)
    }

    /// The facets that meet no other, as far as they hang together.
    fn sheets(&self, topology: &Topology) -> Sheets {
        let sets = Sets::new(self.mesh.faces.len());
        let joined = topology.each_edge(self.mesh, |edge| {
            if let [a, b] = edge
                && self.is_whole[a.facet as usize]
                && self.is_whole[b.facet as usize]
            {
                sets.join(a.facet, b.facet);
            }
            Ok::<(), Infallible>(())
        });
        let Ok(()) = joined;
        let (count, sheet_of) = sets.numbered(|_| true);
        let sizes: Vec<f64> =
            (0..self.mesh.faces.len() as u32).into_par_iter().map(|f| norm(self.facet(f).vector())).collect();
        let mut largest: Vec<Option<u32>> = vec![None; count];
        for (f, sheet) in (0u32..).zip(&sheet_of).filter(|(f, _)| self.is_whole[*f as usize]) {
            let largest = &mut largest[*sheet as usize];
            if largest.is_none_or(|l| sizes[f as usize] > sizes[l as usize]) {
                *largest = Some(f);
            }
        }
        let representative = |facet: u32| {
            let [a, b, c] = self.facet(facet).local;
            let at = plus(self.center, times(1.0 / 3.0, plus(a, plus(b, c))));
            Part { facet, at, corners: [at; 4], area: 0.0, coincident: vec![] }
        };
        Sheets { sheet_of, representative: largest.into_iter().map(|f| f.map(representative)).collect() }
    }

    /// The parts of a facet that meets others.
    fn cut(&self, f: u32) -> Result<Vec<Part>, NotEnclosed> {
        if self.progress.cancelled() {
            return Err(Cancelled.into());
        }
        let facet = self.facet(f);
        let vector = facet.vector();
        let axis = steepest(vector);
        if vector[axis] == 0.0 {
            return Ok(vec![]);
        }
        let flat = |p: &Point| [p[(axis + 1) % 3], p[(axis + 2) % 3]];
        let (mut segments, mut coincident) = (vec![], vec![]);
        for &g in self.meets.get(&f).into_iter().flatten() {
            let other = self.facet(g);
            match if f < g { meeting(&facet, &other) } else { meeting(&other, &facet) } {
                Meeting::Nothing => {}
                Meeting::Segment(s) => segments.push(s.map(|p| flat(&p))),
                Meeting::Coplanar => {
                    let [a, b, c] = other.local.map(|p| flat(&p));
                    segments.extend([[a, b], [b, c], [c, a]]);
                    coincident.push((g, if dot(other.vector(), vector) > 0.0 { 1 } else { -1 }, [a, b, c]));
                }
            }
        }
        let found = cells(&facet.local.map(|p| flat(&p)), &segments).ok_or(NotEnclosed::Tangle)?;
        let place = |p: Point2| plus(self.center, lifted(&facet, vector, axis, p));
        let part = |Cell { center, corners, area }: Cell| Part {
            facet: f,
            at: place(center),
            corners: corners.map(place),
            area,
            coincident: coincident.iter().filter(|u| holds(&u.2, &center)).map(|u| (u.0, u.1)).collect(),
        };
        Ok(found.into_iter().map(part).collect())
    }

    /// Sum of the terms of a facet's parts; those that bound something go to `pieces`.
    fn sum(&self, parts: &[Part], windings: &[Winding], pieces: &mut Vec<Piece>) -> [f64; 9] {
        let mut sums = Sums::<9>::ZERO;
        for (part, winding) in parts.iter().zip(windings).filter(|(_, winding)| winding.bounds()) {
            let facet = self.facet(part.facet);
            let vector = facet.vector();
            let whole = vector[steepest(vector)].abs();
            let weight = 1.0 / (1 + part.coincident.len()) as f64;
            sums.add(facet.terms(winding, part.area / whole, weight));
            if part.area > MIN_PART_SHARE * whole {
                pieces.push(Piece { facet: part.facet, middle: part.at, corners: part.corners });
            }
        }
        sums.each().map(|s| s.value())
    }
}

/// For rays along each axis, as far as they are asked for.
struct Rays<'a> {
    solid: &'a Solid<'a>,
    along: [Container<'a>; 3],
}

impl<'a> Rays<'a> {
    /// For rays from the middles of these parts.
    fn new<'p>(solid: &'a Solid<'a>, parts: impl Iterator<Item = &'p Part>) -> Rays<'a> {
        let mut places: [Vec<Point>; 3] = Default::default();
        for part in parts {
            places[solid.axis(solid.facet(part.facet).vector())].push(part.at);
        }
        let all: Vec<u32> = (0..solid.mesh.faces.len() as u32).collect();
        let along = [0, 1, 2].map(|axis| Container::at(solid.mesh, &all, axis, &places[axis]));
        Rays { solid, along }
    }

    /// Winding numbers before and behind a part.
    fn winding(&self, Part { facet: f, at, coincident, .. }: &Part) -> Winding {
        if self.solid.progress.cancelled() {
            return Winding::default();
        }
        let vector = self.solid.facet(*f).vector();
        let axis = self.solid.axis(vector);
        let (rays, mut beyond) = (&self.along[axis], 0);
        let is_coincident = |g: u32| coincident.iter().any(|u| u.0 == g);
        if rays.is_early(at) {
            // All that the line passes winds around it 0 times: the shorter way is to count the facets before.
            rays.facets_not_behind(*f, at, |g, around| beyond -= if is_coincident(g) { 0 } else { around });
            beyond -= coincident.iter().map(|u| rays.around(u.0, at)).sum::<i32>();
        } else {
            rays.facets_behind(*f, at, |g, around| beyond += if is_coincident(g) { 0 } else { around });
        }
        let layers = 1 + coincident.iter().map(|u| u.1).sum::<i32>();
        match vector[axis] > 0.0 {
            true => Winding { outside: beyond, inside: beyond + layers },
            false => Winding { outside: beyond - layers, inside: beyond },
        }
    }
}

/// The facets that meet no other.
struct Sheets {
    /// For each facet the number of those that it hangs together with; facets that meet others have one of their own.
    sheet_of: Vec<u32>,
    /// For each sheet its largest facet; none for facets that meet others.
    representative: Vec<Option<Part>>,
}

impl Sheets {
    /// Winding numbers at each facet: the same for all that hang together, 0 where facets meet others.
    fn windings(&self, rays: &Rays) -> Result<Vec<Winding>, Cancelled> {
        let winding = |part: &Option<Part>| part.as_ref().map_or(Winding::default(), |p| rays.winding(p));
        let of_sheet: Vec<Winding> = self.representative.par_iter().map(winding).collect();
        if rays.solid.progress.cancelled() {
            return Err(Cancelled);
        }
        Ok(self.sheet_of.par_iter().map(|s| of_sheet[*s as usize]).collect())
    }
}

/// Parts of less than this share of their facet may reach across a segment that ends a hair too early. Their middle
/// says nothing of where they lie.
const MIN_PART_SHARE: f64 = 1e-9;

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
