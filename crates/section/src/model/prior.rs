//! Knowledge about the noise of a row before it is searched.

use super::result::Options;

/// The standard deviation of noise, and of how many degrees of freedom the knowledge is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct KnownNoise {
    pub deviation: f64,
    pub degrees: f64,
}

/// Noise and offsets below this share of the distance between points say nothing about the form.
pub(crate) const NEGLIGIBLE_OFFSET_SPACINGS: f64 = 0.005;
/// Degrees of freedom of noise that the user gives.
const DEGREES_OF_GIVEN_NOISE: f64 = 1e6;

impl KnownNoise {
    /// The noise that is given, if it is.
    pub fn stated(options: &Options) -> Option<KnownNoise> {
        options.noise.map(|deviation| KnownNoise { deviation, degrees: DEGREES_OF_GIVEN_NOISE })
    }
}

/// Knowledge about the noise of the points of a row.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Prior<'a> {
    pub noise: Option<KnownNoise>,
    /// How many independent points each tells as much as; all count 1 where it is not told.
    pub weights: Option<&'a [f64]>,
    /// Standard deviation of a form that hardly has lines and arcs from smooth surfaces, where theirs is one.
    pub free_form: Option<f64>,
}

impl Prior<'_> {
    /// That of points as they are given.
    pub fn of(options: &Options) -> Prior<'static> {
        Prior { noise: KnownNoise::stated(options), ..Prior::default() }
    }

    /// The weight of a point.
    pub fn weight(&self, i: usize) -> f64 {
        self.weights.map_or(1.0, |all| all[i])
    }

    /// Knowledge about the points with these numbers.
    pub fn among<R>(&self, numbers: impl Iterator<Item = usize>, then: impl FnOnce(Prior) -> R) -> R {
        let own: Option<Vec<f64>> = self.weights.map(|all| numbers.map(|i| all[i]).collect());
        then(Prior { weights: own.as_deref(), ..*self })
    }
}
