//! The running comparison with one reference.

use super::against::{Exact, Reference, ReferenceError};
use super::along::{AlongRule, Lines};
use super::between_vertices::BetweenVertices;
use super::coverage::Coverage;
use super::covered::{CoverageSample, Covered};
use super::excluded::Excluded;
use super::extremes::Extremes;
use super::facing::Facing;
use super::map::{Flagged, Foot, MapSurface, PlaceMeans, PointMap};
use super::options::Options;
use super::outliers::{OutlierLimits, OutlierRule, Outliers};
use super::region::{RegionRule, Regions};
use super::kept::{Asked, Measures};
use super::target::Target;
use super::worst::{WorstPlaces, WorstPoint, sort};
use trueness_document::compare::Method;
use trueness_document::tolerance::badness;
use trueness_geom::check::Precondition;
use trueness_geom::closest::{QueryError, Tree};
use trueness_geom::deviation::paper::{Differences, Paper, PaperError};
use trueness_geom::deviation::sign_choice::SignChoice;
use trueness_geom::deviation::surface::Disagreement;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Progress, Silent};
use trueness_geom::space::{Point, Vector};
use trueness_geom::stats::histogram::{Histogram, Limits, nice_edges, zone_edges};
use trueness_geom::stats::statistics::{Accumulator, Statistics, Summary};

/// What was found about one reference.
pub struct Compared {
    /// Diagonal of the reference's box, millimeters.
    pub diagonal: f64,
    /// Along what lines deviations are; `None` for those to the nearest place.
    pub along: Option<AlongRule>,
    /// How the sign was found.
    pub sign: SignChoice,
    /// How both sign methods agree on a sample; absent for unsigned distances.
    pub disagreement: Option<Disagreement>,
    /// Whether the mesh is sound, and if not, where not.
    pub precondition: Precondition,
    /// Facets of the file that are not in the mesh: their numbers, ascending.
    pub left_out: Vec<u32>,
    /// Statistics of all deviations and of each side.
    pub summary: Summary,
    /// The deviations, or what is left of them when there were too many to keep.
    pub values: Values,
    /// Counts of the deviations between round edges: from the 0.1st to the 99.9th percentile, or near the tolerance zone
    /// where that is much narrower.
    pub histogram: Option<Histogram>,
    /// Counts against the tolerance, where there is one.
    pub limits: Option<Limits>,
    /// Its regions, in the order asked for.
    pub regions: Vec<RegionFound>,
    /// Points that do not count. Reasons that were not asked for are left out.
    pub excluded: Vec<(Excluded, u64)>,
    /// What the rule for outliers gave, where there is one.
    pub outliers: Option<Outliers>,
    /// The lowest and the highest deviation.
    pub extremes: Extremes,
    /// The worst places of both signs, the farthest beyond the tolerance first, without one the greatest.
    pub worst: Vec<WorstPlace>,
    /// The paper's method beside the exact distance.
    pub paper_vs_exact: Option<Differences>,
    /// What is to be said of exact surfaces.
    pub surfaces: Option<SurfacesFound>,
    /// The reference colored by the points near each place, for a report.
    pub map: Option<MapSurface>,
    /// What of the reference the points cover, where it is asked.
    pub covered: Option<Covered>,
    /// Places between the vertices of the measured mesh.
    pub between: BetweenVertices,
    /// Mean deviations at places that are the same for every part, where they are asked for.
    pub places: Option<PlaceMeans>,
}

/// What was found in a region.
pub struct RegionFound {
    /// As asked for.
    pub rule: RegionRule,
    /// Statistics of its points' deviations.
    pub summary: Summary,
    /// Counts against its tolerance.
    pub limits: Limits,
}

/// A region under way.
struct Tally {
    values: Values,
    limits: Limits,
}

/// A measured block that has not been counted yet.
pub struct Taken {
    /// One a point; not finite where it is excluded.
    pub deviations: Vec<f64>,
    feet: Vec<Option<Foot>>,
    regions: Vec<u16>,
}

/// What is to be said of a comparison with exact surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacesFound {
    /// Number of surfaces.
    pub surfaces: usize,
    /// Points whose nearest place is not beyond doubt.
    pub uncertain: u64,
    /// How far the facets that draw them may be from the surfaces, millimeters.
    pub drawn_within: f64,
}

