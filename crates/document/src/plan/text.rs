//! The plan as its author writes it: TOML, `trueness/plan/1`. Every value that can be wrong knows its place.

use super::at::At;
use super::words::{
    DatumMethodWord, FormMethodWord, KindWord, MaterialWord, NoiseText, OffsetText, RuleWord, RunoutWord,
    SizeWord, TextureWord,
};
use schemars::JsonSchema;
use serde::Deserialize;

/// The whole plan. Paths are relative to the plan, lengths in `units`, angles in degrees.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlanText {
    /// `trueness/plan/1`.
    pub schema: At<String>,
    /// Heading of tables and reports.
    pub title: Option<String>,
    /// Unit of the plan's lengths and of files that do not say their own: mm, cm, m, in, um. Without it: mm.
    pub units: Option<At<UnitWord>>,
    /// The measured mesh or cloud.
    pub measured: Option<At<String>>,
    /// The nominal mesh.
    pub reference: Option<At<String>>,
    /// How the measured data come to lie on the reference. Without it they are taken as they are.
    pub align: Option<AlignText>,
    /// Deviations of all that was measured from the reference.
    pub deviation: Option<At<DeviationText>>,
    /// The features.
    #[serde(default)]
    pub feature: Vec<At<FeatureText>>,
    /// The characteristics.
    #[serde(default)]
    pub characteristic: Vec<At<CharacteristicText>>,
    /// How a verdict is reached.
    pub decision: Option<DecisionText>,
}

/// A unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UnitWord {
    /// Millimeter.
    Mm,
    /// Centimeter.
    Cm,
    /// Meter.
    M,
    /// Inch, 25.4 mm.
    In,
    /// Micrometer.
    Um,
}

impl UnitWord {
    /// Millimeters in one of it.
    pub fn millimeters(self) -> f64 {
        match self {
            UnitWord::Mm => 1.0,
            UnitWord::Cm => 10.0,
            UnitWord::M => 1000.0,
            UnitWord::In => 25.4,
            UnitWord::Um => 0.001,
        }
    }
    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            UnitWord::Mm => "mm",
            UnitWord::Cm => "cm",
            UnitWord::M => "m",
            UnitWord::In => "in",
            UnitWord::Um => "um",
        }
    }
}

/// How the measured data come to lie on the reference.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AlignText {
    /// The way.
    pub method: At<AlignWord>,
    /// With `given`: four rows of four numbers that take measured coordinates to those of the reference. With `datum` and
    /// `rps`: where to start.
    pub transform: Option<At<Vec<Vec<f64>>>>,
    /// With `datum`: features with a nominal, the first one first, that hold all six degrees of freedom.
    pub datums: Option<At<Vec<At<String>>>>,
    /// With `datum`: how they are associated.
    pub datum_method: Option<At<DatumMethodWord>>,
    /// With `pairs`: places that belong together, at least three. With `rps`: held across directions, at least six.
    pub points: Option<At<Vec<PairText>>>,
}

/// A measured place and where it belongs.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairText {
    /// As measured.
    pub measured: At<[f64; 3]>,
    /// Where it belongs.
    pub nominal: At<[f64; 3]>,
    /// With `rps`: the direction in which it is held there.
    pub direction: Option<At<[f64; 3]>>,
    /// Its weight; without it 1.
    pub weight: Option<At<f64>>,
}

/// Ways of alignment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum AlignWord {
    /// As measured.
    None,
    /// By the matrix of the plan.
    Given,
    /// The best fit onto the reference.
    BestFit,
    /// The least greatest distance from the reference, near the best fit.
    Chebyshev,
    /// The least greatest excess over the tolerances of `[deviation]`, near the best fit.
    Zones,
    /// By datum features.
    Datum,
    /// By reference points.
    Rps,
    /// By pairs of points.
    Pairs,
}

