//! Planes, cylinders, cones, spheres and tori in a mesh or cloud, found without a nominal.
//!
//! [`mesh`] and [`cloud`] are the entrances. A surface is cut into pieces: facets, or points with normals. Patches of pieces
//! around random seeds show an element each, which grows over its neighbors and is fitted again in turns. Neighboring regions
//! that one element explains as well are joined. In the end each region's element is fitted by least squares. The noise of the
//! data sets how far a piece may lie off.
//!
//! | file | what |
//! |---|---|
//! | `pieces` | pieces and neighbors; `facets` of a mesh, `points` of a cloud |
//! | `probe` | an element ready for many questions |
//! | `noise` | how far and how much turned a piece of a face may be |
//! | `estimate` | an element from places and normals |
//! | `flood`, `grow` | from a patch to a region |
//! | `chords` | planes that are only chords of a curved face |
//! | `criterion` | which of two elements explains a region better |
//! | `seeds`, `search` | where to try, and who comes first |
//! | `merge`, `borders` | regions of one face joined; pieces along borders given to the nearer region |

mod borders;
mod chords;
mod criterion;
mod estimate;
mod facets;
mod flood;
mod grow;
mod merge;
mod noise;
mod pieces;
mod points;
mod probe;
mod region;
mod search;
mod seeds;
#[cfg(test)]
mod tests;

use crate::fit::{self, Fit};
use crate::mesh::Mesh;
use crate::noise::NoNoise;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress, Silent};
use crate::scan::Scan;
use crate::shape::{Kind, Shape};
use crate::space::{Aabb, Point, dot, single_step};
use crate::topology::weld::WeldError;
use criterion::fewest_points;
pub use estimate::KINDS;
use grow::Context;
use noise::Noise;
use pieces::{Band, NO_PIECE, PieceGraph, Pieces};
use region::GrownRegion;
use search::{Limits, search};
use seeds::Seeds;
use std::collections::BTreeSet;

/// The options of a segmentation.
#[derive(Clone, Debug)]
pub struct Options {
    /// Elements looked for; those of [`KINDS`] count.
    pub kinds: Vec<Kind>,
    /// Distance up to which a point belongs to an element, millimeters. Without it: eight standard deviations of the
    /// noise found in the data.
    pub tolerance: Option<f64>,
    /// Angle between neighboring pieces from which on there is an edge between them, radians.
    pub crease: f64,
    /// Least share of the area, or of the points of a cloud, that a region must have. Without it 0.002 of what is measured, and
    /// 0.0001 of what is drawn, where small faces are as certain as large ones.
    pub min_share: Option<f64>,
    /// Fewest measured points of a region.
    pub min_points: usize,
    /// Seed of the random choices.
    pub seed: u64,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            kinds: KINDS.to_vec(),
            tolerance: None,
            crease: 32f64.to_radians(),
            min_share: None,
            min_points: 0,
            seed: 0,
        }
    }
}

/// One element and what belongs to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The least-squares element of the points named in `points`, its residuals (indices there count within that list)
    /// and its covariance.
    pub fit: Fit,
    /// The measured points that it was fitted to, ascending: those inside the region, or all of it where there are too
    /// few inside.
    pub points: Vec<u32>,
    /// Number of facets, or of points of a cloud.
    pub pieces: usize,
    /// Area of those facets, mm²; 0 of a cloud.
    pub area: f64,
    /// Share of the area, or of the points of a cloud.
    pub share: f64,
    /// Box around the region.
    pub bounds: Aabb,
    /// Greatest magnitude of the distances of all measured points of its pieces, millimeters: within the tolerance.
    pub farthest: f64,
}

/// The result of a segmentation.
#[derive(Clone, Debug, PartialEq)]
pub struct Segmentation {
    /// The regions, largest first.
    pub regions: Vec<Region>,
    /// For each facet, or each point of a cloud, the number of its region; [`u32::MAX`] where it has none.
    pub labels: Vec<u32>,
    /// Standard deviation of the noise found in the data, millimeters.
    pub noise: f64,
    /// Distance up to which points belong to an element, millimeters: no measured point of a region's pieces lies farther
    /// off its element.
    pub tolerance: f64,
    /// Least share of the regions.
    pub min_share: f64,
    /// Whether the half of the surface and more shows that it was drawn, not measured.
    pub is_drawn: bool,
}

