//! The offers, and the rule by which they are made.

use trueness_geom::num::special::{normal_p, student_p};

/// The kind of an offer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum OfferKind {
    /// A line runs along the first axis.
    Horizontal,
    /// A line runs along the second axis.
    Vertical,
    /// Two lines have one direction.
    Parallel,
    /// A line lies on another.
    InLine,
    /// Two lines of a contour, one after the other, enclose a right angle.
    RightAngle,
    /// Two segments that join at a corner have a common tangent there.
    Tangent,
    /// Two arcs have one radius.
    EqualRadii,
    /// Two arcs have one center.
    Concentric,
    /// The radius of an arc is a whole number of steps.
    Radius,
    /// The diameter of a circle is a whole number of steps.
    Diameter,
    /// The length of a line is a whole number of steps.
    Length,
    /// The distance of two parallel lines is a whole number of steps.
    Distance,
    /// The distance of the centers of two arcs is a whole number of steps.
    Centers,
}

impl OfferKind {
    /// All of them.
    pub const ALL: [OfferKind; 13] = [
        OfferKind::Horizontal,
        OfferKind::Vertical,
        OfferKind::Parallel,
        OfferKind::InLine,
        OfferKind::RightAngle,
        OfferKind::Tangent,
        OfferKind::EqualRadii,
        OfferKind::Concentric,
        OfferKind::Radius,
        OfferKind::Diameter,
        OfferKind::Length,
        OfferKind::Distance,
        OfferKind::Centers,
    ];

    /// The word for it: `horizontal`, `right_angle`, …
    pub fn name(self) -> &'static str {
        match self {
            OfferKind::Horizontal => "horizontal",
            OfferKind::Vertical => "vertical",
            OfferKind::Parallel => "parallel",
            OfferKind::InLine => "in_line",
            OfferKind::RightAngle => "right_angle",
            OfferKind::Tangent => "tangent",
            OfferKind::EqualRadii => "equal_radii",
            OfferKind::Concentric => "concentric",
            OfferKind::Radius => "radius",
            OfferKind::Diameter => "diameter",
            OfferKind::Length => "length",
            OfferKind::Distance => "distance",
            OfferKind::Centers => "centers",
        }
    }

    /// Whether its values are angles, in radians; else they are lengths.
    pub fn is_angle(self) -> bool {
        matches!(
            self,
            OfferKind::Horizontal | OfferKind::Vertical | OfferKind::Parallel | OfferKind::RightAngle
        )
    }
}

/// A condition that the points allow.
#[derive(Clone, Debug, PartialEq)]
pub struct Offer {
    /// Its kind.
    pub kind: OfferKind,
    /// The segments that it is about, each by the number of its contour and its own.
    pub of: Vec<[usize; 2]>,
    /// The value found: of relations an angle, or how far they are missed.
    pub found: f64,
    /// Its standard uncertainty; of concentric arcs that along the way from center to center.
    pub uncertainty: f64,
    /// The value offered.
    pub offered: f64,
    /// The step that a whole number is a multiple of.
    pub step: Option<f64>,
    /// The difference in standard uncertainties. The sum of squares grows by its square times the variance of the points.
    pub z: f64,
    /// The probability of a difference as large, if the offered value holds.
    pub p: f64,
    /// The probability that a value which has nothing to do with it lies as near as would still be offered.
    pub chance: f64,
}

/// Why nothing can be offered for a contour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Untidied {
    /// Its points are exact facets, which carry no random noise.
    Exact,
    /// It has neither lines nor arcs with an uncertainty.
    Unknown,
    /// It has too many segments in one tangent chain.
    TooMany,
}

impl Untidied {
    /// The reason as a sentence.
    pub fn reason(self) -> &'static str {
        match self {
            Untidied::Exact => "facets of a drawing carry no random noise",
            Untidied::Unknown => "no line or arc of it has an uncertainty",
            Untidied::TooMany => "it has more than 200 segments that are tangent to each other",
        }
    }
}

/// Conditions are offered that hold with this probability at least: two standard uncertainties, 95 %.
pub(super) const MIN_PROBABILITY: f64 = 0.0455;
/// Conditions that chance meets more often than this are not offered: they would say nothing.
pub(super) const MAX_CHANCE: f64 = 0.05;
/// Standard uncertainties to either side within which a value is offered.
pub(super) const OFFER_REACH_SIGMAS: f64 = 2.0;

/// A value and the offer for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value {
    pub found: f64,
    pub uncertainty: f64,
    pub degrees: f64,
}

impl Value {
    /// The probability of a difference as large as that from `offered`.
    fn p(&self, offered: f64) -> f64 {
        probability((self.found - offered) / self.uncertainty, self.degrees)
    }

    /// The offer of a value, where the points allow it and chance seldom does.
    pub fn offer(self, kind: OfferKind, of: &[[usize; 2]], offered: f64, chance: f64) -> Option<Offer> {
        let p = self.p(offered);
        let Value { found, uncertainty, .. } = self;
        let z = (found - offered) / uncertainty;
        (p >= MIN_PROBABILITY && chance <= MAX_CHANCE && z.is_finite()).then(|| Offer {
            kind,
            of: of.to_vec(),
            found,
            uncertainty,
            offered,
            step: None,
            z,
            p,
            chance,
        })
    }
}

/// Two-sided, of Student's distribution: the variance of the points was found from them.
fn probability(z: f64, degrees: f64) -> f64 {
    if degrees < 1e6 { student_p(z, degrees) } else { normal_p(z) }
}
