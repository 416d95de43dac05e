//! What points are measured against: facets, B-spline surfaces, or faces of a CAD model.

use super::against::{Exact, Reference, ReferenceError};
use super::along::{AlongRule, Lines};
use super::cad_target::CadTarget;
use super::excluded::Excluded;
use super::facing::facet_normal;
use super::kept::{Asked, Measures, Nearest, none};
use super::options::Options;
use super::worst::WorstPoint;
use trueness_geom::check::Precondition;
use trueness_geom::closest::{Closest, QueryError, Tree};
use trueness_geom::deviation::along::Along;
use trueness_geom::deviation::sign_choice::{SignChoice, SignMethod};
use trueness_geom::deviation::surface::{Disagreement, ReferenceSurface, SurfaceOptions};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Progress, Silent};
use trueness_geom::space::{Point, times};
use trueness_geom::spline::surface::{FootSearch, NearestFoot};
use trueness_geom::topology::{Soundness, TopologyError};

/// A reference ready to be measured against.
pub enum Target<'a> {
    /// The nearest facet counts.
    Facets { surface: Box<ReferenceSurface>, mesh: &'a Mesh, along: Option<Along> },
    /// The nearest place of the surfaces counts; facets only draw them.
    Splines(Splines<'a>),
    /// The nearest place of the faces of a CAD model counts, or where lines meet them.
    Cad(CadTarget<'a>, Precondition),
}

/// B-spline surfaces with what is asked of them.
pub struct Splines<'a> {
    search: &'a FootSearch,
    options: SurfaceOptions,
    choice: SignChoice,
    precondition: Precondition,
}

impl<'a> Target<'a> {
    /// Prepares a reference; `tree` is that of its mesh, unless it has surfaces.
    pub fn new(
        reference: &Reference<'a>,
        tree: Option<&'a Tree>,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Target<'a>, ReferenceError> {
        match (reference.exact, tree) {
            (None, Some(tree)) => {
                let surface = ReferenceSurface::new(tree, reference.mesh, &options.surface, progress)?;
                let along =
                    options.along.as_ref().map(|lines| along(lines, &surface, progress)).transpose()?;
                Ok(Target::Facets { surface: Box::new(surface), mesh: reference.mesh, along })
            }
            (Some(Exact::Splines(search)), _) => Ok(Target::Splines(Splines {
                search,
                options: options.surface,
                choice: SignChoice::by_normal(options.surface.sign),
                precondition: without_facets(search.surfaces()),
            })),
            (Some(Exact::Cad(faces)), Some(tree)) => {
                let target = CadTarget::new(faces, tree, options.surface, options.along.as_ref());
                Ok(Target::Cad(target, without_facets(faces.faces.len())))
            }
            (_, None) => Err(ReferenceError::Mesh(trueness_geom::closest::MeshError::NoFaces)),
        }
    }

    /// How the sign is found.
    pub fn sign(&self) -> &SignChoice {
        match self {
            Target::Facets { surface, .. } => surface.sign(),
            Target::Splines(s) => &s.choice,
            Target::Cad(target, _) => &target.choice,
        }
    }
    /// Whether the facets are sound; surfaces have none that could be wrong.
    pub fn precondition(&self) -> &Precondition {
        match self {
            Target::Facets { surface, .. } => surface.precondition(),
            Target::Splines(s) => &s.precondition,
            Target::Cad(_, precondition) => precondition,
        }
    }
    /// How both sign methods agree on a sample; surfaces have one.
    pub fn disagreement(
        &self,
        sample: &[Point],
        progress: &dyn Progress,
    ) -> Result<Option<Disagreement>, QueryError> {
        match self {
            Target::Facets { surface, .. } if surface.sign().method != SignMethod::None => {
                surface.disagreement(sample, progress).map(Some)
            }
            _ => Ok(None),
        }
    }

    /// Deviations of points, and their places in a map.
    pub fn measure(
        &self,
        points: &[Point],
        asked: &Asked,
        progress: &dyn Progress,
    ) -> Result<Measures, QueryError> {
        let facing = Excluded::Facing.value();
        match self {
            Target::Facets { surface, mesh, along: Some(along) } => {
                let turn = if surface.sign().inside_out { -1.0 } else { 1.0 };
                let found =
                    surface.map_along(asked.start, points, along, progress, |i, deviation, met| {
                        let Some(met) = met else { return none(deviation) };
                        if !asked.agrees(i, || facet_normal(mesh, met.face).map(|n| times(turn, n))) {
                            return none(facing);
                        }
                        asked.kept(i, deviation, met.face, met.barycentric, &met.point)
                    })?;
                Ok(Measures::of(found, asked))
            }
            Target::Facets { surface, .. } if asked.only_distances() => {
                let deviations = surface.deviations(points, progress)?;
                Ok(Measures { deviations, feet: vec![], regions: vec![], uncertain: 0 })
            }
            Target::Facets { surface, mesh, along: None } => {
                let (tree, turn) = (surface.tree(), if surface.sign().inside_out { -1.0 } else { 1.0 });
                let found = surface.map(points, progress, |i, deviation, hit| {
                    let hit = hit.filter(|_| deviation.is_finite() && asked.needs_place(i));
                    let Some(hit) = hit else { return none(deviation) };
                    let place = tree.place(&points[i], hit);
                    if !asked.agrees(i, || facet_normal(mesh, place.face).map(|n| times(turn, n))) {
                        return none(facing);
                    }
                    asked.kept(i, deviation, place.face, place.barycentric, &place.point)
                })?;
                Ok(Measures::of(found, asked))
            }
            Target::Splines(s) => {
                let found = s.search.map(points, progress, |i, foot| {
                    let deviation = s.deviation(&points[i], &foot);
                    if deviation.is_finite() && !asked.agrees(i, || foot.foot.normal) {
                        return (facing, None, foot.certain);
                    }
                    let kept = asked.foot(i, foot.face, foot.weights).filter(|_| deviation.is_finite());
                    (deviation, kept, foot.certain)
                })?;
                let uncertain = found.iter().filter(|f| !f.2).count() as u64;
                let (deviations, feet) = found.into_iter().map(|(d, f, _)| (d, f)).unzip();
                Ok(Measures { deviations, feet, regions: vec![], uncertain })
            }
            Target::Cad(target, _) => target.measure(points, asked, progress),
        }
    }

    /// Where a point is nearest, or where its line meets the reference; `None` for one that cannot be measured.
    pub fn nearest(&self, place: &WorstPoint) -> Result<Option<Nearest>, QueryError> {
        let p = &place.point;
        match self {
            Target::Facets { surface, mesh, along: Some(along) } => {
                let met = surface.map_along(place.index, &[*p], along, &Silent, |_, _, met| met.copied())?;
                Ok(met.into_iter().flatten().next().map(|met| Nearest {
                    place: met.point,
                    normal: facet_normal(mesh, met.face),
                    face: met.face,
                    weights: met.barycentric,
                }))
            }
            Target::Facets { surface, mesh, along: None } => {
                let found = surface.tree().closest(p, f64::INFINITY)?;
                Ok(found.map(|Closest { point, face, barycentric: weights, .. }| Nearest {
                    place: point,
                    normal: facet_normal(mesh, face),
                    face,
                    weights,
                }))
            }
            Target::Splines(s) => {
                let NearestFoot { foot, face, weights, .. } = s.search.nearest(p);
                let found = Nearest { place: foot.place, normal: foot.normal, face, weights };
                Ok(foot.distance.is_finite().then_some(found))
            }
            Target::Cad(target, _) => target.nearest(place),
        }
    }
}

impl Splines<'_> {
    fn deviation(&self, p: &Point, found: &NearestFoot) -> f64 {
        if found.foot.distance > self.options.max_distance {
            return Excluded::MaxDistance.value();
        }
        if self.options.skip_boundary && found.border {
            return Excluded::BoundaryEdge.value();
        }
        if self.choice.method == SignMethod::None { found.foot.distance } else { found.foot.signed(*p) }
    }
}

/// The lines that are asked for, ready to be measured along.
fn along(
    lines: &Lines,
    surface: &ReferenceSurface,
    progress: &dyn Progress,
) -> Result<Along, ReferenceError> {
    Ok(match lines.rule() {
        AlongRule::Direction(d) => Along::Direction(d),
        AlongRule::Measured => Along::Measured(lines.normals()),
        AlongRule::Reference => surface.normals(progress).map_err(TopologyError::from)?,
    })
}

/// Nothing is wrong with facets where there are none.
fn without_facets(surfaces: usize) -> Precondition {
    let soundness = Soundness {
        sound: true,
        closed: false,
        consistently_oriented: true,
        outward: true,
        boundary_edges: 0,
        non_manifold_edges: 0,
        non_manifold_vertices: 0,
        duplicate_facets: 0,
        degenerate_facets: 0,
        not_finite_facets: 0,
        inconsistent_edges: 0,
        shells: surfaces,
        first_flaws: vec![],
    };
    Precondition { soundness, findings: vec![], shells_overlap: false }
}
