//! The boundary of the material, and its vertices as numbers a file can hold.

use super::cells::{Open, windings};
use super::cutting::{Cutting, cutting};
use super::error::ArrangeError;
use super::imprint::imprints;
use super::near_coincident::{Closeness, near_coincident, step};
use super::pairs::{in_range, not_too_many, pairs};
use super::points::Points;
use super::retile::retiled;
use super::snap::{snap, used};
use crate::neighborhood::Neighborhood;
use std::collections::BTreeSet;
use trueness_geom::check::intersect;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::space::Point;
use trueness_geom::topology::Topology;
use trueness_geom::topology::weld::{as_it_is, compact, rejoined};

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
    /// The vertices of the mesh first, all of them, some perhaps unused; then those at the ends of cuts. Where vertices are at the same place or
    /// unused, the mesh is welded first.
    pub mesh: Mesh,
    /// For each face the facet that it is, or is a piece of. Facets that nothing cuts come first, in their order.
    pub source: Vec<u32>,
    /// How often the mesh was cut in the end: 1, and once more for each time that rounding made facets cross.
    pub cuts: usize,
}

/// How often a mesh is cut at most.
const MAX_CUTS: usize = 16;
/// Points that lie too close become one from the second cut on. They are closer than this power of two of the spacing
/// of numbers, with one more for each cut up to the highest.
const MAX_MERGING_POWER: usize = 11;
/// So many pairs of facets may meet once more; beyond, their number must halve from cut to cut.
const MIN_PAIRS_TO_HALVE: usize = 16;
/// Surfaces no farther apart than so many times the spacing of numbers are made one where they lie upon each other.
/// They are, too, where cutting comes to no end otherwise. The first is for corners that were turned and rounded, the
/// second for planes that such corners span, the third for sums of several roundings.
const REACHES_IN_STEPS: [f64; 3] = [4.0, 64.0, 1024.0];

/// The boundary of the places around which the facets wind once or more: the union of all shells.
///
/// Facets look outwards, away from the material. A shell inside another that runs the same way round is material inside
/// material and vanishes. One that runs the other way round bounds a cavity and stays. Where shells cross, or one
/// crosses itself, facets inside the material vanish. Enclosed pockets become cavities; places with a negative winding
/// number are empty. With [`Options::turn`], shells that belong together and wind around nothing in the positive sense
/// are turned first. Facets that coincide cancel or become one. Bodies that touch in a face become one; touching in an
/// edge or a vertex they share it, as a non-manifold edge or vertex.
///
/// The surface must be closed: at every edge as many facets run the one way as the other, at least once T-junctions are
/// cut. Coordinates are 0 or from 1e-50 to 1e45 mm. No vertex moves, and facets that nothing cuts stay as they are.
/// Surfaces that lie upon each other but for rounding are taken to coincide. At most 64 times the spacing of numbers at
/// the largest coordinate is between them. It is 4 times that of single precision where the vertices have it and the
/// result need not. Where cutting comes to no end it is up to 1024 times. The result is free of crossings, flat and
/// doubled facets in `f64`. With [`Options::single`] it is so in single precision, where the vertices of the mesh must
/// have it too. That is checked exactly. Cost: as [`arrange`](super::arrange), and about a microsecond a facet for the
/// cells.
///
/// ```
/// use trueness_solid::arrange::{Options, outer_boundary};
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
    boundary_of(Input { mesh: as_it_is(mesh)?, topology: None, pairs: None }, options, progress)
}

/// A welded mesh whose vertices facets use, and the facts known about it.
pub(crate) struct Input<'a> {
    pub mesh: Mesh,
    /// Only its facts about facets are asked for: vertices may have other numbers in it.
    pub topology: Option<&'a Topology>,
    /// All pairs of facets that meet where they should not, sorted.
    pub pairs: Option<Vec<[u32; 2]>>,
}

/// As [`outer_boundary`].
pub(crate) fn boundary_of(
    Input { mesh: input, topology, pairs: known }: Input,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Boundary, ArrangeError> {
    let close = Closeness::of(&input, options.single);
    let round = |x: f64| rounded_to(x, options.single);
    let own: Topology;
    let topology = match topology {
        Some(topology) => topology,
        None => {
            own = Topology::of(&input)?;
            &own
        }
    };
    in_range(&input, topology)?;
    let crossing = match known {
        Some(known) => not_too_many(known, &input)?,
        None => pairs(&input, topology, &vec![true; input.faces.len()], progress)?,
    };
    let (near, widest) = near_coincident(&input, topology, &crossing, close)?;
    let mut result = Err(ArrangeError::Unresolved { position: [0.0; 3] });
    for reach in reaches(widest, close.step) {
        if let Some(reach) = reach {
            let imprints = imprints(&input, &near, reach, &round, progress)?;
            let retiled =
                imprints.and_then(|(mesh, source, imprints)| retiled(mesh, &source, &imprints, reach));
            if let Some((mesh, source)) = retiled {
                let topology = Topology::of(&mesh)?;
                let crossing = pairs(&mesh, &topology, &vec![true; mesh.faces.len()], progress)?;
                result =
                    settled(&input, Uncut { mesh, source, topology: &topology, crossing }, options, progress);
            }
        } else {
            let (mesh, source) = (input.clone(), (0..input.faces.len() as u32).collect());
            let uncut = Uncut { mesh, source, topology, crossing: crossing.clone() };
            result = settled(&input, uncut, options, progress);
        }
        if !matches!(result, Err(ArrangeError::Unresolved { .. })) {
            break;
        }
    }
    result
}

/// The reaches tried, one after another: the mesh as it is, or with places no farther apart than a reach made one.
/// Facets may lie upon each other but for rounding, so far apart at most. The reach that bridges this comes first: cut
/// as they are, they may leave walls with nothing between.
fn reaches(widest: f64, step: f64) -> Vec<Option<f64>> {
    let mut all: Vec<Option<f64>> =
        std::iter::once(None).chain(REACHES_IN_STEPS.map(|r| Some(r * step))).collect();
    if widest > 0.0
        && let Some(fits) = all.iter().position(|r| r.is_some_and(|r| widest <= r))
    {
        all[..=fits].rotate_right(1);
    }
    all
}

/// A mesh to be cut, and the facts known about it.
struct Uncut<'a> {
    mesh: Mesh,
    /// For each face the facet of the mesh given that it is a piece of.
    source: Vec<u32>,
    /// The topology of its facets; vertices may have other numbers in it.
    topology: &'a Topology,
    /// Its facets that meet where they should not.
    crossing: Vec<[u32; 2]>,
}

