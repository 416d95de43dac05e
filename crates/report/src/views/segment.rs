//! What a report draws of a segmentation: every region in its own color, with the lines between them.

use crate::{Mark, MarkGroup, Marks, ViewObject, ViewRole};
use trueness_document::scale::palette::{Rgb, category};
use trueness_document::segment::SegmentDocument;
use trueness_geom::mesh::Mesh;
use trueness_geom::scan::Scan;
use trueness_geom::space::{Point, Vector, cross, minus, plus, unit};
use trueness_measure::segment::cut_out;

/// What belongs to no region.
const NONE: Rgb = [0xb9, 0xb4, 0xaa];
/// The color of a region, by its number, or of what belongs to none: the same on the page and in files.
pub fn color(region: Option<usize>) -> Rgb {
    region.map_or(NONE, category)
}

/// The lines between regions.
const LINE: Rgb = [0x22, 0x26, 0x2b];

/// A segmentation prepared for drawing.
pub struct View<'a> {
    document: &'a SegmentDocument,
    /// One for each region, then what belongs to none.
    parts: Vec<Scan>,
    /// The rim of each region, in the order of the regions.
    pub marks: Vec<Marks>,
}

impl<'a> View<'a> {
    /// Of the regions of a mesh or a cloud; `labels` has the number of the region of each facet
    /// or point, and any greater number where there is none.
    pub fn new(document: &'a SegmentDocument, scan: &Scan, labels: &[u32]) -> View<'a> {
        let count = document.regions.len();
        let mut members: Vec<Vec<usize>> = vec![vec![]; count + 1];
        for (piece, label) in labels.iter().enumerate() {
            members[(*label as usize).min(count)].push(piece);
        }
        let part = |members: &Vec<usize>| match scan {
            Scan::Cloud(points) => {
                Scan::Cloud(members.iter().filter_map(|p| points.get(*p).copied()).collect())
            }
            Scan::Mesh(mesh) => Scan::Mesh(cut_out(mesh, members)),
        };
        let parts: Vec<Scan> = members.iter().map(part).collect();
        let rim = |part: &Scan| part.mesh().map(rim).unwrap_or_default().finite();
        let items = parts.iter().take(count).map(rim).collect();
        let group = MarkGroup { key: "edges".into(), color: LINE, items };
        let marks = vec![Marks { role: ViewRole::Edges, comparison: None, groups: vec![group] }];
        View { document, parts, marks }
    }

    /// A mesh or cloud for each region, in the order of the regions, then the rest if there is any.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let names = self.document.regions.iter().map(|r| r.shape.name()).chain([""]);
        (self.parts.iter().zip(names).enumerate())
            .filter(|(_, (part, _))| !part.points().is_empty())
            .map(|(n, (part, name))| {
                let number = Some(n).filter(|n| *n < self.document.regions.len());
                ViewObject::plain(ViewRole::Part, name, Some(color(number)), part)
            })
            .collect()
    }
}

/// Edges with one facet (or an odd number of them), and which way the facets look on the whole.
pub(crate) fn rim(part: &Mesh) -> Mark {
    let mut sides: Vec<[u32; 2]> = Vec::with_capacity(3 * part.faces.len());
    let mut sum: Vector = [0.0; 3];
    for f in &part.faces {
        for [a, b] in [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]] {
            sides.push([a.min(b), a.max(b)]);
        }
        let [a, b, c] = f.map(|v| part.positions[v as usize]);
        sum = plus(sum, cross(minus(b, a), minus(c, a)));
    }
    sides.sort_unstable();
    let place = |v: u32| -> Point { part.positions[v as usize] };
    let single = sides.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1);
    let segments = single.map(|same| same[0].map(place)).collect();
    let normal = unit(sum).map(|(n, _)| n).filter(|n| n.iter().all(|x| x.is_finite()));
    Mark { segments, normal, ..Mark::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_cut_out_has_its_rim() {
        let positions = vec![[9.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = Mesh { positions, faces: vec![[0, 1, 2], [1, 2, 3], [1, 3, 4]] };
        let part = cut_out(&mesh, &[1, 2]);
        assert_eq!((part.positions.len(), &part.faces[..]), (4, &[[0, 1, 2], [0, 2, 3]][..]));
        let rim = rim(&part);
        assert_eq!((rim.segments.len(), rim.normal), (4, Some([0.0, 0.0, 1.0])));
    }
}
