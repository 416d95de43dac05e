//! Why something was not measured. Documents hold the sentences; they stand here and nowhere else.

use std::fmt;
use trueness_geom::fit::FitError;
use trueness_geom::shape::Kind;
use trueness_geom::zone::ZoneError;
use trueness_geom::zone::datum::DatumError;

/// Why a feature has no element.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoElement {
    /// There are no measured data in which it could be sought.
    #[error("it was not measured")]
    NotSought,
    /// Its own file is empty.
    #[error("its file has no points")]
    EmptyFile,
    /// No measured point is of it.
    #[error("nothing was measured where the model has it{}", if *.has_margin { ", or its margin leaves nothing of it" } else { "" })]
    NotThere {
        /// Whether its borders are left out.
        has_margin: bool,
    },
    /// The scan rounds its edges over its whole width.
    #[error(
        "all of its points ({points}) lie on edges, as far as the scan rounds these; measure it more densely"
    )]
    OnRoundedEdges {
        /// Its points.
        points: usize,
    },
    /// Facets of it were measured, but no vertex that is not shared with others.
    #[error("all of its vertices lie on edges, which rim = false leaves out")]
    OnRim,
    /// Less of it was measured than the plan asks for.
    #[error("only {:.1} % of its nominal area was measured, less than {:.1} %", 100.0 * .share, 100.0 * .required)]
    Coverage {
        /// Share of its nominal area.
        share: f64,
        /// Least share.
        required: f64,
    },
    /// The element through its points is another one than the nominal.
    #[error(
        "the {} through its points lies at {:.0}° to the nominal one: they do not determine it; measure more of its surface",
        .kind.name(), .angle.to_degrees()
    )]
    Turned {
        /// What was fitted.
        kind: Kind,
        /// Its angle to the nominal, radians.
        angle: f64,
    },
    /// Its points have no such element.
    #[error(transparent)]
    Fit(FitError),
    /// A feature that it is made of has none.
    #[error("feature \"{id}\": {reason}")]
    Source {
        /// That feature.
        id: String,
        /// Why it has none.
        reason: Box<NoElement>,
    },
    /// A feature that it is made of has no direction.
    #[error("feature \"{id}\" has no plane or axis")]
    SourceWithoutAxis {
        /// That feature.
        id: String,
    },
    /// A feature that it is made of has no center.
    #[error("feature \"{id}\" has no center")]
    SourceWithoutCenter {
        /// That feature.
        id: String,
    },
    /// No plane lies half way between two planes that stand upright on each other.
    #[error("its two planes are perpendicular to each other")]
    Perpendicular,
    /// What is parallel does not meet.
    #[error("its two features are parallel")]
    Parallel,
    /// Points lie over its place, farther off than it is sought.
    #[error("{reason}{beyond}")]
    Beyond {
        /// Why it has none.
        reason: Box<NoElement>,
        /// What lies there.
        beyond: PointsBeyond,
    },
}

/// Points over the place of a feature, farther off than it is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointsBeyond {
    /// Their number.
    pub count: usize,
    /// Distance of the nearest from the nominal surface, mm.
    pub nearest: f64,
    /// Distance of the farthest, mm.
    pub farthest: f64,
    /// Distance up to which the feature is sought, mm.
    pub limit: f64,
}

impl fmt::Display for PointsBeyond {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let PointsBeyond { count, nearest, farthest, limit } = self;
        let points = if *count == 1 { "point lies" } else { "points lie" };
        write!(
            f,
            "; {count} {points} {nearest:.3} to {farthest:.3} mm off its place, farther than the `distance` of {limit:.3} mm in its \
             `extract`: a larger one judges them"
        )
    }
}

/// What a feature lacks for a value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Lack {
    /// An element.
    #[error(transparent)]
    Element(NoElement),
    /// Another element than its own.
    #[error(transparent)]
    Fit(FitError),
    /// Points.
    #[error("it has no points of its own")]
    Points,
    /// An element that was fitted.
    #[error("it has no fitted element")]
    FittedElement,
    /// A plane of its points.
    #[error("its points lie in no plane")]
    Plane,
    /// A center.
    #[error("it has no center")]
    Center,
    /// Ends.
    #[error("it is derived and has no extent")]
    Extent,
    /// An axis.
    #[error("it has no axis")]
    Axis,
    /// A direction.
    #[error("it has no direction")]
    Direction,
    /// Sections for a median line.
    #[error("{found} of its sections go around the axis with enough points; a median line needs 3")]
    Sections {
        /// Those that it has.
        found: usize,
    },
}

