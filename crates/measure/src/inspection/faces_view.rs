//! The partition as a report draws it: each face in a color of its own, what is of no face or in doubt in grays.

use super::parted::Parted;
use crate::plan::Plan;
use crate::segment::cut_out;
use std::collections::BTreeMap;
use trueness_document::scale::palette::{Rgb, category};
use trueness_geom::partition::{Class, NO_FACE, Partition};
use trueness_geom::scan::Scan;

/// Faces of no feature share so many colors.
const OTHER_FACE_COLORS: usize = 10;

/// A part of what was measured that is drawn in one color.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnFace {
    /// The features that the face is of; of what is of no face the key of a word; empty of a face that is of no feature.
    pub name: String,
    /// Its color.
    pub color: Rgb,
    /// The facets with their vertices, or the points of a cloud.
    pub scan: Scan,
}

/// What a piece is drawn as: those of features come first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Feature(usize),
    Other(usize),
    /// The place of its class in [`CLASSES`].
    Gray(usize),
}

/// Classes that are no form of a face, with the keys of their words: in doubt darker, left out lighter.
const CLASSES: [(Class, &str, Rgb); 8] = [
    (Class::Edge, "class.edge", [0xb9, 0xb4, 0xaa]),
    (Class::Alone, "class.outliers", [0xd8, 0xd4, 0xcc]),
    (Class::Beyond, "class.beyond", [0xd8, 0xd4, 0xcc]),
    (Class::Dent, "class.dents", [0x8c, 0x88, 0x80]),
    (Class::Broken, "class.broken", [0x45, 0x42, 0x3d]),
    (Class::Deep, "class.deep", [0x45, 0x42, 0x3d]),
    (Class::High, "class.high", [0x45, 0x42, 0x3d]),
    (Class::Between, "class.between", [0x45, 0x42, 0x3d]),
];

/// All that was measured, each piece once. Cost: some passes over it, and a copy.
pub(super) fn drawn(plan: &Plan, parted: &Parted) -> Vec<DrawnFace> {
    let (scan, partition) = (parted.scan(), parted.partition());
    // The features of each face, and the faces of features in the order of the plan.
    let mut names: BTreeMap<u32, Vec<&str>> = BTreeMap::new();
    let mut order: Vec<u32> = vec![];
    for (number, feature) in plan.features.iter().enumerate() {
        for face in parted.own(number).map_or(&[][..], |own| &own.faces) {
            let of = names.entry(*face).or_default();
            if of.is_empty() {
                order.push(*face);
            }
            of.push(&feature.id);
        }
    }
    let places: BTreeMap<u32, usize> = order.iter().enumerate().map(|(place, face)| (*face, place)).collect();
    let of_face = |face: u32| {
        places.get(&face).map_or(Kind::Other(face as usize % OTHER_FACE_COLORS), |n| Kind::Feature(*n))
    };
    let mut pieces: BTreeMap<Kind, Vec<usize>> = BTreeMap::new();
    let count = scan.mesh().map_or(scan.points().len(), |mesh| mesh.faces.len());
    for piece in 0..count {
        let kind = match scan.facets().get(piece) {
            Some(corners) => facet(partition, piece, corners).map_or_else(Kind::Gray, of_face),
            None => point(partition, piece).map_or_else(Kind::Gray, of_face),
        };
        pieces.entry(kind).or_default().push(piece);
    }
    let part = |(kind, pieces): (Kind, Vec<usize>)| {
        let (name, color) = match kind {
            Kind::Feature(place) => (names[&order[place]].join(", "), category(place)),
            Kind::Other(n) => (String::new(), category(order.len() + n)),
            Kind::Gray(n) => (CLASSES[n].1.to_string(), CLASSES[n].2),
        };
        let scan = match scan {
            Scan::Cloud(points) => Scan::Cloud(pieces.iter().map(|p| points[*p]).collect()),
            Scan::Mesh(mesh) => Scan::Mesh(cut_out(mesh, &pieces)),
        };
        DrawnFace { name, color, scan }
    };
    pieces.into_iter().map(part).collect()
}

/// The face of a point, or the place of its class.
fn point(partition: &Partition, point: usize) -> Result<u32, usize> {
    let class = partition.classes[point];
    match CLASSES.iter().position(|(c, ..)| *c == class) {
        Some(place) => Err(place),
        None => Some(partition.owners[point]).filter(|face| *face != NO_FACE).ok_or(BEYOND_CLASS),
    }
}

/// The face of a facet; else of its corners the last class in the list, or that it straddles an edge.
fn facet(partition: &Partition, number: usize, corners: &[u32; 3]) -> Result<u32, usize> {
    let doubts = corners
        .iter()
        .filter_map(|v| point(partition, *v as usize).err())
        .filter(|place| *place > EDGE_CLASS);
    match (doubts.max(), partition.facets[number]) {
        (Some(place), _) => Err(place),
        (None, NO_FACE) => Err(EDGE_CLASS),
        (None, face) => Ok(face),
    }
}

/// Places in the list.
const EDGE_CLASS: usize = 0;
const BEYOND_CLASS: usize = 2;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_places_are_those_of_the_list() {
        assert_eq!((CLASSES[EDGE_CLASS].0, CLASSES[BEYOND_CLASS].0), (Class::Edge, Class::Beyond));
    }
}
