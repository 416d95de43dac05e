//! One measured set against one or several references, in one pass over the points.

mod against;
mod along;
mod between_vertices;
mod cad_target;
mod coverage;
mod covered;
mod document;
mod excluded;
mod extremes;
mod facing;
mod found;
mod judgement;
mod kept;
mod map;
mod options;
mod outliers;
pub mod plausibility;
mod reference;
mod region;
mod research;
mod reverse;
mod shown;
mod target;
mod worst;

pub use against::{Exact, Reference, ReferenceError};
pub use along::{AlongRule, Lines, NoDirection, NoLine};
pub use coverage::{Coverage, NoReach};
pub use covered::Covered;
pub use document::{Inputs, document};
pub use excluded::Excluded;
pub use extremes::{Extreme, Extremes};
pub use facing::{Facing, facet_normals, vertex_normals};
pub use found::Comparisons;
pub(crate) use judgement::{incomplete, unreliable_alignment};
pub use map::{Between, MapSurface, PlaceMeans};
pub use options::{MIN_COVERAGE, Options};
pub use outliers::{NoLimits, NoRule, OutlierLimits, OutlierRule, Outliers};
pub use reference::{Compared, RegionFound, Values, WorstPlace};
pub(crate) use region::far_seed;
pub use region::{Extent, RegionError, RegionRule, Regions};
pub use reverse::{ReverseError, reverse};
pub use shown::ShownPoints;
pub use trueness_document::compare::Method;
pub use worst::WorstPoint;

use reference::{Running, Taken};
use trueness_geom::closest::{MeshError, QueryError, Tree};
use trueness_geom::cloud::PointStream;
use trueness_geom::deviation::paper::PaperError;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Aabb, Point};
use trueness_geom::stats::paired::Paired;
use trueness_geom::topology::TopologyError;

