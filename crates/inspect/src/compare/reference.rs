//! The running comparison with one reference.

use super::map::{Flagged, Foot, MapSurface, PointMap};
use super::options::{Method, Options};
use super::worst::{Place, WorstPlaces, sort};
use trueness_geom::check::Precondition;
use trueness_geom::closest::{Closest, MeshError, QueryError, Tree};
use trueness_geom::deviation::paper::{Differences, Paper, PaperError};
use trueness_geom::deviation::sign_choice::{SignChoice, SignMethod};
use trueness_geom::deviation::surface::{Disagreement, Exclusion, Surface};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Progress, Silent};
use trueness_geom::space::{Point, Vector, cross, minus, unit};
use trueness_geom::stats::histogram::{Histogram, Limits, nice_edges, zone_edges};
use trueness_geom::stats::statistics::{Accumulator, Statistics, Summary};
use trueness_geom::topology::TopologyError;

/// What was found about one reference.
pub struct Compared {
    /// Diagonal of the reference's box, millimetres.
    pub diagonal: f64,
    /// How the sign was found.
    pub sign: SignChoice,
    /// How both sign methods agree on a sample; absent for unsigned distances.
    pub disagreement: Option<Disagreement>,
    /// Whether the mesh is sound, and if not, where not.
    pub precondition: Precondition,
    /// Statistics of all deviations and of each side.
    pub summary: Summary,
    /// The deviations, or what is left of them when there were too many to keep.
    pub values: Values,
    /// Counts of the deviations between round edges: from the 0.1st to the 99.9th percentile, or near the tolerance zone
    /// where that is much narrower.
    pub histogram: Option<Histogram>,
    /// Counts against the tolerance, where there is one.
    pub limits: Option<Limits>,
    /// Points without a deviation.
    pub excluded: Vec<(Exclusion, u64)>,
    /// The worst places of both signs, the farthest beyond the tolerance first, without one the greatest.
    pub worst: Vec<WorstPlace>,
    /// The paper's method beside the exact distance.
    pub paper_vs_exact: Option<Differences>,
    /// The reference coloured by the points near each place, for a report.
    pub map: Option<MapSurface>,
}

/// One of the worst places, with where it is on the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPlace {
    /// The measured point.
    pub place: Place,
    /// The nearest place on the reference.
    pub nearest: Point,
    /// Unit normal of the facet there; `None` if it has no area.
    pub normal: Option<Vector>,
    /// The facet there.
    pub(super) face: u32,
    /// Weights of the facet's corners.
    pub(super) weights: [f64; 3],
}

/// Deviations in file order, excluded points included; or the sketch of them when they are too many.
pub enum Values {
    /// All of them.
    All(Vec<f64>),
    /// Counts and moments.
    Many(Box<Accumulator>),
}

/// Why a reference cannot be measured against.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    /// Its facets or coordinates do not allow it.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Its topology cannot be told.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// The paper's method refuses it.
    #[error(transparent)]
    Paper(#[from] PaperError),
}

/// Places of each sign that a result names.
const WORST: usize = 3;

/// A comparison under way.
pub struct Running<'a> {
    mesh: &'a Mesh,
    surface: Surface<'a>,
    values: Values,
    keep: usize,
    limits: Option<Limits>,
    excluded: [u64; Exclusion::ALL.len()],
    worst: WorstPlaces,
    paper: Option<(Paper, Differences)>,
    map: Option<PointMap>,
}

