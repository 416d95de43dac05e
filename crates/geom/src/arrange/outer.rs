//! The boundary of the material, and its vertices as numbers a file can hold.

use super::cells::{Open, windings};
use super::cutting::{Cutting, cutting};
use super::points::Points;
use super::snap::snap;
use super::{ArrangeError, not_too_many, pairs};
use crate::check::around::Around;
use crate::check::intersect;
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::space::{Aabb, Point};
use crate::topology::Topology;
use crate::topology::weld::{as_it_is, compact, rejoined};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// How the boundary is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// New vertices are rounded to single precision, for files that hold no more.
    pub single: bool,
    /// Shells that meet or contain each other, and wind around nothing in the positive sense, are turned over together.
    pub turn: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options { single: false, turn: true }
    }
}

/// The boundary of the material that closed shells enclose.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// The vertices of the mesh first, all of them; then those at the ends of cuts. Where vertices are at the same place or
    /// unused, the mesh is welded first.
    pub mesh: Mesh,
    /// For each face the facet that it is, or is a piece of. Facets that nothing cuts come first, in their order.
    pub source: Vec<u32>,
    /// How often the mesh was cut: 1, and once more for each time that rounding made facets cross.
    pub cuts: usize,
}

/// How often a mesh is cut at most.
const CUTS: usize = 16;
/// It is given up where more pairs meet than this many times the fewest before, and [`FEW`]: cutting again makes it worse.
const MORE: usize = 2;
/// Pairs that few crossings may grow by.
const FEW: usize = 1000;
/// Points that lie too close become one from the second cut on: those closer than this power of two of the spacing of numbers,
/// with one more for each cut up to the highest.
const HIGHEST: usize = 11;

/// The boundary of the places around which the facets wind once or more: the union of all shells.
///
/// Facets look outwards, away from the material. A shell inside another that runs the same way round is material inside
/// material and vanishes; one that runs the other way round bounds a cavity and stays. Where shells cross, or one crosses
/// itself, what lies inside the material vanishes; enclosed pockets become cavities; places with a negative winding number
/// are empty. With [`Options::turn`], shells that belong together and wind around nothing in the positive sense are turned first.
/// Facets that coincide cancel or become one. Bodies that touch in a face become one; touching in an edge or a vertex
/// they share it, as a non-manifold edge or vertex.
///
/// The surface must be closed: at every edge as many facets run the one way as the other, at least once T-junctions are
/// cut. No vertex moves, and facets that nothing cuts stay as they are. The result is free of crossings, flat and doubled
/// facets in `f64`, or in single precision with [`Options::single`], where the vertices of the mesh must have it too: that is
/// checked exactly. Cost: as [`arrange`](super::arrange), and about a microsecond a facet for the cells.
///
/// ```
/// use trueness_geom::arrange::{Options, outer_boundary};
/// use trueness_geom::{mesh::Mesh, progress::Silent, topology::{Properties, Topology}};
/// // Two tetrahedra of volume 1/6, one inside the other.
/// let positions = vec![
///     [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0],
///     [0.1, 0.1, 0.1], [0.2, 0.1, 0.1], [0.1, 0.2, 0.1], [0.1, 0.1, 0.2],
/// ];
/// let one = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
/// let faces = one.iter().copied().chain(one.map(|f| f.map(|v| v + 4))).collect();
/// let mesh = Mesh { positions, faces };
/// let union = outer_boundary(&mesh, &Options::default(), &Silent).unwrap();
/// assert_eq!(union.source, [0, 1, 2, 3]);
/// ```
///
/// # Errors
/// [`ArrangeError`].
pub fn outer_boundary(
    mesh: &Mesh,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Boundary, ArrangeError> {
    boundary_of(Given { mesh: as_it_is(mesh)?, topology: None, pairs: None }, options, progress)
}

/// A welded mesh whose vertices facets use, and what is known about it.
pub(crate) struct Given<'a> {
    pub mesh: Mesh,
    /// What it says of facets is asked for alone: vertices may have other numbers in it.
    pub topology: Option<&'a Topology>,
    /// All pairs of facets that meet where they should not, sorted.
    pub pairs: Option<Vec<[u32; 2]>>,
}

