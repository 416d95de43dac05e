//! What a report draws of a fit: the points by their distance, the element through them, the points that hold it.

mod element;

use crate::views::fit::element::element;
use crate::{Geometry, Mark, MarkGroup, Marks, NoValue, ViewField, ViewObject, ViewRole};
use trueness_document::fit::FitDocument;
use trueness_document::scale::palette::category;
use trueness_geom::mesh::Mesh;
use trueness_geom::shape::Shape;
use trueness_geom::space::Point;
use trueness_measure::fit::distances;

/// A fit prepared for drawing.
pub struct View<'a> {
    name: &'a str,
    points: &'a [Point],
    distances: Vec<f64>,
    body: Mesh,
    /// Touching points in the document's order, then the element's lines.
    pub marks: Vec<Marks>,
}

impl<'a> View<'a> {
    /// Of the points that the document is of; `name` is shown to the reader.
    pub fn new(document: &FitDocument, name: &'a str, shape: &Shape, points: &'a [Point]) -> View<'a> {
        let (body, lines) =
            document.extent.as_ref().map_or((Mesh::default(), Mark::default()), |e| element(shape, e));
        let touching = document.touching.iter().map(|t| {
            let dot = Mark { points: t.position.into_iter().collect(), ..Mark::default() };
            let key = if t.side > 0 { "touching.outer" } else { "touching.inner" };
            // One group each: the document's order stays.
            MarkGroup { key: key.into(), color: side_color(t.side), items: vec![dot.finite()] }
        });
        let touching = Marks { role: ViewRole::Touching, comparison: None, groups: touching.collect() };
        let rim = MarkGroup {
            key: "element".into(),
            color: ViewRole::Element.color(),
            items: vec![lines.finite()],
        };
        let rim = Marks { role: ViewRole::Element, comparison: None, groups: vec![rim] };
        let marks = if touching.groups.is_empty() { vec![rim] } else { vec![touching, rim] };
        View { name, points, distances: distances(shape, points), body, marks }
    }

    /// The points, and the body where the element has one.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let distances = ViewField { comparison: 0, values: &self.distances, reasons: &[] as &[NoValue] };
        let geometry = Geometry::Points(self.points);
        let (role, name) = (ViewRole::Measured, self.name);
        let mut objects = vec![ViewObject {
            role,
            name,
            color: None,
            comparison: None,
            geometry,
            fields: vec![distances],
            keep: &[],
            gathered: None,
            faces: None,
        }];
        if !self.body.faces.is_empty() {
            let (role, geometry) = (ViewRole::Element, Geometry::Mesh(&self.body));
            objects.push(ViewObject {
                role,
                name: "",
                color: None,
                comparison: None,
                geometry,
                fields: vec![],
                keep: &[],
                gathered: None,
                faces: None,
            });
        }
        objects
    }
}

/// Color of a point that touches the outer or the inner boundary.
pub fn side_color(side: i8) -> trueness_document::scale::palette::Rgb {
    category(if side > 0 { 0 } else { 4 })
}
