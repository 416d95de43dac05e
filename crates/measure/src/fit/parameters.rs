//! The parameters of an element by names, and their uncertainties.

use std::collections::BTreeMap;
use trueness_document::fit::Number;
use trueness_geom::fit::Fit;
use trueness_geom::shape::Parameter;

/// Parameters by their names.
pub fn named(parameters: Vec<(&'static str, Parameter)>) -> BTreeMap<String, Number> {
    let number = |p| match p {
        Parameter::Number(x) => Number::One(x),
        Parameter::Vector(v) => Number::Three(v),
    };
    parameters.into_iter().map(|(name, p)| (name.to_string(), number(p))).collect()
}

/// Why there is nothing to judge the points' scatter by.
pub(super) const NONE_LEFT: &str = "there are no more points than unknowns";

/// The standard uncertainties of the parameters, or why there are none, where so many points tell as much as an independent one.
pub fn uncertainty(
    fit: &Fit,
    points_per_independent: f64,
) -> (Option<BTreeMap<String, Number>>, Option<String>) {
    let shared = fit.covariance.clone().map(|c| c.of_shared(points_per_independent));
    let found = shared.map(|c| named(c.uncertainties(&fit.shape)));
    let reason = match (&found, fit.touching.is_empty()) {
        (Some(_), _) => None,
        (None, true) => Some(NONE_LEFT.to_string()),
        (None, false) => Some("the element rests on its few touching points".to_string()),
    };
    (found, reason)
}