/// Cuts a mesh until the rest does not cross.
fn settled(
    input: &Mesh,
    Uncut { mesh: mut current, mut source, topology, crossing }: Uncut,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Boundary, ArrangeError> {
    let mut known = Some((topology, crossing));
    let vertices = input.positions.len();
    let step = step(input, options.single);
    let mut most = usize::MAX;
    for cut in 0..MAX_CUTS {
        let is_new = |(f, source): (&[u32; 3], &u32)| {
            cut == 0 || f.iter().any(|v| !input.faces[*source as usize].contains(v))
        };
        let is_new_facet: Vec<bool> = current.faces.iter().zip(&source).map(is_new).collect();
        if cut > 0 && is_clean(&current, &is_new_facet, progress)? {
            return Ok(Boundary { mesh: compact(current, vertices), source, cuts: cut });
        }
        let own: Topology;
        let (topology, pairs) = match known.take() {
            Some(known) => known,
            None => {
                own = Topology::of(&current)?;
                (&own, pairs(&current, &own, &is_new_facet, progress)?)
            }
        };
        let fine = topology.collinear.is_empty() && topology.duplicate_facets.is_empty();
        if cut > 0 && pairs.is_empty() && fine {
            return Ok(Boundary { mesh: compact(current, vertices), source, cuts: cut });
        }
        if pairs.len() > most {
            break;
        }
        most = (pairs.len() / 2).max(MIN_PAIRS_TO_HALVE);
        let turn = options.turn && cut == 0;
        let kept = kept(&current, topology, &pairs, turn, progress)?;
        // Corners of crossing facets that are no vertices of the mesh given.
        let close = (cut > 0).then(|| {
            let found = pairs.iter().flatten().chain(&topology.collinear);
            let corners = found.flat_map(|f| current.faces[*f as usize]);
            let movable: BTreeSet<u32> = corners.filter(|v| *v as usize >= vertices).collect();
            (movable, step * f64::from(1u32 << cut.min(MAX_MERGING_POWER)))
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

/// Whether it is plain at first sight that nothing new crosses, coincides or is flat. Only the neighborhood of the new
/// facets is looked at.
fn is_clean(mesh: &Mesh, new: &[bool], progress: &dyn Progress) -> Result<bool, ArrangeError> {
    let Some(Neighborhood { mesh, is_chosen, .. }) = Neighborhood::new(mesh, new) else { return Ok(false) };
    let topology = Topology::of(&mesh)?;
    let fine = topology.collinear.is_empty() && topology.duplicate_facets.is_empty();
    Ok(fine && intersect::selected_self_intersections(&mesh, &topology, &is_chosen, 0, progress)?.is_some())
}

/// The pieces of a mesh that lie between material and none.
struct KeptPieces<'a> {
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
) -> Result<KeptPieces<'a>, ArrangeError> {
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
    Ok(KeptPieces { points, faces, source })
}

/// The shell of each facet, none for those without area: they bound nothing.
fn shell_of(topology: &Topology) -> Vec<u32> {
    let mut shell_of = topology.shell_of.clone();
    topology.collinear.iter().for_each(|f| shell_of[*f as usize] = u32::MAX);
    shell_of
}

/// To the numbers of the file.
fn rounded_to(x: f64, single: bool) -> f64 {
    (if single { f64::from(x as f32) } else { x }) + 0.0
}

/// The faces as a mesh, new points rounded, and for each the facet it comes from. With `close`, new points and those given
/// are put upon others that are no farther than the distance given. Faces that lose a corner by it are left out.
fn rounded(
    mesh: &Mesh,
    mut kept: KeptPieces,
    single: bool,
    close: Option<(BTreeSet<u32>, f64)>,
) -> Result<(Mesh, Vec<u32>), ArrangeError> {
    let round = |x: f64| rounded_to(x, single);
    let (old, count) = (mesh.positions.len(), kept.points.len());
    let mut positions = mesh.positions.clone();
    let new = (old..count).into_par_iter().map(|p| kept.points.at(p as u32).nearest().map(round));
    positions.extend(new.collect::<Vec<Point>>());
    let as_they_are = count == old && close.is_none();
    if let Some((movable, reach)) = close {
        let movable: Vec<u32> = movable.into_iter().chain(old as u32..count as u32).collect();
        let to = snap(&positions, &used(positions.len(), &kept.faces), &movable, reach);
        kept.faces.iter_mut().flatten().for_each(|v| *v = to.get(v).copied().unwrap_or(*v));
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
