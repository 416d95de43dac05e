//! Changes of a repair: numbers of vertices and facets, and how far the surface went.

use super::facet_set::FacetSet;
use std::collections::HashMap;
use trueness_geom::check::finding::area;
use trueness_geom::closest::{MeshError, Query, QueryError, Tree};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, plus, times};

/// Vertices and facets that stayed, came and went.
///
/// A facet stays if its three vertices do, whichever way it runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Vertices at their old place, bit for bit.
    pub vertices_kept: u64,
    /// Vertices at new places.
    pub vertices_added: u64,
    /// Vertices that no facet uses any more.
    pub vertices_removed: u64,
    /// Facets with the same three vertices as before.
    pub facets_kept: u64,
    /// New facets.
    pub facets_added: u64,
    /// Facets that are gone.
    pub facets_removed: u64,
}

impl Counts {
    /// From `before` to `after`, whose vertices are those of `before` and others behind them.
    pub(super) fn of(before: &Mesh, after: &Mesh) -> Counts {
        let old = before.positions.len();
        let used = |mesh: &Mesh| {
            let mut used = vec![false; after.positions.len()];
            mesh.faces.iter().flatten().for_each(|v| used[*v as usize] = true);
            used
        };
        let (was, is) = (used(before), used(after));
        let count = |of: &dyn Fn(usize) -> bool| (0..is.len()).filter(|v| of(*v)).count() as u64;
        let (was_there, is_there) = (sorted(before), sorted(after));
        let kept = common(&was_there, &is_there);
        Counts {
            vertices_kept: count(&|v| v < old && is[v]),
            vertices_added: count(&|v| v >= old && is[v]),
            vertices_removed: count(&|v| was[v] && !is[v]),
            facets_kept: kept,
            facets_added: is_there.len() as u64 - kept,
            facets_removed: was_there.len() as u64 - kept,
        }
    }
}

/// The facets as sorted triples, sorted.
fn sorted(mesh: &Mesh) -> Vec<[u32; 3]> {
    let triple = |f: &[u32; 3]| {
        let mut f = *f;
        f.sort_unstable();
        f
    };
    let mut all: Vec<[u32; 3]> = mesh.faces.par_iter().map(triple).collect();
    all.par_sort_unstable();
    all
}

/// How many entries two sorted lists have in common.
fn common(a: &[[u32; 3]], b: &[[u32; 3]]) -> u64 {
    let (mut i, mut j, mut count) = (0, 0, 0);
    while let (Some(x), Some(y)) = (a.get(i), b.get(j)) {
        count += u64::from(x == y);
        (i, j) = (i + usize::from(x <= y), j + usize::from(y <= x));
    }
    count
}

/// Distances from one surface to another, mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Way {
    /// The greatest found.
    pub max: f64,
    /// Mean over the area; 0 where there is none.
    pub mean: f64,
}

/// How far a repair took the surface, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// From the old surface to the new one: missing surface.
    pub there: Way,
    /// From the new surface to the old one: added surface.
    pub back: Way,
}

/// Why nothing was measured.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DeviationError {
    /// A mesh cannot be measured against.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The work was stopped.
    #[error(transparent)]
    Query(#[from] QueryError),
}

/// Places on a facet that are asked about: its corners, the middles of its edges, its own middle.
pub(super) fn places([a, b, c]: [Point; 3]) -> [Point; 7] {
    let half = |p, q| times(0.5, plus(p, q));
    [a, b, c, half(a, b), half(b, c), half(c, a), times(1.0 / 3.0, plus(a, plus(b, c)))]
}

/// The answers of `ask` for each of these places. Places that are there several times are asked about once. At a corner
/// of very many facets each answer takes as long as there are facets.
pub(super) fn once<E>(
    places: &[Point],
    ask: impl FnOnce(&[Point]) -> Result<Vec<f64>, E>,
) -> Result<Vec<f64>, E> {
    let mut number: HashMap<[u64; 3], u32> = HashMap::with_capacity(places.len());
    let mut different: Vec<Point> = vec![];
    let mut numbered = |p: &Point| {
        *number.entry(p.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
            different.push(*p);
            different.len() as u32 - 1
        })
    };
    let of: Vec<u32> = places.iter().map(&mut numbered).collect();
    let answers = ask(&different)?;
    Ok(of.into_iter().map(|i| answers[i as usize]).collect())
}

/// Exact for cubic functions on a facet: corners, middles of edges, middle.
const CUBATURE_WEIGHTS: [f64; 7] =
    [1.0 / 20.0, 1.0 / 20.0, 1.0 / 20.0, 2.0 / 15.0, 2.0 / 15.0, 2.0 / 15.0, 9.0 / 20.0];

/// Distances from one surface to another. Facets of `without` do not count.
pub(super) fn way(
    (from, without): (&Mesh, &FacetSet),
    to: &Mesh,
    progress: &dyn Progress,
) -> Result<Way, DeviationError> {
    let there = FacetSet::of(to, |_| true);
    let corners = |f: &[u32; 3]| from.places(f);
    let counts =
        |f: &&[u32; 3]| corners(f).iter().flatten().all(|x| x.is_finite()) && !without.holds(from, f);
    let sampled = |f: &[u32; 3]| (area(corners(f)), (!there.holds(from, f)).then(|| corners(f)));
    let counting: Vec<(f64, Option<[Point; 3]>)> =
        from.faces.par_iter().filter(counts).map(sampled).collect();
    let total: f64 = counting.iter().map(|(area, _)| area).sum();
    let changed: Vec<[Point; 3]> = counting.into_iter().filter_map(|(_, changed)| changed).collect();
    if changed.is_empty() {
        return Ok(Way::default());
    }
    let points: Vec<Point> = changed.iter().flat_map(|t| places(*t)).collect();
    let tree = Tree::build(to)?;
    let distances = once(&points, |places| tree.distances(places, &Query::default(), progress))?;
    let mut way = Way::default();
    for (t, d) in changed.iter().zip(distances.chunks_exact(CUBATURE_WEIGHTS.len())) {
        way.max = d.iter().copied().fold(way.max, f64::max);
        let share = if total > 0.0 { area(*t) / total } else { 0.0 };
        way.mean += share * d.iter().zip(CUBATURE_WEIGHTS).map(|(d, w)| d * w).sum::<f64>();
    }
    Ok(way)
}
