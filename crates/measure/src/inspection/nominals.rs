//! What is known of a plan's features before anything is measured: their nominals, and the faces of the reference that they are.

use super::data::Data;
use super::by_face::{self, Located, Model, PartOfFaces};
use super::seed;
use super::stop::{NominalFault, Stop};
use crate::plan::Plan;
use crate::requirement::Feature;
use std::collections::BTreeMap;
use trueness_document::face::FaceRecord;
use trueness_geom::feature::{Nearness, Nominal, NominalSurface, bounds_of, facets_near, places_over};
use trueness_geom::mesh::Mesh;
use trueness_geom::partition::{Face, Faces};
use trueness_geom::progress::Progress;
use trueness_geom::segment::SegmentError;
use trueness_geom::space::{Point, Vector, dot, single_step};

/// A face may be off the surface of a nominal by this share of the distance up to which points are sought.
const MAX_OFF_DISTANCE_SHARE: f64 = 1e-3;
/// So many times as far off as the face that holds most of a nominal its others may be: a nominal may lean, by the digits it is written with.
const MAX_LEANING_RATIO: f64 = 4.0;

/// The nominals of a plan, and the reference cut into faces.
pub(super) struct Nominals {
    /// Of the features that are named by a place or by faces of the reference, what is there.
    pub located: BTreeMap<usize, Located>,
    /// The faces of the reference, where there is one and a feature is sought by its nominal.
    pub faces: Option<Faces>,
    /// Of the features that the reference has, by their numbers, their faces.
    own: BTreeMap<usize, OwnFaces>,
    /// The faces of the file behind those of the reference, where it is a CAD model.
    model: Option<Model>,
}

/// The faces of the reference that a feature is.
pub(super) struct OwnFaces {
    /// Their numbers, ascending.
    pub faces: Vec<u32>,
    /// Of a cylinder, cone or sphere, whether they face its axis or center.
    pub inward: Option<bool>,
    /// Whether places of the nominal lie over them.
    pub is_over: bool,
    /// Which part of these faces it is, where it is not all of them.
    pub part: Option<PartOfFaces>,
}

impl Nominals {
    /// Cost: one segmentation of the reference, and a look at its facets near each feature.
    ///
    /// # Errors
    /// [`Stop`]: a reference that cannot be cut into faces, a seed that is at no face of the feature's kind.
    pub fn new(plan: &Plan, data: &Data, progress: &dyn Progress) -> Result<Nominals, Stop> {
        let mut nominals = Nominals { located: BTreeMap::new(), faces: None, own: BTreeMap::new(), model: None };
        let is_sought = plan.features.iter().any(Feature::has_nominal);
        let Some(reference) = data.reference.as_ref().filter(|r| is_sought && !r.faces.is_empty()) else {
            return Ok(nominals);
        };
        let model = data.faces.as_ref().map(|faces| Model::new(faces.clone(), reference));
        let (model, faces) = match model {
            Some((model, faces)) => (Some(model), faces),
            None => (None, Faces::of(reference, progress).map_err(|e| match e {
                SegmentError::Cancelled(e) => e.into(),
                e => Stop::Nominal(NominalFault::Faces(e)),
            })?),
        };
        nominals.located = seed::seeded(plan, reference, (&faces, model.as_ref()), progress)?;
        nominals.located.extend(by_face::chosen(plan, reference, (&faces, model.as_ref()))?);
        for (number, feature) in plan.features.iter().enumerate() {
            if let Some(own) = nominals.located.get_mut(&number).and_then(|l| l.own.take()) {
                nominals.own.insert(number, own);
                continue;
            }
            let Some(nominal) = nominals.of(number, feature) else { continue };
            let near = feature.near(nominal);
            let found = own_faces(reference, &faces, nominal, &near, progress)?;
            let turned = turned(nominal).filter(|_| found.is_none());
            if let Some(turned) = turned
                && own_faces(reference, &faces, &turned, &near, progress)?.is_some_and(|own| own.is_over)
            {
                let what = format!(
                    "feature \"{}\": the reference faces the other way there: turn the `normal` of the nominal, which points out of the material, or the facets of the reference",
                    feature.id
                );
                return Err(Stop::Plan { span: feature.span.clone(), what });
            }
            if let Some(own) = found {
                nominals.own.insert(number, own);
            }
        }
        nominals.faces = Some(faces);
        nominals.model = model;
        Ok(nominals)
    }

