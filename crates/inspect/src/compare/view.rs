//! What a report draws: the measured object and the references, each with its deviations.

use super::{Comparisons, Reference, Values};
use crate::check::groups;
use crate::report::{Geometry, Marks, NoValue, ViewField, ViewObject, ViewRole};
use crate::results::check::found;
use crate::results::compare::{CompareDocument, Comparison};
use trueness_geom::deviation::surface::Exclusion;
use trueness_geom::mesh::Mesh;

/// Deviations prepared for drawing.
pub struct View<'a> {
    name: &'a str,
    mesh: Option<&'a Mesh>,
    references: &'a [Reference<'a>],
    found: &'a Comparisons,
    measured: Vec<Field>,
    maps: Vec<Field>,
}

/// One value a place, NaN beside a reason where there is none.
struct Field {
    values: Vec<f64>,
    reasons: Vec<NoValue>,
}

impl<'a> View<'a> {
    /// Of a comparison of `name`; `mesh` is the measured mesh if its vertices are what was compared.
    pub fn new(
        name: &'a str,
        mesh: Option<&'a Mesh>,
        references: &'a [Reference<'a>],
        found: &'a Comparisons,
    ) -> View<'a> {
        let vertices: Option<Vec<&[f64]>> = mesh.and_then(|_| {
            let all = found.references.iter().map(|c| match &c.values {
                Values::All(values) => Some(values.as_slice()),
                Values::Many(_) => None,
            });
            all.collect()
        });
        let drawn = vertices.is_some();
        let lists = vertices.unwrap_or_else(|| found.shown.deviations.iter().map(Vec::as_slice).collect());
        let map =
            |c: &super::Compared| c.vertex_map.as_ref().map(|m| Field::of(&m.values(), NoValue::NotMeasured));
        View {
            name,
            mesh: mesh.filter(|_| drawn),
            references,
            found,
            measured: lists.iter().map(|values| Field::of(values, NoValue::FreeEdge)).collect(),
            maps: found.references.iter().filter_map(map).collect(),
        }
    }

    /// Where the references are not sound, in the order of the document's findings.
    pub fn marks(&self, document: &CompareDocument) -> Vec<Marks> {
        let of = |(n, (c, r)): (usize, (&Comparison, &Reference))| {
            let found = found(&c.soundness.findings);
            let groups = groups(&found, r.mesh);
            (!found.is_empty()).then_some(Marks { role: ViewRole::Defects, comparison: Some(n), groups })
        };
        document.comparisons.iter().zip(self.references).enumerate().filter_map(of).collect()
    }

    /// The objects: measured, then the references.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let measured = ViewObject {
            role: ViewRole::Measured,
            name: self.name,
            color: None,
            comparison: None,
            geometry: self.mesh.map_or(Geometry::Points(&self.found.shown.points), Geometry::Mesh),
            fields: self.measured.iter().enumerate().map(|(i, f)| f.view(i)).collect(),
        };
        let references = self.references.iter().enumerate().map(|(i, r)| ViewObject {
            role: ViewRole::Reference,
            name: &r.name,
            color: None,
            comparison: Some(i),
            geometry: Geometry::Mesh(r.mesh),
            fields: self.maps.get(i).map(|f| f.view(i)).into_iter().collect(),
        });
        std::iter::once(measured).chain(references).collect()
    }
}

impl Field {
    /// A value that is not finite becomes NaN, and its reason is the exclusion it stands for; that of NaN is `nan`.
    fn of(values: &[f64], nan: NoValue) -> Field {
        let reason = |d: &f64| match Exclusion::of(*d) {
            None => NoValue::Unknown,
            Some(Exclusion::MaxDistance) => NoValue::MaxDistance,
            Some(Exclusion::FreeEdge) => nan,
        };
        Field {
            values: values.iter().map(|&d| if d.is_finite() { d } else { f64::NAN }).collect(),
            reasons: values.iter().map(reason).collect(),
        }
    }

    fn view(&self, comparison: usize) -> ViewField<'_> {
        ViewField { comparison, values: &self.values, reasons: &self.reasons }
    }
}