impl SurfacesFound {
    fn of(exact: Exact) -> SurfacesFound {
        let (surfaces, drawn_within) = match exact {
            Exact::Splines(search) => (search.surfaces(), search.mesh_distance()),
            Exact::Cad(faces) => (faces.faces.len(), faces.drawn_within),
        };
        SurfacesFound { surfaces, uncertain: 0, drawn_within }
    }
}

/// One of the worst places, with where it is on the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPlace {
    /// The measured point.
    pub place: WorstPoint,
    /// The nearest place on the reference, or where its line meets it.
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

/// A comparison under way.
pub struct Running<'a> {
    mesh: &'a Mesh,
    left_out: Vec<u32>,
    target: Target<'a>,
    surfaces: Option<SurfacesFound>,
    values: Values,
    keep: usize,
    limits: Option<Limits>,
    excluded: [u64; Excluded::ALL.len()],
    along: Option<AlongRule>,
    facing: Option<Facing>,
    outliers: Option<Outliers>,
    coverage: Coverage,
    regions: Option<Regions>,
    tallies: Vec<Tally>,
    extremes: Extremes,
    worst: WorstPlaces,
    /// Places of each sign that the result names.
    named: usize,
    paper: Option<(Paper, Differences)>,
    map: Option<PointMap>,
    sample: Option<CoverageSample>,
    between: BetweenVertices,
}