    /// The nominal of a feature: written, or by its seed.
    pub fn of<'a>(&'a self, number: usize, feature: &'a Feature) -> Option<&'a Nominal> {
        self.located.get(&number).map(|l| &l.nominal).or(feature.nominal.as_ref())
    }

    /// What documents say of the faces of a CAD model that each feature is.
    pub fn face_records(&self, plan: &Plan) -> Vec<Vec<FaceRecord>> {
        let of = |number| match (&self.model, self.own(number)) {
            (Some(model), Some(own)) => model.records(own),
            _ => vec![],
        };
        (0..plan.features.len()).map(of).collect()
    }

    /// The faces of a feature; `None` where the reference does not have it.
    pub fn own(&self, number: usize) -> Option<&OwnFaces> {
        self.own.get(&number)
    }
}

/// The faces of the reference that lie on the surface of a nominal, within its bounds.
fn own_faces(
    reference: &Mesh,
    faces: &Faces,
    nominal: &Nominal,
    near: &Nearness,
    progress: &dyn Progress,
) -> Result<Option<OwnFaces>, Stop> {
    // A nominal that makes no sense is told where it is sought.
    let (Some(surface), Ok(places), Ok(bounds)) =
        (nominal.surface(), places_over(nominal), bounds_of(nominal))
    else {
        return Ok(None);
    };
    // As far off it, and as far beyond its bounds.
    let bounds = bounds.widened(2.0 * near.distance);
    let wide = Nearness { margin: -near.distance, ..*near };
    let mut held: Vec<Held> = vec![];
    for (number, face) in (0u32..).zip(&faces.all).filter(|(_, face)| face.bounds.meets(&bounds)) {
        if progress.cancelled() {
            return Err(Stop::Cancelled);
        }
        let beneath = beneath(face, &places, &surface, near);
        let beside = facets_near(reference, &face.facets, nominal, &wide).unwrap_or_default();
        if beneath.is_empty() && beside.is_empty() {
            continue;
        }
        let corners = beside.iter().flat_map(|f| reference.faces[*f as usize]);
        let off = |v: u32| surface.distance(reference.positions[v as usize]).map(|d| d.0.abs());
        let share = beneath.len();
        let mut all: Vec<f64> = corners.filter_map(off).chain(beneath).collect();
        all.sort_unstable_by(f64::total_cmp);
        let off = all.get(all.len() / 2).copied().unwrap_or(f64::INFINITY);
        held.push(Held { number, share, facets: beside.len(), off });
    }
    let Some(most) = held.iter().max_by_key(|h| (h.share, h.facets)) else { return Ok(None) };
    let limit = (MAX_LEANING_RATIO * most.off)
        .max(MAX_OFF_DISTANCE_SHARE * near.distance)
        .max(single_step(&reference.positions));
    let first = &faces.all[most.number as usize];
    let inward = if matches!(nominal, Nominal::Plane { .. }) { None } else { first.inward() };
    let is_alike = |h: &&Held| h.off <= limit && faces.all[h.number as usize].inward() == first.inward();
    let own = held.iter().filter(is_alike).map(|h| h.number).collect();
    Ok(Some(OwnFaces { faces: own, inward, is_over: most.share > 0 && most.off <= limit, part: None }))
}

/// A plane that faces the other way.
fn turned(nominal: &Nominal) -> Option<Nominal> {
    let Nominal::Plane { point, normal, boundary } = nominal else { return None };
    Some(Nominal::Plane { point: *point, normal: normal.map(|x| -x), boundary: boundary.clone() })
}

/// A face near a nominal.
struct Held {
    number: u32,
    /// Places of the nominal that lie over it.
    share: usize,
    /// Its facets near the nominal.
    facets: usize,
    /// How far it lies off the surface of the nominal, mm.
    off: f64,
}

/// How far off a face lies from the places of a nominal that lie over it: those where it is no farther off than is sought, and does not face otherwise.
fn beneath(face: &Face, places: &[Point], surface: &NominalSurface, near: &Nearness) -> Vec<f64> {
    let off = |(place, over): (&Point, Option<(f64, Vector)>)| {
        let (off, normal) = over?;
        let way = surface.distance(*place)?.1;
        let along = match (surface, near.inward) {
            (NominalSurface::Plane(..), _) => dot(normal, way),
            (_, None) => dot(normal, way).abs(),
            (_, Some(inward)) => dot(normal, way) * if inward { -1.0 } else { 1.0 },
        };
        (along >= libm::cos(near.angle)).then_some(off.abs())
    };
    places.iter().zip(face.over(places, near.distance)).filter_map(off).collect()
}