/// A block of points with their deviations, on its way to a file.
#[derive(Clone, Copy, Debug)]
pub struct DeviationBlock<'a> {
    /// The points, in file order.
    pub points: &'a [Point],
    /// For each reference, one deviation a point; not finite where the point is excluded (see [`Excluded`]).
    pub deviations: &'a [Vec<f64>],
    /// The same, but those of outliers as they were measured.
    pub measured: &'a [Vec<f64>],
}

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
pub enum CompareError<S, K> {
    /// A reference cannot be measured against.
    #[error("{reference}: {error}")]
    Reference {
        /// Its name.
        reference: String,
        /// Why.
        error: ReferenceError,
    },
    /// A point cannot be measured, or the work was stopped.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// The measured points broke off.
    #[error("{0}")]
    Stream(#[source] S),
    /// What takes the deviations refused them.
    #[error("{0}")]
    Sink(#[source] K),
    /// There are not as many normals as points.
    #[error("there are {normals} normals for {points} points")]
    Normals {
        /// Their number.
        normals: usize,
        /// That of the points.
        points: u64,
    },
    /// There is nothing to compare.
    #[error("there are no measured points")]
    NoPoints,
}

/// The tree of the mesh of a reference; whole B-spline surfaces need none.
fn tree_of<S, K>(r: &Reference, progress: &dyn Progress) -> Result<Option<Tree>, CompareError<S, K>> {
    match r.exact {
        Some(Exact::Splines(_)) => Ok(None),
        None | Some(Exact::Cad(_)) => {
            Tree::build_watched(r.mesh, progress).map(Some).map_err(|e| refused(r, e.into()))
        }
    }
}

/// Compares all points of `measured` with every reference and hands each block to `sink`.
///
/// `progress` hears of points times references. Memory: the references with their trees, one block of points, and the
/// kept deviations; with a rule for outliers all points with their deviations, as the rule's limits come
/// from all of them. The result depends on nothing but points, references and options.
///
/// # Errors
/// See [`CompareError`].
pub fn run<S: PointStream + ?Sized, K>(
    measured: &mut S,
    references: &[Reference],
    options: &Options,
    progress: &dyn Progress,
    mut sink: impl FnMut(&DeviationBlock) -> Result<(), K>,
) -> Result<Comparisons, CompareError<S::Error, K>> {
    let trees = references.iter().map(|r| tree_of(r, progress)).collect::<Result<Vec<_>, _>>()?;
    let keep = options.kept_values / references.len().max(1);
    let mut running = vec![];
    for (r, tree) in references.iter().zip(&trees) {
        running.push(Running::new(r, tree.as_ref(), options, keep, progress).map_err(|e| refused(r, e))?);
    }
    if let Some(points) = measured.expected() {
        running.iter_mut().for_each(|r| r.expects(points));
    }
    let pairs = (1..references.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
    let paired: Vec<_> = pairs.map(|(first, second)| (first, second, Paired::new())).collect();
    let placed = research::MAX_PLACED_SAMPLE;
    let places = options.shown.max(if options.research { placed } else { 0 });
    let mut out = Comparisons {
        count: 0,
        bounds: Aabb::EMPTY,
        references: vec![],
        together: ShownPoints::new(if paired.is_empty() { 0 } else { placed }, references.len()),
        paired,
        shown: ShownPoints::new(places, references.len()),
        flagged: ShownPoints::new(usize::MAX, references.len()),
    };
    let mut sample = ShownPoints::new(MAX_SIGN_SAMPLE, 0);
    let (mut points, mut start, mut waiting) = (vec![], 0, vec![]);
    loop {
        measured.next_block(&mut points).map_err(CompareError::Stream)?;
        if points.is_empty() {
            break;
        }
        let mut taken = vec![];
        for (r, reference) in running.iter_mut().zip(references) {
            let block = r.measure(start, &points, progress);
            taken.push(block.map_err(|e| in_block(e, reference, start))?);
        }
        sample.add(start, &points, &[]);
        start += points.len() as u64;
        match options.outliers {
            None => count(&mut out, &mut running, places, &points, taken, &mut sink)?,
            Some(_) => waiting.push((std::mem::take(&mut points), taken)),
        }
    }
    let needed = [options.facing.as_ref().map(Facing::count), options.along.as_ref().and_then(Lines::count)];
    let between = &options.between.points;
    let points = start + between.len() as u64;
    if let Some(normals) = needed.into_iter().flatten().find(|n| *n as u64 != points) {
        return Err(CompareError::Normals { normals, points });
    }
    if let Some(rule) = options.outliers {
        for (i, r) in running.iter_mut().enumerate() {
            r.judge(rule, waiting.iter().map(|(_, taken): &(_, Vec<Taken>)| &taken[i]));
        }
    }
    for (points, taken) in waiting {
        count(&mut out, &mut running, places, &points, taken, &mut sink)?;
    }
    if out.count == 0 {
        return Err(CompareError::NoPoints);
    }
    for (r, reference) in running.iter_mut().zip(references) {
        r.between(start, between, progress).map_err(|e| in_block(e, reference, start))?;
    }
    flag(&mut out, &running).map_err(|e| in_block(e, &references[0], 0))?;
    out.references =
        running.into_iter().map(|r| r.finish(&sample.points, progress)).collect::<Result<_, _>>()?;
    Ok(out)
}

/// Counts a block that has been measured against every reference, and hands it on.
fn count<S, K>(
    out: &mut Comparisons,
    running: &mut [Running],
    places: usize,
    points: &[Point],
    taken: Vec<Taken>,
    sink: &mut impl FnMut(&DeviationBlock) -> Result<(), K>,
) -> Result<(), CompareError<S, K>> {
    let mut taken = taken;
    let all = running.iter_mut().zip(&mut taken);
    let judged: Vec<Option<Vec<f64>>> = all.map(|(r, taken)| r.count(out.count, points, taken)).collect();
    let deviations: Vec<Vec<f64>> = taken.into_iter().map(|t| t.deviations).collect();
    let measured = judged.iter().any(Option::is_some).then(|| {
        let own = judged.into_iter().zip(&deviations);
        own.map(|(judged, d)| judged.unwrap_or_else(|| d.clone())).collect::<Vec<_>>()
    });
    for (first, second, p) in &mut out.paired {
        p.push(&deviations[*first], &deviations[*second]);
    }
    let lists: Vec<&[f64]> = deviations.iter().map(Vec::as_slice).collect();
    if places > 0 {
        out.shown.add(out.count, points, &lists);
    }
    if !out.paired.is_empty() {
        out.together.add(out.count, points, &lists);
    }
    let block = DeviationBlock {
        points,
        deviations: &deviations,
        measured: measured.as_ref().unwrap_or(&deviations),
    };
    sink(&block).map_err(CompareError::Sink)?;
    out.bounds = out.bounds.union(&Aabb::of(points));
    out.count += points.len() as u64;
    Ok(())
}

/// Puts the worst places that the sample has left out beside it.
fn flag(out: &mut Comparisons, running: &[Running]) -> Result<(), PaperError> {
    let mut places: Vec<WorstPoint> = running.iter().flat_map(Running::worst_places).collect();
    places.retain(|p| out.shown.indices.binary_search(&p.index).is_err());
    places.sort_by_key(|p| p.index);
    places.dedup_by_key(|p| p.index);
    let deviations: Vec<Vec<f64>> = running.iter().map(|r| r.again(&places)).collect::<Result<_, _>>()?;
    for (i, place) in places.iter().enumerate() {
        let here: Vec<&[f64]> = deviations.iter().map(|d| &d[i..=i]).collect();
        out.flagged.add(place.index, &[place.point], &here);
    }
    Ok(())
}

fn refused<S, K>(reference: &Reference, error: ReferenceError) -> CompareError<S, K> {
    match error {
        ReferenceError::Mesh(MeshError::Cancelled(e))
        | ReferenceError::Topology(TopologyError::Cancelled(e))
        | ReferenceError::Region(RegionError::Cancelled(e)) => CompareError::Query(e.into()),
        error => CompareError::Reference { reference: reference.name.clone(), error },
    }
}

/// Points, at most, on which both sign methods are asked.
const MAX_SIGN_SAMPLE: usize = 4096;

/// What broke off a block whose first point has number `start`; the number of a bad point counts from the stream's start.
fn in_block<S, K>(error: PaperError, reference: &Reference, start: u64) -> CompareError<S, K> {
    match error {
        PaperError::Query(QueryError::BadPoint(i)) => {
            CompareError::Query(QueryError::BadPoint(start as usize + i))
        }
        PaperError::Query(e) => CompareError::Query(e),
        other => refused(reference, other.into()),
    }
}

#[cfg(test)]
mod tests;
