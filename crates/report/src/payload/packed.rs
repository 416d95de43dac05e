//! One object as blobs, in a given quality.

use super::super::{Geometry, ReportError, ViewObject, ViewRole};
use super::blob::ByteKind;
use super::contents::Payload;
use super::entry::{CountEntry, Entry, FieldEntry, ObjectEntry, PlacesEntry};
use super::field::Codes;
use super::grid::Grid;
use super::mesh::{self, MeshBytes, Ordered, Wanted};
use super::parted::Parted;
use super::{gather, planes, points};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Aabb, Point};

/// The worst points of each field are kept however much is left out.
const WORST_POINTS_KEPT: usize = 200;
/// Bytes of base64 that a triangle of a coarser level takes.
pub const LEVEL_BYTES: usize = 2;
/// Points drawn at most: more change nothing that can be seen, and the file is for looking.
pub const MAX_DRAWN_POINTS: usize = 1_000_000;

/// How much may be kept.
#[derive(Clone, Copy, Debug)]
pub struct Quality {
    /// Points, of each cloud.
    pub points: usize,
    /// Triangles, of each mesh.
    pub triangles: usize,
    /// Bits of a coordinate.
    pub bits: u32,
}

/// What objects are packed for.
#[derive(Clone, Copy)]
pub struct Purpose<'a> {
    /// What the values of each map are looked at in: the width of the tolerance zone or of the scale. The last one is that of all
    /// further maps.
    pub ranges: &'a [f64],
    /// The tolerance, by which the worst of several points is told.
    pub zone: Option<[f64; 2]>,
    /// Hears of places, and is asked whether to go on.
    pub progress: &'a dyn Progress,
}

impl Purpose<'_> {
    fn range(&self, map: usize) -> f64 {
        self.ranges.get(map).or(self.ranges.last()).copied().unwrap_or(1.0)
    }
}

/// An object as blobs, without the coarser levels of a mesh.
pub struct Packed {
    /// Its entry of the manifest, and blobs.
    pub part: Payload,
    /// The mesh, if it is one.
    pub mesh: Option<Ordered>,
}

impl Quality {
    /// Nothing left out.
    pub fn all(objects: &[ViewObject]) -> Quality {
        let triangles = objects.iter().filter_map(|o| o.mesh()).map(|m| m.faces.len()).max().unwrap_or(0);
        let points = objects.iter().filter_map(|o| o.points()).map(<[Point]>::len).max().unwrap_or(0);
        Quality { points: points.min(MAX_DRAWN_POINTS), triangles, bits: 16 }
    }

    /// A share of the places.
    pub fn times(self, share: f64) -> Quality {
        let part = |n: usize| (n as f64 * share) as usize;
        Quality { points: part(self.points), triangles: part(self.triangles), ..self }
    }

    /// No more than `most` has.
    pub fn at_most(self, most: Quality) -> Quality {
        let (points, triangles) = (self.points.min(most.points), self.triangles.min(most.triangles));
        Quality { points, triangles, ..self }
    }
}

impl Packed {
    /// Bytes of base64, with what the levels will probably take.
    pub fn expected(&self) -> usize {
        let triangles = self.mesh.as_ref().map_or(0, |m| m.triangles.len());
        self.part.len() + mesh::level_sizes(triangles).sum::<usize>() * LEVEL_BYTES
    }
}

/// 14 bits do while their step is at most an eighth of the median edge.
pub fn coarse_grid_is_fine(object: &ViewObject) -> bool {
    let Some(mesh) = object.mesh() else { return true };
    let mut edges: Vec<f64> = mesh
        .faces
        .iter()
        .step_by(1 + mesh.faces.len() / 10_000)
        .filter_map(|f| Some((mesh.positions.get(f[0] as usize)?, mesh.positions.get(f[1] as usize)?)))
        .map(|(a, b)| trueness_geom::space::norm(trueness_geom::space::minus(*a, *b)))
        .collect();
    edges.sort_by(f64::total_cmp);
    let median = edges.get(edges.len() / 2).copied().unwrap_or(0.0);
    Grid::over(&mesh.bounds(), 14).step <= median / 8.0
}

/// Packs an object, which has the number `id`; `shown`: by the first view.
pub fn pack_object(
    object: &ViewObject,
    (id, shown): (usize, bool),
    purpose: &Purpose,
    quality: Quality,
) -> Result<Packed, ReportError> {
    let mut part = Payload::default();
    let (entry, mesh) = match object.geometry {
        Geometry::Mesh(mesh) => {
            let parted = object.faces.map(|faces| Parted::of(object, mesh, &faces));
            let own = parted.as_ref().map(|parted| (parted.object(object), parted.mesh()));
            let (object, mesh) = own.as_ref().map_or((object, mesh), |(object, mesh)| (object, mesh));
            let (entry, ordered) = pack_mesh(&mut part, object, (mesh, parted.as_ref()), purpose, quality)?;
            (entry, Some(ordered))
        }
        Geometry::Points(points) => (pack_points(&mut part, object, points, purpose, quality)?, None),
    };
    part.objects.push(Entry::Object(ObjectEntry { display_error: part.display_error, id, shown, ..entry }));
    Ok(Packed { part, mesh })
}

