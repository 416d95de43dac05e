//! What a report draws of a trend: the reference in the colors of mean and spread over the parts; charts of the characteristics.

pub(crate) mod axes;
pub(crate) mod chart;
mod gutter;
#[cfg(test)]
mod tests;

use crate::{Geometry, NoValue, ViewField, ViewObject, ViewRole};
use trueness_document::place_map::TrendMap;
use trueness_geom::mesh::Mesh;

/// Mean and spread prepared for drawing.
pub struct View {
    mesh: Mesh,
    values: [Vec<f64>; 2],
    reasons: Vec<NoValue>,
    /// Where they are greatest.
    keep: Vec<u32>,
}

impl View {
    /// Of a map. Places where not every part has a value are gray.
    pub fn new(map: &TrendMap) -> View {
        let greatest = [&map.means, &map.std_devs].into_iter().filter_map(|q| q.greatest);
        View {
            mesh: trueness_measure::trend::mesh(map),
            values: [map.drawn(&map.mean), map.drawn(&map.std_dev)],
            reasons: map.parts.iter().map(reason).collect(),
            keep: greatest.map(|g| g.index as u32).collect(),
        }
    }

    /// The part.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let field = |(comparison, values)| ViewField { comparison, values, reasons: &self.reasons };
        vec![ViewObject {
            role: ViewRole::Part,
            name: "",
            color: None,
            comparison: None,
            geometry: Geometry::Mesh(&self.mesh),
            fields: (0..).zip(self.values.iter().map(Vec::as_slice)).map(field).collect(),
            keep: &self.keep,
            gathered: None,
            faces: None,
        }]
    }
}

/// Why there is no value at a place where so many parts have one.
fn reason(parts: &u64) -> NoValue {
    if *parts == 0 { NoValue::NotMeasured } else { NoValue::SomeParts }
}