/// Deviations of all that was measured from the reference: of the vertices of a mesh, or of the points.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeviationText {
    /// Least and greatest allowed deviation, + out of the material, or one number for as much to either side. Without it nothing is judged.
    pub tolerance: Option<At<ZoneText>>,
    /// Share of the points that must keep the tolerance, percent. Without it: 100.
    pub inside: Option<At<f64>>,
    /// Points farther from the reference than this are left out and counted.
    pub max_distance: Option<At<f64>>,
    /// Whether points whose nearest place is a boundary edge of the reference are left out and counted.
    #[serde(default)]
    pub skip_boundary: bool,
    /// Measures along lines instead of to the nearest place: a direction, or the normals of the `reference` or of the `measured`.
    pub along: Option<At<AlongText>>,
    /// Points whose normals turn away from the reference's by more than this are left out and counted, degrees.
    pub facing: Option<At<f64>>,
    /// Outliers by this rule are left out and counted: `mad:5` or `3sigma`.
    pub outliers: Option<At<String>>,
    /// Tells what part of the reference no point covers within this reach: `auto` or a length.
    pub coverage: Option<At<CoverageText>>,
    /// Share of the reference that the points must cover for a pass, percent. Without it: 90. 0 where a part of it is measured on purpose.
    pub min_coverage: Option<At<f64>>,
    /// Parts of the reference with tolerances of their own; the first that has the place of a point on the reference judges it.
    #[serde(default)]
    pub region: Vec<At<RegionText>>,
}

/// Regions in a file of their own, for a comparison. Lengths in millimeters.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegionsText {
    /// The regions.
    #[serde(default)]
    pub region: Vec<At<RegionText>>,
}

/// A part of the reference with a tolerance of its own; one of `seed`, `between` and `feature` says which.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegionText {
    /// Its name.
    pub id: At<String>,
    /// A place on a plane, cylinder, cone or sphere of the reference: that is the region.
    pub seed: Option<At<[f64; 3]>>,
    /// Two opposite corners: what lies between them is the region.
    pub between: Option<At<[[f64; 3]; 2]>>,
    /// A feature of the plan with a nominal or a seed: the facets of the reference that belong to it are the region.
    pub feature: Option<At<String>>,
    /// Least and greatest allowed deviation, or one number for as much to either side.
    pub tolerance: At<ZoneText>,
    /// Share of its points that must keep it, percent. Without it: 100.
    pub inside: Option<At<f64>>,
}

/// What a deviation may be.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "the tolerance is [least, greatest] allowed deviation, as in [-0.1, 0.1], or one number for as much to either side"
)]
pub enum ZoneText {
    /// As much to either side.
    Even(f64),
    /// From and to.
    Between([f64; 2]),
}

/// What is measured along.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "`along` is a direction, as in [0, 0, 1], or \"reference\" or \"measured\"")]
pub enum AlongText {
    /// A direction, in the coordinates of the reference.
    Direction([f64; 3]),
    /// `reference` or `measured`.
    Word(String),
}

/// A reach along the reference.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "`coverage` is \"auto\" or a length")]
pub enum CoverageText {
    /// A length.
    Reach(f64),
    /// `auto`.
    Word(String),
}

impl AlignWord {
    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            AlignWord::None => "none",
            AlignWord::Given => "given",
            AlignWord::BestFit => "best-fit",
            AlignWord::Chebyshev => "chebyshev",
            AlignWord::Zones => "zones",
            AlignWord::Datum => "datum",
            AlignWord::Rps => "rps",
            AlignWord::Pairs => "pairs",
        }
    }
}

/// A feature: where its points come from, and what it is.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FeatureText {
    /// Its name, for datums and characteristics.
    pub id: At<String>,
    /// What it is; not for derived features.
    pub shape: Option<At<ShapeWord>>,
    /// File of its own measured points.
    pub points: Option<At<String>>,
    /// The feature as the model has it; its points are sought there in the measured data, unless `points` gives them.
    pub nominal: Option<At<NominalText>>,
    /// A place on the feature of the reference: the region around it is sought in the measured data.
    pub seed: Option<At<[f64; 3]>>,
    /// Faces of the reference, a CAD model, by the numbers of their entities in the file: they are the feature.
    pub face: Option<At<FaceText>>,
    /// The same by the name that the file gives the faces.
    pub name: Option<At<String>>,
    /// The instance that the faces are of, where several have them: the names on the way from the root of the assembly, joined by `/`.
    pub instance: Option<At<String>>,
    /// How near measured facets must be to the nominal feature.
    pub extract: Option<ExtractText>,
    /// How the element is associated: gaussian (without it), minimum-zone, minimum-circumscribed, maximum-inscribed, robust.
    pub method: Option<At<MethodWord>>,
    /// Of a cylinder: whether the material is around it, as of a bore, or within, as of a shaft.
    pub internal: Option<At<bool>>,
    /// Of a plane of measured points: a direction out of the material.
    pub outward: Option<At<[f64; 3]>>,
    /// A feature made of others.
    pub derived: Option<At<DerivedWord>>,
    /// Those that a derived feature is made of.
    pub of: Option<At<Vec<At<String>>>>,
}

