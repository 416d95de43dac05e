//! What is asked of a comparison.

use super::along::Lines;
use super::coverage::Coverage;
use super::facing::Facing;
use super::map::Between;
use super::outliers::OutlierRule;
use super::region::RegionRule;
use trueness_document::compare::Method;
use trueness_document::tolerance::Tolerance;
use trueness_geom::deviation::surface::SurfaceOptions;

/// Share of a reference that a scan of the whole part covers at least, where nothing else is said. Scans
/// that are taken for whole ones cover 96 to 100 %, what shows a part from one side covers about half.
pub const MIN_COVERAGE: f64 = 0.9;
/// Places of each sign that a result names unless more are asked for: as many as flags beside a part can be read.
const DEFAULT_WORST_PLACES: usize = 3;

/// What is asked.
#[derive(Clone, Debug)]
pub struct Options {
    /// How distances are computed.
    pub method: Method,
    /// Sign and exclusions.
    pub surface: SurfaceOptions,
    /// Along what line deviations are measured; to the nearest place without one.
    pub along: Option<Lines>,
    /// Only points whose normals agree with the reference's.
    pub facing: Option<Facing>,
    /// Which points are outliers; none without a rule.
    pub outliers: Option<OutlierRule>,
    /// Which part of the references the points cover; with a report and where a verdict is asked for it is looked for in any case.
    pub coverage: Option<Coverage>,
    /// Share of each reference that the points must cover for a pass (0 to 1); 0 where a part of it is measured on purpose.
    pub min_coverage: f64,
    /// Places of a measured mesh between its vertices, for the maps; the normals of [`Facing`] and [`Lines`], where there are such, are
    /// those of the points and then those of these.
    pub between: Between,
    /// Whether mean deviations are kept at places of the references that are the same for every part.
    pub places: bool,
    /// Parts of the references with tolerances of their own, the first that has a place counts.
    pub regions: Vec<RegionRule>,
    /// The zone that deviations must keep; those of no region, where there are regions.
    pub tolerance: Option<Tolerance>,
    /// Share of the points that must lie within it (0 to 1).
    pub required_share: f64,
    /// Points that a report can show; 0 without a report.
    pub shown: usize,
    /// Worst places that the result names, at most so many above the reference and so many below.
    pub worst: usize,
    /// Deviations kept in memory for exact percentiles, of all references together; beyond, percentiles come from
    /// a sketch with a stated error.
    pub kept_values: usize,
    /// Whether the errors of the points are independent, as of points probed one by one: else paired differences take into account how far those of
    /// neighbors go together.
    pub independent: bool,
    /// Intervals, tests and models.
    pub research: bool,
    /// Seed of everything random.
    pub seed: u64,
}

impl Options {
    /// Whether a verdict is asked for.
    pub fn judges(&self) -> bool {
        self.tolerance.is_some() || !self.regions.is_empty()
    }

    /// Whether it is told what the points cover.
    pub fn tells_coverage(&self) -> bool {
        self.judges() || self.coverage.is_some() || self.shown > 0
    }
}

impl Default for Options {
    fn default() -> Self {
        Options {
            method: Method::Exact,
            surface: SurfaceOptions::default(),
            along: None,
            facing: None,
            outliers: None,
            coverage: None,
            min_coverage: MIN_COVERAGE,
            between: Between::default(),
            places: false,
            regions: vec![],
            tolerance: None,
            required_share: 1.0,
            shown: 0,
            worst: DEFAULT_WORST_PLACES,
            kept_values: 1 << 27,
            independent: false,
            research: false,
            seed: 0,
        }
    }
}
