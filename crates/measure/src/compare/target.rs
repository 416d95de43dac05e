//! What points are measured against: facets, or B-spline surfaces themselves.

use super::against::{CadFaces, Exact, Reference, ReferenceError};
use super::along::{AlongRule, Lines};
use super::covered::CoverageSample;
use super::excluded::Excluded;
use super::facing::{Facing, facet_normal};
use super::map::{Foot, PointMap};
use super::options::Options;
use super::region::Regions;
use super::worst::WorstPoint;
use trueness_cad::search::{Nearest as CadNearest, Side};
use trueness_geom::check::Precondition;
use trueness_geom::closest::{Closest, QueryError, Tree};
use trueness_geom::deviation::along::Along;
use trueness_geom::deviation::sign_choice::{SignChoice, SignMethod};
use trueness_geom::deviation::surface::{Disagreement, ReferenceSurface, SurfaceOptions};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Progress, Silent};
use trueness_geom::space::{Point, Vector, dot, minus, times};
use trueness_geom::spline::surface::{FootSearch, NearestFoot};
use trueness_geom::topology::{Soundness, TopologyError};

/// A reference ready to be measured against.
pub enum Target<'a> {
    /// The nearest facet counts.
    Facets { surface: Box<ReferenceSurface>, mesh: &'a Mesh, along: Option<Along> },
    /// The nearest place of the surfaces counts; facets only draw them.
    Splines(Splines<'a>),
    /// The nearest place of the faces of a CAD model counts; `tree` finds the facet that draws it.
    Cad { faces: CadTarget<'a>, tree: &'a Tree },
}

/// Faces of a CAD model with what is asked of them.
pub struct CadTarget<'a> {
    faces: &'a CadFaces,
    options: SurfaceOptions,
    choice: SignChoice,
    precondition: Precondition,
}

/// B-spline surfaces with what is asked of them.
pub struct Splines<'a> {
    search: &'a FootSearch,
    options: SurfaceOptions,
    choice: SignChoice,
    precondition: Precondition,
}

/// Where a point is nearest to the reference, or where its line meets it.
pub struct Nearest {
    /// The place.
    pub place: Point,
    /// Unit normal there; `None` where there is none.
    pub normal: Option<Vector>,
    /// The facet there.
    pub face: u32,
    /// Weights of the facet's corners.
    pub weights: [f64; 3],
}

/// What is asked beside the distances of points whose first has number `start`.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    pub start: u64,
    /// Where nearest places are looked up, and the facets they lie on.
    pub map: Option<(&'a PointMap, &'a Mesh)>,
    /// The sample that tells what is covered.
    pub sample: Option<&'a CoverageSample>,
    /// Only points that look the same way count.
    pub facing: Option<&'a Facing>,
    /// Parts of the reference that are told apart.
    pub regions: Option<&'a Regions>,
}

impl Asked<'_> {
    /// Whether no more is asked than distances.
    fn only_distances(&self) -> bool {
        self.map.is_none() && self.sample.is_none() && self.facing.is_none() && self.regions.is_none()
    }

    /// Whether the place of point `i` of these on the reference matters.
    fn needs_place(&self, i: usize) -> bool {
        self.map.is_some() || self.facing.is_some() || self.regions.is_some() || self.samples(i)
    }

    /// Whether the sample asks for point `i` of these.
    fn samples(&self, i: usize) -> bool {
        self.sample.is_some_and(|s| s.wants(self.start + i as u64))
    }

    /// The place of point `i` on the reference, as map and sample need it.
    fn foot(&self, i: usize, face: u32, weights: [f64; 3]) -> Option<Foot> {
        match self.map {
            Some((map, mesh)) => Some(map.foot(mesh, face, weights)),
            None => self.samples(i).then(|| Foot::on_facet(face, weights)),
        }
    }

    /// What is kept of point `i` with this deviation and place on the reference.
    fn kept(&self, i: usize, deviation: f64, face: u32, weights: [f64; 3], place: &Point) -> Kept {
        let region = self.regions.map_or(0, |r| r.of(face, place));
        (deviation, self.foot(i, face, weights), region)
    }

    /// Whether point `i` of these may count beside a place of the reference with this normal.
    fn agrees(&self, i: usize, normal: impl Fn() -> Option<Vector>) -> bool {
        self.facing.is_none_or(|f| f.agrees(self.start + i as u64, normal()))
    }
}