/// Numbers of faces.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "`face` is the number of a face of the reference, as in 12, or several, as in [12, 13]")]
pub enum FaceText {
    /// One.
    One(u64),
    /// Several that are one surface.
    Several(Vec<u64>),
}

/// Shapes of features.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ShapeWord {
    /// A place: the mean of its points.
    Point,
    /// A line in space, or of points of two columns in the plane: an axis, an extracted median line.
    Line,
    /// A plane.
    Plane,
    /// A circle in space: one section of something round.
    Circle,
    /// A sphere.
    Sphere,
    /// A cylinder.
    Cylinder,
    /// A cone.
    Cone,
    /// A torus.
    Torus,
    /// An edge where two planes meet.
    Edge,
    /// A surface of any form, as the reference has it: known, but refused, as `inspect` cannot take it yet.
    Surface,
}

/// How an element is associated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MethodWord {
    /// Least squares.
    Gaussian,
    /// The narrowest zone.
    MinimumZone,
    /// The smallest around all points.
    MinimumCircumscribed,
    /// The largest within the points.
    MaximumInscribed,
    /// Outliers do not count.
    Robust,
}

/// Features made of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DerivedWord {
    /// Half way between two planes.
    MedianPlane,
    /// Line of two planes, or point of a line and a plane.
    Intersection,
    /// Half way between two points or centers.
    Midpoint,
    /// A point or center, projected onto a plane.
    Projection,
}

/// A feature as the model has it. Which keys it needs depends on the shape.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NominalText {
    /// A point of a plane; start of the axis of a cylinder or of an edge.
    pub point: Option<[f64; 3]>,
    /// Normal of a plane, out of the material.
    pub normal: Option<[f64; 3]>,
    /// Direction of an axis or edge.
    pub direction: Option<[f64; 3]>,
    /// Corners of a plane's boundary, in order.
    pub boundary: Option<Vec<[f64; 3]>>,
    /// Radius of a cylinder or sphere.
    pub radius: Option<f64>,
    /// Length of a cylinder or edge.
    pub length: Option<f64>,
    /// Center of a sphere.
    pub center: Option<[f64; 3]>,
    /// Tip of a cone; `direction` points from it into the cone.
    pub apex: Option<[f64; 3]>,
    /// Angle between a cone's axis and surface, degrees.
    pub half_angle: Option<f64>,
    /// Where a cone begins and ends along its axis, from the tip.
    pub between: Option<[f64; 2]>,
    /// Normals of the two planes that meet in an edge, out of the material.
    pub normals: Option<[[f64; 3]; 2]>,
}

/// How near measured facets must be to the nominal feature.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExtractText {
    /// Greatest distance from the nominal surface.
    pub distance: Option<At<f64>>,
    /// Greatest angle between the normals, degrees.
    pub angle: Option<At<f64>>,
    /// What is left out along the bounds of the feature; below 0, how far it may reach beyond them (without it, `distance`).
    pub margin: Option<At<f64>>,
    /// Whether vertices that other facets share count (without it they do): on a sharp edge they belong to both surfaces.
    pub rim: Option<bool>,
    /// Whether outliers count (without it they do not): points of a scan that stick out with no more than two together.
    pub outliers: Option<bool>,
    /// Least share of the nominal area that must have been measured, 0 to 1.
    pub coverage: Option<At<f64>>,
}

/// One feature or two.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "`feature` is the id of a feature, or two of a size, as in [\"A\", \"B\"]; ids are in quotes"
)]
pub enum OneOrTwo {
    /// One.
    One(String),
    /// Several.
    Two(Vec<String>),
}

