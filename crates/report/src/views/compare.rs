//! What a report draws: the measured object and the references, each with its deviations.

use crate::shown::first_view;
use crate::views::check::groups;
use crate::{Gathered, Geometry, Marks, NoValue, ObjectFaces, ViewField, ViewObject, ViewRole};
use std::collections::BTreeSet;
use trueness_document::compare::{CompareDocument, Comparison};
use trueness_geom::mesh::Mesh;
use trueness_geom::space::Point;
use trueness_measure::check::found;
use trueness_measure::compare::{Comparisons, Exact, Excluded, MapSurface, Reference, Values};
use trueness_measure::drawn_faces::DrawnFaces;

/// Deviations prepared for drawing.
pub struct View<'a> {
    name: &'a str,
    mesh: Option<&'a Mesh>,
    references: &'a [Reference<'a>],
    found: &'a Comparisons,
    /// The points drawn, where it is not a mesh.
    points: Vec<Point>,
    measured: Vec<Field>,
    /// Places of the measured object that the result names.
    flagged: Vec<u32>,
    maps: Vec<Option<Field>>,
    /// Of each reference the faces of its drawn facets, where it is a CAD model.
    faces: Vec<Option<Vec<u32>>>,
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
        let mut numbers = found.shown.indices.clone();
        let mut points = vec![];
        let lists: Vec<Vec<f64>> = match vertices {
            Some(lists) => lists.into_iter().map(<[f64]>::to_vec).collect(),
            None => {
                numbers.extend(&found.flagged.indices);
                points = [&found.shown.points[..], &found.flagged.points].concat();
                let both = found.shown.deviations.iter().zip(&found.flagged.deviations);
                both.map(|(a, b)| [&a[..], b].concat()).collect()
            }
        };
        let worst = found.references.iter().flat_map(|c| &c.worst).map(|w| w.place.index);
        let flagged = match drawn {
            true => worst.filter_map(|w| u32::try_from(w).ok()).collect(),
            false => {
                let worst: BTreeSet<u64> = worst.collect();
                (0..).zip(&numbers).filter(|(_, n)| worst.contains(n)).map(|(i, _)| i).collect()
            }
        };
        let map = |c: &trueness_measure::compare::Compared| {
            c.map.as_ref().map(|m| Field::of(&m.values, NoValue::NotMeasured))
        };
        View {
            name,
            mesh: mesh.filter(|_| drawn),
            references,
            found,
            points,
            measured: lists.iter().map(|values| Field::of(values, NoValue::BoundaryEdge)).collect(),
            flagged,
            maps: found.references.iter().map(map).collect(),
            faces: references.iter().zip(&found.references).map(|(r, c)| faces(r, c.map.as_ref())).collect(),
        }
    }

    /// Where the references are not sound, in the order of the document's findings.
    pub fn marks(&self, document: &CompareDocument) -> Vec<Marks> {
        let of = |(n, (c, r)): (usize, (&Comparison, &Reference))| {
            let found = found(&c.soundness.findings);
            let groups = groups(&found, r.mesh, r.left_out);
            (!found.is_empty()).then_some(Marks { role: ViewRole::Defects, comparison: Some(n), groups })
        };
        document.comparisons.iter().zip(self.references).enumerate().filter_map(of).collect()
    }

    /// What a comparison shows first, for a page that is about something else.
    pub fn mapped(&self) -> Vec<ViewObject<'_>> {
        let objects = self.objects();
        let shown = first_view(&objects);
        let of = |(n, o)| shown.contains(&n).then_some(ViewObject { role: ViewRole::Deviation, ..o });
        (0..).zip(objects).filter_map(of).collect()
    }

    /// The objects: measured, then the references.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let measured = ViewObject {
            role: ViewRole::Measured,
            name: self.name,
            color: None,
            comparison: None,
            geometry: self.mesh.map_or(Geometry::Points(&self.points), Geometry::Mesh),
            fields: self.measured.iter().enumerate().map(|(i, f)| f.view(i)).collect(),
            keep: &self.flagged,
            gathered: None,
            faces: None,
        };
        let all =
            self.references.iter().zip(&self.found.references).zip(&self.maps).zip(&self.faces).enumerate();
        let references = all.map(|(i, (((r, found), field), faces))| {
            let map = found.map.as_ref();
            ViewObject {
                role: ViewRole::Reference,
                name: &r.name,
                color: None,
                comparison: Some(i),
                geometry: Geometry::Mesh(map.and_then(|m| m.mesh.as_ref()).unwrap_or(r.mesh)),
                fields: field.as_ref().map(|f| f.view(i)).into_iter().collect(),
                keep: map.map_or(&[], |m| &m.keep),
                gathered: map.map(|m| Gathered { reach: m.reach, vertices: r.mesh.positions.len() }),
                faces: drawn(r)
                    .zip(faces.as_deref())
                    .map(|(drawn, of_facet)| ObjectFaces { drawn, of_facet }),
            }
        });
        std::iter::once(measured).chain(references).collect()
    }
}

/// What is drawn of a reference that is a CAD model.
fn drawn<'a>(reference: &Reference<'a>) -> Option<&'a DrawnFaces> {
    match reference.exact {
        Some(Exact::Cad(faces)) => Some(&faces.drawn),
        _ => None,
    }
}

/// The faces of the drawn facets; they are those of the reference, or parts of them.
fn faces(reference: &Reference, map: Option<&MapSurface>) -> Option<Vec<u32>> {
    let own = &drawn(reference)?.of_facet;
    Some(match map.filter(|map| map.mesh.is_some()) {
        Some(map) => map.facets.iter().filter_map(|facet| own.get(*facet as usize).copied()).collect(),
        None => own.clone(),
    })
}

impl Field {
    /// A value that is not finite becomes NaN, and its reason is the exclusion it stands for; that of NaN is `nan`.
    fn of(values: &[f64], nan: NoValue) -> Field {
        let reason = |d: &f64| match Excluded::of(*d) {
            None => NoValue::Unknown,
            Some(Excluded::BoundaryEdge) => nan,
            Some(excluded) => excluded.into(),
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

impl From<Excluded> for NoValue {
    fn from(e: Excluded) -> NoValue {
        match e {
            Excluded::MaxDistance => NoValue::MaxDistance,
            Excluded::BoundaryEdge => NoValue::BoundaryEdge,
            Excluded::Facing => NoValue::Facing,
            Excluded::Outlier => NoValue::Outlier,
            Excluded::NoCrossing => NoValue::NoCrossing,
            Excluded::NoDirection => NoValue::NoDirection,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn documents_and_pages_name_what_is_excluded_alike() {
        for excluded in Excluded::ALL {
            assert_eq!(NoValue::from(excluded).name(), excluded.name());
        }
    }
}