/// Why the data give no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotMeasured {
    /// A feature lacks what it needs.
    #[error("feature \"{id}\": {lack}")]
    Feature {
        /// The feature.
        id: String,
        /// What it lacks.
        lack: Lack,
    },
    /// No element fits.
    #[error(transparent)]
    Fit(FitError),
    /// There is no zone.
    #[error(transparent)]
    Zone(ZoneError),
    /// There is no datum system.
    #[error(transparent)]
    Datum(DatumError),
    /// There is none, but a frame that the plan gives would do.
    #[error(
        "{0}; in place of `datums` give the frame that they make by numbers, in the coordinates of the aligned data, as in \
         frame = {{ origin = [0, 0, 0], x = [1, 0, 0], z = [0, 0, 1] }}"
    )]
    DatumOrFrame(DatumError),
    /// Nothing has a number.
    #[error("it has no points with finite coordinates")]
    NotFinite,
    /// The arithmetic gave no number.
    #[error("the value is not a finite number")]
    NoNumber,
    /// A texture without points.
    #[error("there are no heights")]
    NoHeights,
    /// A texture without texture.
    #[error("the surface has no height at all")]
    Flat,
    /// A size of what has none.
    #[error("the element has no diameter")]
    NoDiameter,
    /// An element without an axis.
    #[error("the element has no axis")]
    NoAxis,
    /// A feature without a direction.
    #[error("it has no direction")]
    NoDirection,
    /// A two-point size without pairs.
    #[error("no place of it has a measured place opposite")]
    NoOppositePlace,
    /// A datum without a center.
    #[error("the datum has no center")]
    NoDatumCenter,
    /// No section has enough points.
    #[error("no section has {needed} points or more")]
    NoSection {
        /// Points that would do.
        needed: usize,
    },
    /// A datum feature that no gauge receives.
    #[error("datum feature \"{id}\" is {by:.6} mm beyond its virtual condition: it fits no gauge")]
    BeyondVirtualCondition {
        /// The feature.
        id: String,
        /// How far, mm.
        by: f64,
    },
    /// A boundary in another place than along z.
    #[error("a material requirement is evaluated for an axis along z, placed by x and y")]
    NotAlongZ,
    /// A coordinate that does not place an axis.
    #[error(
        "its axis runs along {along} in the datum system, which places nothing: basic = {{ {} = …, {} = … }} places it",
        .across[0], .across[1]
    )]
    AlongCoordinate {
        /// The coordinate along the axis.
        along: &'static str,
        /// Those that would place it.
        across: [&'static str; 2],
    },
}

/// Why the plan asks for what cannot be, as the data show.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Impossible {
    /// The datums make no system.
    #[error(transparent)]
    Datum(DatumError),
    /// There is no datum.
    #[error("it has no datum")]
    NoDatum,
    /// The datum must be an axis.
    #[error("the datum is no axis")]
    DatumIsNoAxis,
    /// The datum must be a plane.
    #[error("the datum is no plane")]
    DatumIsNoPlane,
    /// The datum must have a direction.
    #[error("the datum gives no direction")]
    DatumWithoutDirection,
    /// A center has no angle.
    #[error("a center gives no direction")]
    CenterWithoutDirection,
    /// A profile of nothing.
    #[error("the feature has no theoretically exact surface")]
    NoExactSurface,
    /// A boundary without a requirement.
    #[error("it has no material requirement")]
    NoMaterial,
    /// Lines of a surface without planes.
    #[error("it has no intersection planes")]
    NoIntersectionPlanes,
    /// Planes without a direction.
    #[error("the intersection planes have no normal")]
    PlanesWithoutNormal,
    /// A coordinate that does not place a plane.
    #[error(
        "its plane lies across {across} in the datum system, not across {given}: basic = {{ {across} = … }} places it"
    )]
    PlaneAcross {
        /// The coordinate along its normal.
        across: &'static str,
        /// The one that the plan gives.
        given: &'static str,
    },
    /// The datums leave the place open.
    #[error("its datums leave shifts along {along} free: name a datum that holds them")]
    FreeShift {
        /// The coordinate that is open.
        along: &'static str,
    },
    /// The direction is none of a drawing.
    #[error(
        "seen along the first datum the feature stands at {degrees:.3}° to the direction of the second, not as \
         drawn; angularity takes that angle: basic = {{ angle, turn }}"
    )]
    NotAsDrawn {
        /// The angle.
        degrees: f64,
    },
}
