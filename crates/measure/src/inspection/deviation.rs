//! Deviations of all that was measured from the reference, as `compare` computes them.

use super::data::Data;
use super::nominals::Nominals;
use super::stop::{NominalFault, NotCompared, Stop};
use crate::compare::{
    self, Between, CompareError, Comparisons, Exact, Extent, Facing, Lines, Options, Reference, RegionRule,
    vertex_normals,
};
use crate::cad_faces::CadFaces;
use crate::file_numbers::LeftOut;
use crate::plan::{Deviation, Plan};
use std::convert::Infallible;
use std::sync::Arc;
use trueness_document::compare::MeasuredKind;
use trueness_document::place_map::PlaceMap;
use trueness_geom::closest::QueryError;
use trueness_geom::cloud::Whole;
use trueness_geom::deviation::surface::SurfaceOptions;
use trueness_geom::feature::facets_near;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::scan::Scan;

/// Deviations from the reference, with what they were asked by.
pub struct Deviations {
    /// What was found; one reference.
    pub found: Comparisons,
    /// How it was asked.
    pub options: Options,
    /// The reference, or the mesh that draws its faces.
    pub reference: Mesh,
    /// The faces of a CAD model that were measured against.
    pub faces: Option<Arc<CadFaces>>,
    /// Facets of its file that are not in the mesh.
    pub left_out: Vec<u32>,
    /// `points` of a cloud, `vertices` of a mesh.
    pub kind: MeasuredKind,
}

impl Deviations {
    /// Deviations at places that are the same for every part, where they were asked for.
    pub fn place_map(&self) -> Option<PlaceMap> {
        let found = self.found.references.first()?.places.as_ref()?;
        Some(PlaceMap {
            places: found.mesh.positions.clone(),
            facets: found.mesh.faces.clone(),
            deviations: found.means.iter().map(|d| Some(*d).filter(|d| d.is_finite())).collect(),
            points: found.counts.clone(),
            reach: found.reach,
        })
    }

    /// The reference under the name that documents call it by.
    pub fn references(&self, name: &str) -> [Reference<'_>; 1] {
        [reference(name, (&self.reference, self.faces.as_deref()), &self.left_out)]
    }
}

fn reference<'a>(
    name: &str,
    (mesh, faces): (&'a Mesh, Option<&'a CadFaces>),
    left_out: &'a [u32],
) -> Reference<'a> {
    Reference { name: name.into(), mesh, exact: faces.map(Exact::Cad), left_out: LeftOut(left_out) }
}

/// Of the data where the alignment took them. The reference is moved out of the data.
pub(super) fn deviations(
    asked: &Deviation,
    plan: &Plan,
    nominals: &Nominals,
    data: &mut Data,
    progress: &dyn Progress,
) -> Result<Deviations, Stop> {
    let (Some(measured), Some(reference)) = (&data.measured, data.reference.take()) else {
        return Err(Stop::Deviation(NotCompared::NotThere));
    };
    let mut normals = match asked.needs_normals() {
        None => vec![],
        Some(_) => match measured {
            Scan::Cloud(_) => std::mem::take(&mut data.normals),
            Scan::Mesh(mesh) => vertex_normals(mesh),
        },
    };
    let judges = asked.tolerance.is_some() || !asked.regions.is_empty();
    let mapped = data.shown > 0 || asked.coverage.is_some() || data.places || judges;
    let between = measured.mesh().filter(|_| mapped).map(Between::of).unwrap_or_default();
    if asked.needs_normals().is_some() {
        normals.extend(&between.normals);
    }
    let options = Options {
        facing: asked.facing.map(|angle| Facing::new(angle, normals.clone())),
        along: asked.along.map(|rule| Lines::new(rule, normals)),
        outliers: asked.outliers,
        coverage: asked.coverage,
        min_coverage: asked.min_coverage,
        between,
        surface: SurfaceOptions {
            max_distance: asked.max_distance,
            skip_boundary: asked.skip_boundary,
            ..SurfaceOptions::default()
        },
        regions: regions(asked, plan, nominals, &reference)?,
        tolerance: asked.tolerance,
        required_share: asked.required_share,
        shown: data.shown,
        places: data.places,
        seed: data.seed,
        ..Options::default()
    };
    let mut points = Whole::<Infallible>::new(measured.points().to_vec());
    let left_out = std::mem::take(&mut data.reference_left_out);
    let faces = data.faces.clone();
    let references = [self::reference("the reference", (&reference, faces.as_deref()), &left_out)];
    let found = compare::run(&mut points, &references, &options, progress, |_| Ok::<(), Infallible>(()));
    let found = found.map_err(|e| match e {
        CompareError::Query(QueryError::Cancelled(e)) => e.into(),
        e @ CompareError::Reference { .. } => Stop::Nominal(NominalFault::Compare(e)),
        e => Stop::Deviation(NotCompared::Compare(e)),
    })?;
    let kind = match measured {
        Scan::Cloud(_) => MeasuredKind::Points,
        Scan::Mesh(_) => MeasuredKind::Vertices,
    };
    Ok(Deviations { found, options, reference, faces, left_out, kind })
}

/// The regions, those of features with their facets.
pub(super) fn regions(
    asked: &Deviation,
    plan: &Plan,
    nominals: &Nominals,
    reference: &Mesh,
) -> Result<Vec<RegionRule>, Stop> {
    let rule = |region: &crate::plan::ToleranceRegion| -> Result<RegionRule, Stop> {
        let Some(number) = region.feature else { return Ok(region.rule.clone()) };
        let feature = &plan.features[number];
        let wrong = |what: String| Stop::Plan {
            span: region.span.clone(),
            what: format!("region \"{}\": {what}", region.rule.id),
        };
        let nominal = nominals.of(number, feature);
        let nominal = nominal.ok_or_else(|| wrong(format!("feature \"{}\" has no nominal", feature.id)))?;
        let near = feature.near(nominal);
        let own = nominals.own(number).zip(nominals.faces.as_ref());
        let own: Vec<u32> = match own {
            Some((own, faces)) => {
                own.faces.iter().flat_map(|f| faces.all[*f as usize].facets.clone()).collect()
            }
            None => (0..reference.faces.len() as u32).collect(),
        };
        let mut facets = facets_near(reference, &own, nominal, &near).map_err(|e| wrong(e.to_string()))?;
        facets.sort_unstable();
        if facets.is_empty() {
            return Err(wrong(format!(
                "the reference has nothing where feature \"{}\" should be",
                feature.id
            )));
        }
        Ok(RegionRule { extent: Extent::Facets(facets), ..region.rule.clone() })
    };
    asked.regions.iter().map(rule).collect()
}