/// As [`outer_boundary`].
pub(crate) fn boundary_of(
    Given { mesh: mut current, topology: mut known, pairs: mut known_pairs }: Given,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Boundary, ArrangeError> {
    let vertices = current.positions.len();
    let step = step(&current, options.single);
    let given = current.faces.clone();
    let mut source: Vec<u32> = (0..current.faces.len() as u32).collect();
    let mut most = usize::MAX;
    for cut in 0..CUTS {
        let is_new = |(f, source): (&[u32; 3], &u32)| {
            cut == 0 || f.iter().any(|v| !given[*source as usize].contains(v))
        };
        let some: Vec<bool> = current.faces.iter().zip(&source).map(is_new).collect();
        if cut > 0 && is_clean(&current, &some, progress)? {
            return Ok(Boundary { mesh: compact(current, vertices), source, cuts: cut });
        }
        let own: Topology;
        let topology = match known.take() {
            Some(known) => known,
            None => {
                own = Topology::of(&current)?;
                &own
            }
        };
        let pairs = match known_pairs.take() {
            Some(known) => not_too_many(known, &current)?,
            None => pairs(&current, topology, &some, progress)?,
        };
        let fine = topology.collinear.is_empty() && topology.duplicate_facets.is_empty();
        if cut > 0 && pairs.is_empty() && fine {
            return Ok(Boundary { mesh: compact(current, vertices), source, cuts: cut });
        }
        if pairs.len() > most {
            break;
        }
        most = most.min(MORE * pairs.len() + FEW);
        let turn = options.turn && cut == 0;
        let kept = kept(&current, topology, &pairs, turn, progress)?;
        // Corners of what crosses that are no vertices of the mesh given.
        let close = (cut > 0).then(|| {
            let found = pairs.iter().flatten().chain(&topology.collinear);
            let corners = found.flat_map(|f| current.faces[*f as usize]);
            let movable: BTreeSet<u32> = corners.filter(|v| *v as usize >= vertices).collect();
            (movable, step * f64::from(1u32 << cut.min(HIGHEST)))
        });
        let (next, faces_of) = rounded(&current, kept, options.single, close)?;
        source = faces_of.into_iter().map(|f| source[f as usize]).collect();
        current = next;
    }
    let topology = Topology::of(&current)?;
    let pairs = pairs(&current, &topology, &vec![true; current.faces.len()], progress)?;
    let place = |f: &u32| current.positions[current.faces[*f as usize][0] as usize];
    let first = pairs.iter().flatten().chain(&topology.collinear).next();
    Err(ArrangeError::Unresolved { position: first.map_or([0.0; 3], place) })
}

/// Whether it is plain at first sight that nothing new crosses, coincides or is flat: only what lies near the new facets is looked at.
fn is_clean(mesh: &Mesh, new: &[bool], progress: &dyn Progress) -> Result<bool, ArrangeError> {
    let Some(Around { mesh, asked, .. }) = Around::new(mesh, new) else { return Ok(false) };
    let topology = Topology::of(&mesh)?;
    let fine = topology.collinear.is_empty() && topology.duplicate_facets.is_empty();
    Ok(fine && intersect::few_self_intersections(&mesh, &topology, &asked, 0, progress)?.is_some())
}

/// The pieces of a mesh that lie between material and none.
struct Kept<'a> {
    points: Points<'a>,
    faces: Vec<[u32; 3]>,
    source: Vec<u32>,
}

fn kept<'a>(
    mesh: &'a Mesh,
    topology: &Topology,
    pairs: &[[u32; 2]],
    turn: bool,
    progress: &dyn Progress,
) -> Result<Kept<'a>, ArrangeError> {
    let Cutting { points, mut pieces, .. } = cutting(mesh, topology, pairs, progress)?;
    pieces.retain(|p| p.jump != 0);
    let shell_of = shell_of(topology);
    let windings = windings(mesh, &points, &pieces, &shell_of, turn)
        .map_err(|Open(piece)| ArrangeError::Open { position: points.rough(pieces[piece].corners[0]) })?;
    let (mut faces, mut source) = (vec![], vec![]);
    for (piece, [front, back]) in pieces.iter().zip(windings.sides) {
        let [a, b, c] = piece.corners;
        match (front > 0, back > 0) {
            (false, true) => faces.push([a, b, c]),
            (true, false) => faces.push([a, c, b]),
            _ => continue,
        }
        source.push(piece.facet);
    }
    Ok(Kept { points, faces, source })
}

/// The shell of each facet, none for those without area: they bound nothing.
fn shell_of(topology: &Topology) -> Vec<u32> {
    let mut shell_of = topology.shell_of.clone();
    topology.collinear.iter().for_each(|f| shell_of[*f as usize] = u32::MAX);
    shell_of
}

/// The spacing of numbers at the largest coordinate.
fn step(mesh: &Mesh, single: bool) -> f64 {
    let Aabb { min, max } = mesh.finite_bounds();
    let largest = min.iter().chain(&max).fold(0.0f64, |m, x| m.max(x.abs())).min(f64::MAX);
    let digits = if single { 29 } else { 0 };
    (largest.next_up() - largest) * f64::from(1u32 << digits)
}

/// The faces as a mesh, new points rounded, and for each the facet it comes from. With `close`, new points and those given
/// are put upon others that are no farther than the distance given. Faces that lose a corner by it are left out.
fn rounded(
    mesh: &Mesh,
    kept: Kept,
    single: bool,
    close: Option<(BTreeSet<u32>, f64)>,
) -> Result<(Mesh, Vec<u32>), ArrangeError> {
    let round = |x: f64| (if single { f64::from(x as f32) } else { x }) + 0.0;
    let (old, count) = (mesh.positions.len(), kept.points.len());
    let mut positions = mesh.positions.clone();
    let new = (old..count).into_par_iter().map(|p| kept.points.at(p as u32).nearest().map(round));
    positions.extend(new.collect::<Vec<Point>>());
    let as_they_are = count == old && close.is_none();
    if let Some((movable, reach)) = close {
        let movable: Vec<u32> = movable.into_iter().chain(old as u32..count as u32).collect();
        snap(&mut positions, &kept.faces, &movable, reach);
    }
    let mut out = Mesh { positions, faces: kept.faces };
    let mut source = kept.source;
    if !as_they_are {
        out = rejoined(out)?;
        let is_whole = |f: &[u32; 3]| f[0] != f[1] && f[1] != f[2] && f[2] != f[0];
        let all = out.faces.into_iter().zip(source).filter(|(f, _)| is_whole(f));
        (out.faces, source) = all.unzip();
    }
    Ok((out, source))
}
