//! The part of each node: what the items of its representations are.

use super::super::part21::File;
use super::assembly::Assembly;
use super::curve::Geometry;
use super::face::Faces;
use super::item::{Item, item};
use super::looks::Looks;
use super::placement::Units;
use super::shape::Shapes;
use super::topology::Topology;
use crate::formats::brep::Budget;
use std::cell::RefCell;
use std::collections::BTreeSet;
use trueness_cad::model::{Part, Unread};
use trueness_geom::progress::Progress;

/// What parts are read with.
pub(super) struct Reading<'f> {
    pub file: &'f File<'f>,
    pub budget: &'f Budget,
    pub looks: &'f Looks,
    pub progress: &'f dyn Progress,
    /// Within which two places are one, millimeters.
    pub tolerance: f64,
    /// Items of the shapes of products: a representation of no product may show them again.
    pub shown: RefCell<BTreeSet<u64>>,
    /// The entities of all faces that were come to.
    pub reached: &'f RefCell<BTreeSet<u64>>,
}

impl<'f> Reading<'f> {
    fn shapes(&self, units: Units) -> Shapes<'f> {
        let geometry = Geometry { file: self.file, units, tolerance: self.tolerance, budget: self.budget };
        Shapes::new(Faces::new(Topology::new(geometry), self.looks, self.progress, self.reached))
    }

    /// The part of a node, and what of it could not be read; `None` where its representations have no shape.
    pub fn part(&self, assembly: &Assembly, node: usize) -> (Option<Part>, Vec<Unread>) {
        let Some(node) = assembly.nodes.get(node) else { return (None, vec![]) };
        let Some(first) = node.representations.first() else { return (None, vec![]) };
        let mut shapes = self.shapes(assembly.units(*first));
        for number in &node.representations {
            let units = assembly.units(*number);
            if units != shapes.faces.topology.geometry.units {
                shapes.faces.forget();
                shapes.faces.topology.geometry.units = units;
            }
            let Some(representation) = assembly.representations.get(number) else { continue };
            if let Err(wrong) = &representation.context {
                shapes.faces.tell(*number, wrong, false);
            }
            let color = self.looks.color(*number);
            for number in &representation.items {
                if self.shown.borrow_mut().insert(*number) || node.is_product {
                    shapes.add(*number, color);
                }
            }
        }
        finished(shapes, node.tree.name.clone())
    }

    /// The part of all shapes of a file whose representations are lost: solids, else models of shells, else shells, else faces.
    pub fn loose(&self, units: Units) -> (Option<Part>, Vec<Unread>) {
        let mut shapes = self.shapes(units);
        let kinds = [Item::Solid, Item::Model, Item::Shell, Item::Face];
        let of_kind = |kind: Item| {
            let is_kind = move |e: &super::super::part21::Entity| item(e) == kind;
            self.file.entities().filter(is_kind).map(|e| e.number()).collect::<Vec<u64>>()
        };
        let found = kinds.into_iter().map(of_kind).find(|all| !all.is_empty());
        found.unwrap_or_default().into_iter().for_each(|number| shapes.add(number, None));
        finished(shapes, String::new())
    }
}

fn finished(mut shapes: Shapes, name: String) -> (Option<Part>, Vec<Unread>) {
    let mut unread = std::mem::take(&mut shapes.faces.unread);
    let part = shapes.part(name);
    // Triangles beside exact faces show the same once more.
    for told in unread.iter_mut().filter(|u| u.keyword.contains("TESSELLATED")) {
        told.holds_faces &= part.brep.faces.is_empty();
    }
    let is_empty = part.brep.faces.is_empty() && part.wires == 0;
    ((!is_empty).then_some(part), unread)
}