/// A characteristic: what is measured, and what is allowed.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CharacteristicText {
    /// Its name in results.
    pub id: At<String>,
    /// What it is.
    pub kind: At<KindWord>,
    /// The feature that is toleranced; for the size of two parallel planes, both.
    pub feature: At<OneOrTwo>,
    /// Width or diameter of the zone; greatest allowed value.
    pub tolerance: Option<At<f64>>,
    /// Tolerance class by letters, in place of the limits: of a size by ISO 286-2 (`H7`, `js9`), of a size, distance or angle
    /// by ISO 2768-1 (`f`, `m`, `c`, `v`), of a form or attitude by ISO 2768-2 (`H`, `K`, `L`).
    pub class: Option<At<String>>,
    /// Nominal length that the class goes by: of a flat or straight feature its (longer) side, of a perpendicular one its
    /// shorter side, of an angle the shorter leg, of a symmetric one the feature's length.
    pub length: Option<At<f64>>,
    /// Maximum (`M`) or least (`L`) material requirement on the tolerance of a feature of size.
    pub material: Option<At<MaterialWord>>,
    /// The datums, the first one first. `A-B` is a common datum of two features; `A(M)` and `A(L)` have the maximum and the
    /// least material requirement.
    pub datums: Option<At<Vec<At<String>>>>,
    /// How datums are associated: gaussian (without it) or minimum-zone.
    pub datum_method: Option<At<DatumMethodWord>>,
    /// The datum system, given as a frame in measured coordinates instead of datums.
    pub frame: Option<At<FrameText>>,
    /// Theoretically exact coordinates in the datum system, or the angle in degrees.
    pub basic: Option<At<BasicText>>,
    /// Where the zone of a profile lies: by this length out of the material (UZ), or `free`, where it is narrowest (OZ); without it
    /// evenly about the theoretically exact geometry.
    pub offset: Option<At<OffsetText>>,
    /// Of a line profile: the normal of the planes that its lines lie in.
    pub intersection: Option<At<[f64; 3]>>,
    /// Whether the zone is a cylinder or sphere (with the sign ∅).
    pub diametral: Option<At<bool>>,
    /// Of a form: minimum-zone (without it) or gaussian.
    pub method: Option<At<FormMethodWord>>,
    /// Of a size: which one by ISO 14405-1.
    pub size: Option<At<SizeWord>>,
    /// Nominal value of a size, distance or angle.
    pub nominal: Option<At<f64>>,
    /// Upper limit deviation.
    pub upper: Option<At<f64>>,
    /// Lower limit deviation.
    pub lower: Option<At<f64>>,
    /// Of a run-out: radial (without it) or axial.
    pub direction: Option<At<RunoutWord>>,
    /// Of a texture: which parameter.
    pub parameter: Option<At<TextureWord>>,
    /// Expanded uncertainty (k = 2) of this characteristic's value.
    pub uncertainty: Option<At<f64>>,
}

/// A frame in measured coordinates.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrameText {
    /// Its origin.
    pub origin: [f64; 3],
    /// Direction of x.
    pub x: [f64; 3],
    /// Direction of z.
    pub z: [f64; 3],
}

/// Theoretically exact dimensions.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BasicText {
    /// Coordinate along x.
    pub x: Option<f64>,
    /// Coordinate along y.
    pub y: Option<f64>,
    /// Coordinate along z.
    pub z: Option<f64>,
    /// Angle in degrees.
    pub angle: Option<f64>,
    /// Angle about the first datum from the direction that the second datum gives, degrees; without it along or across.
    pub turn: Option<f64>,
}

/// How a verdict is reached.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DecisionText {
    /// The rule.
    pub rule: At<RuleWord>,
    /// Expanded uncertainty (k = 2) of every value that has none of its own.
    pub uncertainty: Option<At<f64>>,
    /// Standard deviation of each coordinate of a measured point, or "measured": found in what was measured. With it the uncertainty of each value is
    /// found by moving the points.
    pub noise: Option<At<NoiseText>>,
    /// Length within which the noise of points moves them together. Without it each point moves alone.
    pub correlation: Option<At<f64>>,
    /// How often the points are moved. Without it: 200.
    pub draws: Option<At<u32>>,
}