impl Segmentation {
    /// The noise of the points about their elements, and how far neighbors share it. The covariances of [`Region::fit`] have to
    /// be multiplied with [`points_per_independent`](crate::noise::Noise). `of` is what was segmented.
    ///
    /// # Errors
    /// [`NoNoise`]: drawn, too few points that hang together, cancelled.
    pub fn shared_noise(
        &self,
        of: &Scan,
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<crate::noise::Noise, NoNoise> {
        if self.is_drawn {
            return Err(NoNoise::Drawn);
        }
        let points = of.points();
        let mut distances = vec![f64::NAN; points.len()];
        for region in &self.regions {
            for &point in &region.points {
                distances[point as usize] = region.fit.shape.distance(points[point as usize]);
            }
        }
        crate::noise::about(of, &distances, seed, progress)
    }
}

/// Whether a mesh was drawn, not measured; its facets name vertices that exist and are finite. Half of its area and more
/// belongs to facets with a neighbor in their plane, or with two that mirror them and turn as far. The rounding of single
/// precision is allowed for. A cloud is not. Cost: some passes over the facets.
/// ```
/// use trueness_geom::{mesh::Mesh, segment::is_drawn};
/// let square = |lift: f64| Mesh {
///     positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, lift], [0.0, 1.0, 0.0]],
///     faces: vec![[0, 1, 2], [0, 2, 3]],
/// };
/// assert!(is_drawn(&square(0.0)) && !is_drawn(&square(0.01)));
/// ```
pub fn is_drawn(mesh: &Mesh) -> bool {
    !mesh.faces.is_empty() && facets::surface(mesh).is_drawn
}

/// Why nothing could be looked for.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SegmentError {
    /// No facets or points.
    #[error("there is nothing to segment: no {0}")]
    Empty(&'static str),
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is not a finite number; remove it")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// No piece has a normal: all facets are without area, or all points lie on one line.
    #[error("it holds no surface: everything lies on one line or point")]
    NoSurface,
    /// An option is out of its range.
    #[error("{name} {value}: it must be {range}")]
    WrongOption {
        /// Which one.
        name: &'static str,
        /// The value that was passed.
        value: f64,
        /// The range that it may have.
        range: &'static str,
    },
    /// None of the kinds asked for can be found.
    #[error("no shape to look for; choose from plane, cylinder, cone, sphere, torus")]
    NoKind,
    /// The mesh names a vertex that does not exist, or is too large.
    #[error(transparent)]
    Mesh(#[from] WeldError),
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The elements of a mesh. Facets are neighbors through the vertices they share: weld first what is not welded.
///
/// Labels are those of facets. Facets without area belong to nothing. Deterministic for any number of threads. Memory grows
/// with the number of facets (about 250 bytes each), time with it and with the number of faces. `progress` counts facets that
/// found their region.
///
/// # Errors
/// [`SegmentError`]: no facets, a coordinate that is no number, options out of range.
pub fn mesh(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Segmentation, SegmentError> {
    check(&mesh.positions, options)?;
    if mesh.faces.is_empty() {
        return Err(SegmentError::Empty("facets"));
    }
    let vertices = mesh.positions.len();
    for (facet, face) in mesh.faces.iter().enumerate() {
        if let Some(&vertex) = face.iter().find(|&&v| v as usize >= vertices) {
            return Err(WeldError::NoSuchVertex { facet, vertex, vertices }.into());
        }
    }
    segment(facets::surface(mesh), options, progress)
}

/// The elements of a cloud. Normals come from the nearest neighbors, so edges are known no sharper than the points lie
/// apart.
///
/// Labels are those of points. As [`mesh`] otherwise; about 600 bytes a point.
///
/// # Errors
/// As [`mesh`].
pub fn cloud(
    points: &[Point],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Segmentation, SegmentError> {
    check(points, options)?;
    segment(points::surface(points), options, progress)
}

fn check(points: &[Point], options: &Options) -> Result<(), SegmentError> {
    if points.is_empty() {
        return Err(SegmentError::Empty("points"));
    }
    if let Some(index) = points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        return Err(SegmentError::NotFinite { index });
    }
    let within = |name, value: f64, range, fine: bool| match fine {
        true => Ok(()),
        false => Err(SegmentError::WrongOption { name, value, range }),
    };
    if let Some(t) = options.tolerance {
        within("tolerance", t, "a length above 0", t.is_finite() && t > 0.0)?;
    }
    // Without the last digits, which radians have lost.
    let degrees = (1e9 * options.crease.to_degrees()).round() / 1e9;
    within("crease", degrees, "between 1 and 89 degrees", (1.0..=89.0).contains(&degrees))?;
    if let Some(share) = options.min_share {
        let percent = 100.0 * share;
        within("min-share", percent, "between 0 and 100 percent", (0.0..=100.0).contains(&percent))?;
    }
    if !KINDS.iter().any(|kind| options.kinds.contains(kind)) {
        return Err(SegmentError::NoKind);
    }
    Ok(())
}

/// Standard deviations of the noise within which points belong to an element: form error comes on top of noise.
const BAND_SIGMAS: f64 = 8.0;
/// Least share of a region: of a measured surface, and of a drawn one.
const MIN_REGION_SHARES: [f64; 2] = [0.002, 1e-4];
/// Angle between a piece and its element that is always allowed, and the one that is never exceeded, degrees.
const PIECE_ANGLE_LIMITS: [f64; 2] = [12.0, 45.0];

fn segment(
    surface: PieceGraph,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Segmentation, SegmentError> {
    let all = Seeds::new(&surface, |_| true);
    if all.is_empty() {
        return Err(SegmentError::NoSurface);
    }
    let crease = libm::cos(options.crease);
    let Noise { distance, angle } = noise::noise(&surface, crease, options.seed, |random| all.draw(random));
    let kinds: Vec<Kind> = KINDS.into_iter().filter(|kind| options.kinds.contains(kind)).collect();
    let bounds = Aabb::of(surface.points);
    // Coordinates have passed through single precision: they are off by half a step of it.
    let step = single_step(surface.points);
    let noise = distance.max(step / 12f64.sqrt());
    let tolerance = options.tolerance.unwrap_or((BAND_SIGMAS * noise).max(2.0 * step));
    let turned = (3.0 * angle).clamp(PIECE_ANGLE_LIMITS[0].to_radians(), PIECE_ANGLE_LIMITS[1].to_radians());
    let context = Context {
        surface: &surface,
        kinds: &kinds,
        band: Band { distance: tolerance, cosine: libm::cos(turned) },
        noise,
        crease,
        size: bounds.diagonal(),
    };
    let total = surface.weights.iter().sum::<f64>();
    let min_share = options.min_share.unwrap_or(MIN_REGION_SHARES[usize::from(surface.is_drawn)]);
    let limits = Limits { weight: min_share * total, points: options.min_points, seed: options.seed };
    let (mut regions, mut labels) = search(&context, &limits, progress)?;
    merge::merge(&context, &mut regions, &mut labels);
    regions.par_iter_mut().for_each(|region| context.reconsidered(region));
    borders::move_borders(&context, &regions, &mut labels);
    let (regions, labels) = finished(&context, regions, &labels, total, &limits);
    Ok(Segmentation { regions, labels, noise, tolerance, min_share, is_drawn: surface.is_drawn })
}

/// The regions as users get them, largest first, and their labels.
fn finished(
    context: &Context,
    grown: Vec<GrownRegion>,
    labels: &[u32],
    total: f64,
    limits: &Limits,
) -> (Vec<Region>, Vec<u32>) {
    let surface = context.surface;
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); grown.len()];
    for (piece, &label) in labels.iter().enumerate().filter(|(_, l)| **l != NO_PIECE) {
        members[label as usize].push(piece as u32);
    }
    let depths = depths(context, labels);
    let enough = |pieces: &[u32]| !pieces.is_empty() && surface.weight(pieces) >= limits.weight;
    let mut named: Vec<(usize, Region, Vec<u32>)> = (grown.iter().zip(members).enumerate())
        .filter(|(_, (_, pieces))| enough(pieces))
        .filter_map(|(label, (grown, pieces))| {
            let (region, pieces) = region(context, grown, pieces, &depths, total)?;
            enough(&pieces).then_some((label, region, pieces))
        })
        .collect();
    named.sort_by(|a, b| b.1.share.total_cmp(&a.1.share).then(a.0.cmp(&b.0)));
    let mut new_labels = vec![NO_PIECE; labels.len()];
    for (new, (_, _, pieces)) in (0u32..).zip(&named) {
        pieces.iter().for_each(|&piece| new_labels[piece as usize] = new);
    }
    (named.into_iter().map(|n| n.1).collect(), new_labels)
}

/// Fits of a region until every piece of it lies within the tolerance; each takes pieces away.
const MAX_REGION_FITS: usize = 20;

/// The region with its element, and those of its pieces whose measured points all lie within the tolerance of it. While it
/// grew, elements came from some of its points, and one corner of a facet might lie beyond an edge. `None` where no element
/// keeps any.
fn region(
    context: &Context,
    grown: &GrownRegion,
    mut pieces: Vec<u32>,
    depths: &[u8],
    total: f64,
) -> Option<(Region, Vec<u32>)> {
    let surface = context.surface;
    let (mut shape, mut excluded) = (grown.shape, BTreeSet::new());
    for _ in 0..MAX_REGION_FITS {
        let inside = |p: &u32| if excluded.contains(p) { 0 } else { depths[*p as usize] };
        let (fit, points) = fitted(surface, &shape, &pieces, inside)?;
        let farthest = |piece: u32| {
            let (corners, count) = surface.corners(piece);
            let distance = |&c: &u32| fit.shape.distance(surface.points[c as usize]).abs();
            corners[..count].iter().map(distance).fold(0.0, f64::max)
        };
        let (near, far): (Vec<u32>, Vec<u32>) =
            pieces.iter().partition(|&&piece| farthest(piece) <= context.band.distance);
        shape = fit.shape;
        if !far.is_empty() {
            // Points of what lies off are at an edge.
            excluded.extend(surface.points_of(far));
            pieces = near;
            continue;
        }
        let weight = surface.weight(&pieces);
        let region = Region {
            farthest: pieces.iter().map(|&piece| farthest(piece)).fold(0.0, f64::max),
            fit,
            points,
            pieces: pieces.len(),
            area: if surface.is_mesh() { weight } else { 0.0 },
            share: weight / total,
            bounds: surface.bounds(&pieces),
        };
        return Some((region, pieces));
    }
    None
}

/// The least-squares element of the pieces near `start`, and the points it was fitted to: those farther inside, as `depth`
/// says, if there are enough.
fn fitted(
    surface: &PieceGraph,
    start: &Shape,
    pieces: &[u32],
    depth: impl Fn(&u32) -> u8,
) -> Option<(Fit, Vec<u32>)> {
    let kind = start.kind();
    let all = surface.points_of(pieces.iter().copied());
    let fewest = fewest_points(kind).max(all.len() / 5);
    let options = fit::Options { start: Some(*start), ..fit::Options::default() };
    // One circle of points inside does not determine a torus; with those at the border it does.
    [2, 1, 0].into_iter().find_map(|least| {
        let points: Vec<u32> = all.iter().copied().filter(|p| least == 0 || depth(p) >= least).collect();
        if least > 0 && points.len() < fewest {
            return None;
        }
        let places: Vec<Point> = points.iter().map(|&i| surface.points[i as usize]).collect();
        let fit = fit::fit(&places, kind, &options, &Silent).ok()?;
        Some((fit, points))
    })
}

/// How far inside its region each measured point lies. It is 0 where pieces around it belong to several regions or none, for at
/// an edge it belongs to no face alone. It is 1 next to a border without an edge, which is known no better than the noise
/// allows. It is 2 elsewhere.
fn depths(context: &Context, labels: &[u32]) -> Vec<u8> {
    let surface = context.surface;
    let foreign = |p: u32| {
        let near = surface.neighbors(p).iter();
        near.copied().filter(move |&n| labels[n as usize] != labels[p as usize])
    };
    let faces = match surface.pieces {
        Pieces::Points => {
            // Single outliers among the neighbors do not make an edge.
            let inside = |p: u32| 4 * foreign(p).count() <= surface.neighbors(p).len();
            return (0..surface.len() as u32).map(|p| 2 * u8::from(inside(p))).collect();
        }
        Pieces::Facets(faces) => faces,
    };
    let mut owner: Vec<Option<u32>> = vec![None; surface.points.len()];
    let mut depths = vec![2; surface.points.len()];
    for (piece, (face, &label)) in (0u32..).zip(faces.iter().zip(labels)) {
        let smooth = foreign(piece).any(|n| {
            let across = dot(surface.normals[piece as usize], surface.normals[n as usize]);
            labels[n as usize] != NO_PIECE && across >= context.crease
        });
        for &v in face {
            let v = v as usize;
            let depth = if *owner[v].get_or_insert(label) != label { 0 } else { 2 - u8::from(smooth) };
            depths[v] = depth.min(depths[v]);
        }
    }
    depths
}