impl<'a> Running<'a> {
    /// Nothing measured yet; at most `keep` deviations stay in memory.
    pub fn new(
        mesh: &'a Mesh,
        tree: &'a Tree,
        options: &Options,
        keep: usize,
        progress: &dyn Progress,
    ) -> Result<Running<'a>, ReferenceError> {
        let paper = match options.method {
            Method::Exact => None,
            Method::Paper => Some((Paper::new(mesh)?, Differences::default())),
        };
        Ok(Running {
            surface: Surface::new(tree, mesh, &options.surface, progress)?,
            values: Values::All(vec![]),
            keep,
            limits: options.tolerance.map(|t| Limits::new(t.lower, t.upper)),
            excluded: Default::default(),
            worst: WorstPlaces::new(&mesh.bounds()),
            paper,
            map: (options.shown > 0).then(|| PointMap::new(mesh, options.tolerance)),
            mesh,
        })
    }

    /// The deviations of the next block, whose first point has number `start`.
    pub fn block(
        &mut self,
        start: u64,
        points: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, PaperError> {
        let (deviations, feet) = self.measure(points, progress)?;
        for e in deviations.iter().filter_map(|&d| Exclusion::of(d)) {
            self.excluded[e as usize] += 1;
        }
        if let Some(limits) = &mut self.limits {
            limits.push(&deviations);
            // An infinite value stands for a point that is not there, and does not lie above.
            limits.above -= deviations.iter().filter(|d| d.is_infinite()).count() as u64;
        }
        if let Some(map) = &mut self.map {
            for (foot, deviation) in feet.iter().zip(&deviations) {
                if let Some(foot) = foot {
                    map.add(*foot, *deviation);
                }
            }
        }
        self.worst.add(start, points, &deviations);
        self.values.push(&deviations, self.keep);
        Ok(deviations)
    }

    /// Deviations of points, and where their nearest places lie if there is a map.
    fn measure(
        &mut self,
        points: &[Point],
        progress: &dyn Progress,
    ) -> Result<(Vec<f64>, Vec<Option<Foot>>), PaperError> {
        let (mut deviations, feet) = match &self.map {
            None => (self.surface.deviations(points, progress)?, vec![]),
            Some(map) => with_feet(&self.surface, map, points, progress)?,
        };
        if let Some((paper, versus)) = &mut self.paper {
            let theirs = paper.values(points, progress)?;
            let size = |d: &f64| if d.is_finite() { d.abs() } else { f64::NAN };
            versus.push(&theirs, &deviations.iter().map(size).collect::<Vec<f64>>());
            // The paper has no sign: its distances get the exact method's.
            for (d, t) in deviations.iter_mut().zip(theirs).filter(|(d, _)| d.is_finite()) {
                *d = t.distance.copysign(*d);
            }
        }
        Ok((deviations, feet))
    }

    /// The places that the result will name.
    pub fn worst_places(&self) -> Vec<Place> {
        let mut places: Vec<Place> = self.worst.pick(WORST).into_iter().flatten().collect();
        let zone = self.limits.as_ref().map(|l| [l.lower, l.upper]);
        sort(&mut places, zone);
        places
    }

    /// Deviations of points that have been counted already.
    pub fn again(&self, points: &[Point]) -> Result<Vec<f64>, PaperError> {
        let mut deviations = self.surface.deviations(points, &Silent)?;
        if let Some((paper, _)) = &self.paper {
            for (d, t) in deviations.iter_mut().zip(paper.values(points, &Silent)?) {
                *d = if d.is_finite() { t.distance.copysign(*d) } else { *d };
            }
        }
        Ok(deviations)
    }

    /// The end of the points; `sample` is an even sample of them.
    pub fn finish(self, sample: &[Point], progress: &dyn Progress) -> Result<Compared, QueryError> {
        let choice = *self.surface.sign();
        let signed = choice.method != SignMethod::None;
        let summary = self.values.summary();
        let worst = worst(&self.surface, self.mesh, &self.worst_places())?;
        let flag =
            |w: &WorstPlace| Flagged { face: w.face, weights: w.weights, deviation: w.place.deviation };
        let flagged: Vec<Flagged> = worst.iter().map(flag).collect();
        Ok(Compared {
            diagonal: self.mesh.bounds().diagonal(),
            histogram: self.values.histogram(&summary.all, self.limits.as_ref()),
            limits: self.limits,
            sign: choice,
            disagreement: if signed { Some(self.surface.disagreement(sample, progress)?) } else { None },
            precondition: self.surface.precondition().clone(),
            summary,
            worst,
            values: self.values,
            excluded: Exclusion::ALL.iter().map(|&e| (e, self.excluded[e as usize])).collect(),
            paper_vs_exact: self.paper.map(|(_, versus)| versus),
            map: self.map.map(|map| MapSurface::of(self.mesh, &map, &flagged)),
        })
    }
}

impl Values {
    fn push(&mut self, deviations: &[f64], keep: usize) {
        if let Values::All(all) = self {
            if all.len() + deviations.len() <= keep {
                return all.extend_from_slice(deviations);
            }
            let mut many = Box::new(Accumulator::new());
            many.push(all);
            *self = Values::Many(many);
        }
        if let Values::Many(many) = self {
            many.push(deviations);
        }
    }

    fn histogram(&self, all: &Statistics, limits: Option<&Limits>) -> Option<Histogram> {
        let edges = match limits {
            Some(limits) => zone_edges(all, [limits.lower, limits.upper])?,
            None => nice_edges(all)?,
        };
        match self {
            Values::All(values) => {
                let mut histogram = Histogram::new(edges).ok()?;
                histogram.push(values);
                Some(histogram)
            }
            Values::Many(many) => many.sketch().histogram(&edges).ok(),
        }
    }

    fn summary(&self) -> Summary {
        match self {
            Values::All(all) => Summary::of(all),
            Values::Many(many) => many.summary(),
        }
    }
}

/// Deviations of a block, and the pieces of the map that the nearest places lie in.
fn with_feet(
    surface: &Surface,
    map: &PointMap,
    points: &[Point],
    progress: &dyn Progress,
) -> Result<(Vec<f64>, Vec<Option<Foot>>), QueryError> {
    let tree = surface.tree();
    let found = surface.map(points, progress, |i, deviation, hit| {
        let place = hit.filter(|_| deviation.is_finite()).map(|h| tree.place(&points[i], h));
        (deviation, place.map(|p| map.foot(p.face, p.barycentric)))
    })?;
    Ok(found.into_iter().unzip())
}

/// The worst places with their nearest places on the reference.
fn worst(surface: &Surface, mesh: &Mesh, places: &[Place]) -> Result<Vec<WorstPlace>, QueryError> {
    let mut out = vec![];
    for &place in places {
        if let Some(Closest { point, face, barycentric: weights, .. }) =
            surface.tree().closest(&place.point, f64::INFINITY)?
        {
            let [a, b, c] = mesh.faces[face as usize].map(|v| mesh.positions[v as usize]);
            let normal = unit(cross(minus(b, a), minus(c, a))).map(|(n, _)| n);
            out.push(WorstPlace { place, nearest: point, normal, face, weights });
        }
    }
    Ok(out)
}