/// A deviation, its place in the map and its region.
type Kept = (f64, Option<Foot>, u16);

/// What is not measured has no place.
fn none(deviation: f64) -> Kept {
    (deviation, None, 0)
}

/// Deviations of points; with a map, where their nearest places lie in it; and how many nearest places are not beyond doubt.
pub struct Measures {
    pub deviations: Vec<f64>,
    pub feet: Vec<Option<Foot>>,
    /// Numbers of regions, 0 for none; empty where there are no regions.
    pub regions: Vec<u16>,
    pub uncertain: u64,
}

impl Measures {
    fn of(found: Vec<Kept>, asked: &Asked) -> Measures {
        let regions = asked.regions.map_or(vec![], |_| found.iter().map(|f| f.2).collect());
        let (deviations, feet) = found.into_iter().map(|(d, foot, _)| (d, foot)).unzip();
        Measures { deviations, feet, regions, uncertain: 0 }
    }
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
                let target = CadTarget {
                    faces,
                    options: options.surface,
                    choice: SignChoice::by_normal(options.surface.sign),
                    precondition: without_facets(faces.count),
                };
                Ok(Target::Cad { faces: target, tree })
            }
            (_, None) => Err(ReferenceError::Mesh(trueness_geom::closest::MeshError::NoFaces)),
        }
    }

    /// How the sign is found.
    pub fn sign(&self) -> &SignChoice {
        match self {
            Target::Facets { surface, .. } => surface.sign(),
            Target::Splines(s) => &s.choice,
            Target::Cad { faces, .. } => &faces.choice,
        }
    }
    /// Whether the facets are sound; surfaces have none that could be wrong.
    pub fn precondition(&self) -> &Precondition {
        match self {
            Target::Facets { surface, .. } => surface.precondition(),
            Target::Splines(s) => &s.precondition,
            Target::Cad { faces, .. } => &faces.precondition,
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
            Target::Cad { faces, tree } => {
                let found = faces.faces.search.map(points, progress, |i, near| {
                    let deviation = faces.deviation(&points[i], &near);
                    let certain = near.side != Side::Unsure;
                    if !deviation.is_finite() {
                        return (none(deviation), certain);
                    }
                    if !asked.agrees(i, || near.normal) {
                        return (none(facing), certain);
                    }
                    let drawn = || tree.closest(&near.place, f64::INFINITY).ok().flatten();
                    match asked.needs_place(i).then(drawn).flatten() {
                        Some(at) => (asked.kept(i, deviation, at.face, at.barycentric, &near.place), certain),
                        None => (none(deviation), certain),
                    }
                })?;
                let uncertain = found.iter().filter(|f| !f.1).count() as u64;
                let kept = found.into_iter().map(|f| f.0).collect();
                Ok(Measures { uncertain, ..Measures::of(kept, asked) })
            }
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
            Target::Cad { faces, tree } => {
                let near = faces.faces.search.nearest(p);
                if !near.distance.is_finite() {
                    return Ok(None);
                }
                let drawn = tree.closest(&near.place, f64::INFINITY)?;
                Ok(drawn.map(|Closest { face, barycentric: weights, .. }| Nearest {
                    place: near.place,
                    normal: near.normal,
                    face,
                    weights,
                }))
            }
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

impl CadTarget<'_> {
    fn deviation(&self, p: &Point, near: &CadNearest) -> f64 {
        if near.distance > self.options.max_distance {
            return Excluded::MaxDistance.value();
        }
        if self.options.skip_boundary && near.side == Side::Open {
            return Excluded::BoundaryEdge.value();
        }
        if self.choice.method == SignMethod::None {
            return near.distance;
        }
        // At the border of an open shell the normal tells the side, as it does beside it.
        let by_normal = || {
            let inside = near.normal.is_some_and(|n| dot(n, minus(*p, near.place)) < 0.0);
            if inside { -near.distance } else { near.distance }
        };
        near.signed().unwrap_or_else(by_normal)
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