fn pack_mesh(
    part: &mut Payload,
    object: &ViewObject,
    (mesh, parted): (&Mesh, Option<&Parted>),
    purpose: &Purpose,
    quality: Quality,
) -> Result<(ObjectEntry, Ordered), ReportError> {
    let keep = kept(object);
    // Vertices lie together on purpose where faces meet, and places that show gathered points.
    let wanted = Wanted {
        keep: &keep,
        limit: quality.triangles.max(4),
        join: object.gathered.is_none() && parted.is_none(),
    };
    let ordered = Ordered::of(mesh, &wanted, purpose.progress)?;
    let grid = Grid::over(&Aabb::of(&ordered.positions), quality.bits);
    let bytes = MeshBytes::of(&ordered, &grid)?;
    if purpose.progress.cancelled() {
        return Err(Cancelled.into());
    }
    part.simplified = ordered.error > 0.0;
    part.display_error = ordered.error + grid.error();
    let corners = part.add(&bytes.triangles, ByteKind::Code);
    let positions = part.add(&bytes.positions, ByteKind::Differences);
    let mut reach = object.gathered.map(|g| g.reach);
    let owners = reach.filter(|_| part.simplified).map(|r| {
        let owners = gather::owners(mesh, &ordered.source);
        reach = Some(r + gather::farthest(mesh, &owners));
        owners
    });
    let mut fields = vec![];
    for field in &object.fields {
        let codes = Codes::for_values(field.values, purpose.range(field.comparison));
        let worst = owners.as_ref().map(|owners| gather::worst(field.values, owners, purpose.zone));
        let at = |v: usize| match &worst {
            Some(worst) => (worst[v], field.at(v).1),
            None => field.at(v),
        };
        let packed = bytes.field(&codes, |v| at(ordered.source[v as usize] as usize));
        fields.push(FieldEntry::new(field.comparison, codes, part.add(&packed, ByteKind::Differences)));
    }
    let places = PlacesEntry::Mesh {
        triangles: ordered.triangles.len(),
        source_triangles: mesh.faces.len(),
        reach,
        corners,
        positions,
        levels: vec![],
    };
    let faces = parted
        .zip(object.faces)
        .map(|(parted, faces)| parted.entry(part, faces.drawn, (&ordered, &bytes, &grid)));
    let given = object.gathered.map_or(mesh.positions.len(), |g| g.vertices);
    let entry = ObjectEntry::new(object, &grid, (ordered.positions.len(), given), places);
    Ok((ObjectEntry { fields, faces, ..entry }, ordered))
}

fn pack_points(
    part: &mut Payload,
    object: &ViewObject,
    points: &[Point],
    purpose: &Purpose,
    quality: Quality,
) -> Result<ObjectEntry, ReportError> {
    let finite: Vec<u32> =
        (0u32..).zip(points).filter(|(_, p)| p.iter().all(|x| x.is_finite())).map(|(i, _)| i).collect();
    let grid = Grid::over(&Aabb::of(finite.iter().map(|i| &points[*i as usize])), quality.bits);
    let places: Vec<[u16; 3]> = finite.iter().map(|i| grid.place(&points[*i as usize])).collect();
    let worst: Vec<u32> =
        kept(object).iter().filter_map(|w| finite.binary_search(w).ok()).map(|i| i as u32).collect();
    let levels = points::levels(&places, &worst, quality.points);
    let count = levels.order.len();
    if purpose.progress.cancelled() {
        return Err(Cancelled.into());
    }
    let positions: Vec<u8> = (0..3)
        .flat_map(|k| {
            let at = |i: usize| i32::from(places[levels.order[i] as usize][k]);
            let differences = (0..count).into_par_iter().map(|i| at(i) - if i > 0 { at(i - 1) } else { 0 });
            planes::pack(differences, 2)
        })
        .collect();
    let positions = part.add(&positions, ByteKind::Differences);
    let fields = object
        .fields
        .iter()
        .map(|field| {
            let codes = Codes::for_values(field.values, purpose.range(field.comparison));
            let at = |i: usize| {
                let (value, reason) = field.at(finite[levels.order[i] as usize] as usize);
                codes.code(value, reason)
            };
            let differences =
                (0..count).into_par_iter().map(|i| at(i).wrapping_sub(if i > 0 { at(i - 1) } else { 0 }));
            let packed = planes::pack(differences, codes.bytes);
            FieldEntry::new(field.comparison, codes, part.add(&packed, ByteKind::Differences))
        })
        .collect();
    part.display_error = grid.error();
    if object.role == ViewRole::Measured {
        part.points = (count, points.len());
    }
    let levels = levels.ends.iter().map(|end| CountEntry { points: *end }).collect();
    let places = PlacesEntry::Points { positions, levels };
    Ok(ObjectEntry { fields, ..ObjectEntry::new(object, &grid, (count, points.len()), places) })
}

/// The points or vertices with the greatest deviations, over all fields, and those that the result names.
fn kept(object: &ViewObject) -> Vec<u32> {
    let mut worst: Vec<u32> = object.keep.to_vec();
    for field in &object.fields {
        let size = |i: &u32| field.values[*i as usize].abs();
        let mut finite: Vec<u32> =
            (0u32..).zip(field.values).filter(|(_, v)| v.is_finite()).map(|(i, _)| i).collect();
        let by_size = |a: &u32, b: &u32| size(b).total_cmp(&size(a)).then(a.cmp(b));
        if finite.len() > WORST_POINTS_KEPT {
            finite.select_nth_unstable_by(WORST_POINTS_KEPT, by_size);
            finite.truncate(WORST_POINTS_KEPT);
        }
        worst.extend(finite);
    }
    worst.sort_unstable();
    worst.dedup();
    worst
}
