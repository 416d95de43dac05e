//! `trueness/view/1`: what the page's script draws, as a manifest (JSON) and blobs.
//!
//! Positions are 16-bit numbers on a cubic grid, deviations 16- or 24-bit codes with apart codes for missing values,
//! triangles the published triangle code; everything is predicted from what the reader has, then gzipped. See
//! `docs/decisions/` for why.

mod blob;
mod contents;
mod entry;
mod field;
mod gather;
mod grid;
mod marks;
mod mesh;
mod order;
mod packed;
mod parted;
mod planes;
mod points;
mod predict;
mod sample;
mod simplify;

pub use blob::{base64, zlib};
pub use contents::Payload;
pub use entry::Entry;
pub use packed::Purpose;

use super::marks::Marks;
use super::shown::first_view;
use super::{ReportError, ViewObject};
use blob::ByteKind;
use entry::{LevelEntry, PlacesEntry};
use packed::{Packed, Quality, coarse_grid_is_fine, pack_object};
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point};

/// Of what would just fit, so that it does.
const PACKED_ROOM_SHARE: f64 = 0.96;

/// Objects and marks in at most `budget` bytes of base64, as far as that can be done.
///
/// How finely they are packed is told from a part of each. What has clearly less than that is packed again with more, once; what
/// has more is packed again with less until it fits: first positions are rounded to 14 bits, then points are left out evenly and
/// edges collapsed.
pub fn pack(
    objects: &[ViewObject],
    marks: &[Marks],
    purpose: &Purpose,
    budget: usize,
) -> Result<Payload, ReportError> {
    /// There is clearly more room.
    const MORE_ROOM_FACTOR: f64 = 1.3;
    let marks = pack_all_marks(objects, marks);
    let budget = budget.saturating_sub(marks.len());
    let all = Quality::all(objects);
    let mut quality = sample::quality(all, objects, purpose, budget)?;
    let mut may_grow = quality.points < all.points || quality.triangles < all.triangles;
    loop {
        let packed = pack_at(objects, purpose, quality)?;
        let least = quality.points <= 1000 && quality.triangles <= 1000;
        let expected: usize = packed.iter().map(Packed::expected).sum();
        let mut share = budget as f64 / expected.max(1) as f64;
        if may_grow && share > MORE_ROOM_FACTOR {
            (may_grow, quality) = (false, quality.times(share * PACKED_ROOM_SHARE).at_most(all));
            continue;
        }
        if share >= 1.0 || least {
            let payload = with_levels(packed, purpose)?;
            share = budget as f64 / payload.len().max(1) as f64;
            if share >= 1.0 || least {
                purpose.progress.advance(objects.iter().map(|o| o.places().len() as u64).sum());
                return Ok(join(payload, marks));
            }
        }
        may_grow = false;
        if quality.bits == 16 && share > 0.85 && objects.iter().all(coarse_grid_is_fine) {
            quality.bits = 14;
        } else {
            quality = quality.times(share * PACKED_ROOM_SHARE);
        }
    }
}

/// Adds the coarser levels of meshes, and puts all together.
fn with_levels(packed: Vec<Packed>, purpose: &Purpose) -> Result<Payload, ReportError> {
    let add = |Packed { mut part, mesh }: Packed| {
        let levels = mesh.map_or(Ok(vec![]), |m| mesh::levels(&m, purpose.progress))?;
        let blobs: Vec<String> =
            levels.par_iter().map(|(code, ..)| base64(&blob::gzip(code, ByteKind::Code))).collect();
        let entry =
            |((_, triangles, error), blob)| LevelEntry { triangles, error, code: entry::Blob { blob } };
        let entries = levels.into_iter().zip(part.blobs.len()..).map(entry).collect();
        part.blobs.extend(blobs);
        if let [Entry::Object(object)] = &mut part.objects[..]
            && let PlacesEntry::Mesh { levels, .. } = &mut object.places
        {
            *levels = entries;
        }
        Ok(part)
    };
    let parts: Vec<Payload> = packed.into_par_iter().map(add).collect::<Result<_, ReportError>>()?;
    Ok(parts.into_iter().fold(Payload::default(), join))
}

/// Marks are few and are never thinned out. Their objects' numbers follow those of the others.
fn pack_all_marks(objects: &[ViewObject], marks: &[Marks]) -> Payload {
    let mut part = Payload::default();
    let around = objects.first().map_or(Aabb::EMPTY, |o| Aabb::of(o.places().iter().filter(finite)));
    let mut first = 0;
    for (n, m) in marks.iter().enumerate() {
        let entry = marks::pack_marks(&mut part, m, &around, first, objects.len() + n);
        part.objects.push(Entry::Marks(entry));
        first += m.items().count();
    }
    part
}

fn finite(p: &&Point) -> bool {
    p.iter().all(|x| x.is_finite())
}

fn pack_at(objects: &[ViewObject], purpose: &Purpose, quality: Quality) -> Result<Vec<Packed>, ReportError> {
    let shown = first_view(objects);
    let one =
        |(id, object): (usize, &ViewObject)| pack_object(object, (id, shown.contains(&id)), purpose, quality);
    objects.par_iter().enumerate().map(one).collect()
}

/// Appends a part, whose blobs get later numbers.
fn join(mut all: Payload, part: Payload) -> Payload {
    let shift = all.blobs.len();
    all.objects.extend(part.objects.into_iter().map(|entry| entry.shifted(shift)));
    all.blobs.extend(part.blobs);
    all.points = (all.points.0 + part.points.0, all.points.1 + part.points.1);
    all.display_error = all.display_error.max(part.display_error);
    all.simplified |= part.simplified;
    all
}