impl<'a> Running<'a> {
    /// Nothing measured yet; at most `keep` deviations stay in memory.
    pub fn new(
        reference: &Reference<'a>,
        tree: Option<&'a Tree>,
        options: &Options,
        keep: usize,
        progress: &dyn Progress,
    ) -> Result<Running<'a>, ReferenceError> {
        let mesh = reference.mesh;
        let paper = match options.method {
            Method::Exact => None,
            Method::Paper => Some((Paper::new(mesh)?, Differences::default())),
        };
        let regions = match tree.filter(|_| !options.regions.is_empty()) {
            Some(tree) => Some(Regions::new(&options.regions, mesh, tree, options.seed, progress)?),
            None => None,
        };
        let tally = |rule: &RegionRule| Tally {
            values: Values::All(vec![]),
            limits: Limits::new(rule.tolerance.lower, rule.tolerance.upper),
        };
        Ok(Running {
            tallies: regions.iter().flat_map(Regions::rules).map(tally).collect(),
            target: Target::new(reference, tree, options, progress)?,
            surfaces: reference.exact.map(SurfacesFound::of),
            values: Values::All(vec![]),
            keep,
            limits: options.tolerance.map(|t| Limits::new(t.lower, t.upper)),
            excluded: Default::default(),
            along: options.along.as_ref().map(Lines::rule),
            facing: options.facing.clone(),
            outliers: None,
            coverage: options.coverage.unwrap_or_default(),
            extremes: Extremes::default(),
            worst: WorstPlaces::new(&mesh.bounds()),
            named: options.worst,
            paper,
            map: (options.shown > 0 || options.coverage.is_some() || options.places).then(|| {
                PointMap::new(mesh, options.tolerance.filter(|_| regions.is_none()), options.places)
            }),
            sample: options.tells_coverage().then(CoverageSample::default),
            between: BetweenVertices::default(),
            regions,
            mesh,
            left_out: reference.left_out.0.to_vec(),
        })
    }

    /// So many points will come.
    pub fn expects(&mut self, points: u64) {
        self.sample.iter_mut().for_each(|sample| sample.expects(points));
    }

    /// Measures the next block, whose first point has number `start`; nothing is counted yet.
    pub fn measure(
        &mut self,
        start: u64,
        points: &[Point],
        progress: &dyn Progress,
    ) -> Result<Taken, PaperError> {
        let (map, regions) = (self.map.as_ref().map(|map| (map, self.mesh)), self.regions.as_ref());
        let sample = self.sample.as_ref();
        let asked = Asked { start, map, sample, facing: self.facing.as_ref(), regions };
        let Measures { mut deviations, feet, regions, uncertain } =
            self.target.measure(points, &asked, progress)?;
        if let Some(surfaces) = &mut self.surfaces {
            surfaces.uncertain += uncertain;
        }
        if let Some((paper, versus)) = &mut self.paper {
            let theirs = paper.values(points, progress)?;
            let size = |d: &f64| if d.is_finite() { d.abs() } else { f64::NAN };
            versus.push(&theirs, &deviations.iter().map(size).collect::<Vec<f64>>());
            // The paper has no sign: its distances get the exact method's.
            for (d, t) in deviations.iter_mut().zip(theirs).filter(|(d, _)| d.is_finite()) {
                *d = t.distance.copysign(*d);
            }
        }
        Ok(Taken { deviations, feet, regions })
    }

    /// Finds the limits of a rule for outliers from all blocks. They hold for all that is counted afterwards.
    pub fn judge<'t>(&mut self, rule: OutlierRule, blocks: impl Iterator<Item = &'t Taken>) {
        let mut values = Values::All(vec![]);
        blocks.for_each(|taken| values.push(&taken.deviations, self.keep));
        self.outliers = Some(Outliers { rule, limits: rule.limits(&values.summary().all) });
    }

    /// Counts a block whose first point has number `start`, once for all. Outliers among its deviations become values that say
    /// so; where there are limits for them, the deviations as they were come back.
    pub fn count(&mut self, start: u64, points: &[Point], taken: &mut Taken) -> Option<Vec<f64>> {
        let measured = self.limits_of_outliers().map(|_| taken.deviations.clone());
        taken.deviations.iter_mut().for_each(|d| *d = self.judged(*d));
        let deviations = &taken.deviations;
        for e in deviations.iter().filter_map(|&d| Excluded::of(d)) {
            self.excluded[e as usize - 1] += 1;
        }
        // What does not count here, as all that is not finite.
        let of = |region: u16| -> Vec<f64> {
            let own = |(i, d): (usize, &f64)| {
                let here = taken.regions.get(i).copied().unwrap_or(0) == region;
                if here && d.is_finite() { *d } else { f64::NAN }
            };
            deviations.iter().enumerate().map(own).collect()
        };
        if let Some(limits) = &mut self.limits {
            limits.push(&of(0));
        }
        for (region, tally) in (1..).zip(&mut self.tallies) {
            let own: Vec<f64> = of(region).into_iter().filter(|d| !d.is_nan()).collect();
            tally.limits.push(&own);
            tally.values.push(&own, self.keep);
        }
        for ((foot, deviation), index) in taken.feet.iter().zip(deviations).zip(start..) {
            let Some(foot) = foot.filter(|_| deviation.is_finite()) else { continue };
            if let Some(map) = &mut self.map {
                map.add(foot, *deviation);
            }
            if let Some(sample) = &mut self.sample {
                sample.add(index, foot);
            }
        }
        let zone = |region: u16| zone(self.regions.as_ref(), self.limits.as_ref(), region);
        let judged = |i: usize| match taken.regions.get(i) {
            Some(region) => (badness(deviations[i], zone(*region)), *region),
            _ => (deviations[i].abs(), 0),
        };
        self.worst.add(start, points, deviations, judged);
        self.extremes.add(start, points, deviations);
        self.values.push(deviations, self.keep);
        measured
    }

    /// Adds places of the measured mesh between its vertices, the first with number `start`: to the map, and to what a verdict must know,
    /// but to no statistics. The paper's method knows vertices only.
    pub fn between(
        &mut self,
        start: u64,
        places: &[Point],
        progress: &dyn Progress,
    ) -> Result<(), PaperError> {
        let asked_for = self.map.is_some() || self.sample.is_some();
        if !asked_for || self.paper.is_some() || places.is_empty() {
            return Ok(());
        }
        let map = self.map.as_ref().map(|map| (map, self.mesh));
        // All of them: they are few.
        let all = CoverageSample::default();
        let asked = Asked {
            start,
            map,
            sample: Some(&all),
            facing: self.facing.as_ref(),
            regions: self.regions.as_ref(),
        };
        let found = self.target.measure(places, &asked, progress)?;
        for (i, (foot, deviation)) in found.feet.into_iter().zip(found.deviations).enumerate() {
            let deviation = self.judged(deviation);
            let Some(foot) = foot.filter(|_| deviation.is_finite()) else { continue };
            if let Some(map) = &mut self.map {
                map.add(foot, deviation);
            }
            if let Some(sample) = &mut self.sample {
                sample.add_between(foot);
            }
            let region = found.regions.get(i).copied().unwrap_or(0);
            let zone = zone(self.regions.as_ref(), self.limits.as_ref(), region);
            self.between.add(places[i], deviation, zone);
        }
        Ok(())
    }

    fn limits_of_outliers(&self) -> Option<OutlierLimits> {
        self.outliers.and_then(|o| o.limits.ok())
    }

    /// The deviation, or the value that stands for an outlier.
    fn judged(&self, deviation: f64) -> f64 {
        let out = |l: OutlierLimits| deviation < l.lower || deviation > l.upper;
        let outlier = deviation.is_finite() && self.limits_of_outliers().is_some_and(out);
        if outlier { Excluded::Outlier.value() } else { deviation }
    }

    /// The places that the result will name.
    pub fn worst_places(&self) -> Vec<WorstPoint> {
        let mut places: Vec<WorstPoint> = self.worst.pick(self.named).into_iter().flatten().collect();
        match self.regions {
            Some(_) => places.sort_by(|a, b| b.badness.total_cmp(&a.badness).then(a.index.cmp(&b.index))),
            None => sort(&mut places, self.limits.as_ref().map(|l| [l.lower, l.upper])),
        }
        places
    }

    /// Deviations of points that have been counted already.
    pub fn again(&self, places: &[WorstPoint]) -> Result<Vec<f64>, PaperError> {
        let one = |place: &WorstPoint| {
            let asked = Asked {
                start: place.index,
                map: None,
                sample: None,
                facing: self.facing.as_ref(),
                regions: None,
            };
            let points = [place.point];
            let mut deviation = self.target.measure(&points, &asked, &Silent)?.deviations[0];
            if let Some((paper, _)) = self.paper.as_ref().filter(|_| deviation.is_finite()) {
                deviation = paper.values(&points, &Silent)?[0].distance.copysign(deviation);
            }
            Ok(self.judged(deviation))
        };
        places.iter().map(one).collect()
    }

    /// The end of the points; `sample` is an even sample of them.
    pub fn finish(self, sample: &[Point], progress: &dyn Progress) -> Result<Compared, QueryError> {
        let choice = *self.target.sign();
        let summary = self.values.summary();
        let worst = worst(&self.target, &self.worst_places())?;
        let flag =
            |w: &WorstPlace| Flagged { face: w.face, weights: w.weights, deviation: w.place.deviation };
        let flagged: Vec<Flagged> = worst.iter().map(flag).collect();
        let mut map = self.map;
        let places = map.as_mut().and_then(PointMap::take_places);
        let map = map.map(|map| MapSurface::of(self.mesh, &map, &flagged, self.coverage));
        // Whether a map is drawn, and what is flagged in it, must not change what is covered.
        let covered = self.sample.map(|sample| Covered::of(&sample.surface(self.mesh, self.coverage)));
        Ok(Compared {
            places: places.zip(map.as_ref()).map(|(places, map)| places.means(map.carried)),
            diagonal: self.mesh.bounds().diagonal(),
            histogram: self.values.histogram(&summary.all, self.limits.as_ref()),
            limits: self.limits,
            along: self.along,
            sign: choice,
            disagreement: self.target.disagreement(sample, progress)?,
            precondition: self.target.precondition().clone(),
            left_out: self.left_out,
            summary,
            extremes: self.extremes,
            worst,
            regions: (self.regions.iter().flat_map(Regions::rules).zip(self.tallies))
                .map(|(rule, tally)| RegionFound {
                    rule: rule.clone(),
                    summary: tally.values.summary(),
                    limits: tally.limits,
                })
                .collect(),
            values: self.values,
            excluded: Excluded::ALL
                .into_iter()
                .filter(|e| match e {
                    Excluded::MaxDistance | Excluded::BoundaryEdge => true,
                    Excluded::Facing => self.facing.is_some(),
                    Excluded::Outlier => self.outliers.is_some(),
                    Excluded::NoCrossing => self.along.is_some(),
                    Excluded::NoDirection => self.along.is_some_and(|a| a.name() != "direction"),
                })
                .map(|e| (e, self.excluded[e as usize - 1]))
                .collect(),
            outliers: self.outliers,
            paper_vs_exact: self.paper.map(|(_, versus)| versus),
            surfaces: self.surfaces,
            between: self.between,
            covered,
            map,
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

/// What deviations may be in this region, 0 for none; nothing where all may be.
fn zone(regions: Option<&Regions>, limits: Option<&Limits>, region: u16) -> Option<[f64; 2]> {
    let own = regions.and_then(|regions| regions.zone(region)).map(|t| [t.lower, t.upper]);
    own.or_else(|| limits.map(|l| [l.lower, l.upper]))
}

/// The worst places with their nearest places on the reference.
fn worst(target: &Target, places: &[WorstPoint]) -> Result<Vec<WorstPlace>, QueryError> {
    let mut out = vec![];
    for &place in places {
        if let Some(found) = target.nearest(&place)? {
            out.push(WorstPlace {
                place,
                nearest: found.place,
                normal: found.normal,
                face: found.face,
                weights: found.weights,
            });
        }
    }
    Ok(out)
}
