//! The color scale: one object that alone colors map, legend, histogram, flags and exports.

pub mod palette;

use palette::Rgb;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Color of what has no value.
pub const NO_VALUE: Rgb = [0x9a, 0xa0, 0xa6];

/// `trueness/scale/1`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scale {
    /// For people.
    pub name: String,
    /// How values become colors.
    pub mode: Mode,
    /// Low end; values below have the low cap's color.
    pub lower: f64,
    /// High end; values above have the high cap's color.
    pub upper: f64,
    /// The tolerance zone, which is then the middle band.
    pub tolerance: Option<[f64; 2]>,
    /// Number of bands between the ends.
    pub bands: u32,
    /// `inspect`, `safe` (color-blind) or `mono` (print).
    pub palette: String,
    /// Digits after the point in the legend.
    pub decimals: u32,
    /// `mm` of deviations; `mm⁻¹` or `mm⁻²` of curvatures.
    pub unit: String,
}

/// How values become colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Mode {
    /// Equal bands, the tolerance zone in the middle.
    Bands,
    /// Without steps.
    Continuous,
    /// Below, in, above the tolerance zone.
    GoNoGo,
}

impl Scale {
    /// The range that is shown unless the user asks for another.
    ///
    /// With a tolerance: twice its wider side, so that the zone is the middle of the picture. Without: the 95th percentile of
    /// the sizes of the deviations, rounded up to 1, 1.5, 2, 3, 5 or 7 times a power of ten. Symmetric either way.
    /// `p95_abs` that is zero, negative or not finite gives ±0.001 mm.
    pub fn for_deviations(p95_abs: f64, tolerance: Option<[f64; 2]>) -> Scale {
        let wider = tolerance.map(|[l, u]| l.abs().max(u.abs())).filter(|w| *w > 0.0 && w.is_finite());
        let upper = match wider {
            Some(w) => 2.0 * w,
            None => round_up(p95_abs),
        };
        Scale {
            name: "default".into(),
            mode: Mode::Bands,
            lower: -upper,
            upper,
            tolerance,
            bands: 9,
            palette: palette::NAMES[0].into(),
            decimals: decimals(upper),
            unit: "mm".into(),
        }
    }

    /// The range of values of another unit: up to `most` in size, rounded up as in [`Scale::for_deviations`], and symmetric. As many
    /// digits as show a hundredth of it, however small it is.
    pub fn for_values(most: f64, unit: &str) -> Scale {
        let scale = Scale::for_deviations(most, None);
        let decimals = (2.0 - libm::log10(scale.upper).floor()).clamp(3.0, 15.0) as u32;
        Scale { decimals, unit: unit.into(), ..scale }
    }

    /// Where the color changes, rising; one more than there are bands, the caps lie beyond.
    ///
    /// With a tolerance the middle band is the zone, and the bands beyond it divide `[upper limit, upper]` and
    /// `[lower, lower limit]` evenly; without, all bands are equal. A zone that reaches beyond the range widens it: what is
    /// within tolerance has the middle color whatever the range, and the bands for which there is no room have no width.
    pub fn limits(&self) -> Vec<f64> {
        let zone = self.zone();
        if self.mode == Mode::GoNoGo {
            return zone.map_or(vec![self.lower, self.upper], |z| z.to_vec());
        }
        let Some([l, u]) = zone else {
            let n = self.bands.max(1);
            return (0..=n).map(|i| between(self.lower, self.upper, i, n)).collect();
        };
        let side = (self.bands / 2).max(1);
        let [lower, upper] = self.ends();
        let below = (0..=side).map(|i| between(lower, l, i, side));
        below.chain((0..=side).map(|i| between(u, upper, i, side))).collect()
    }

    /// The tolerance zone, if it is one.
    fn zone(&self) -> Option<[f64; 2]> {
        self.tolerance.filter(|[l, u]| l <= u)
    }

    /// The range with the tolerance zone in it: what a legend must reach over.
    pub fn ends(&self) -> [f64; 2] {
        let [l, u] = self.zone().unwrap_or([self.lower, self.upper]);
        [self.lower.min(l), self.upper.max(u)]
    }

    /// The same scale for another tolerance, if there is one.
    pub fn for_tolerance(self, tolerance: Option<[f64; 2]>) -> Scale {
        Scale { tolerance: tolerance.or(self.tolerance), ..self }
    }

    /// Number of the color for a deviation: 0 the low cap, then the bands from low to high, last the high cap. `None` for NaN.
    ///
    /// A value on a limit belongs to the band nearer the middle, so both tolerance limits are in the zone. It depends on the
    /// scale and the value alone, never on the other values.
    pub fn slot(&self, deviation: f64) -> Option<usize> {
        (!deviation.is_nan()).then(|| slot(&self.limits(), deviation))
    }

    /// Colors of all slots, low cap first.
    pub fn colors(&self) -> Vec<Rgb> {
        palette::colors(&self.palette, self.limits().len() - 1)
    }

    /// Color for a deviation in the scale's own mode; gray for NaN.
    pub fn color(&self, deviation: f64) -> Rgb {
        let Some(slot) = self.slot(deviation) else { return NO_VALUE };
        let colors = self.colors();
        if self.mode == Mode::Continuous && 0 < slot && slot + 1 < colors.len() {
            blend(&self.limits(), &colors, self.zone().is_some(), deviation)
        } else {
            colors[slot]
        }
    }

    /// The continuous colors as `n` equal steps from end to end, each taken in its middle. With a tolerance, half of them for
    /// what lies below the zone and half for what lies above: the zone has one color.
    pub fn ramp(&self, n: usize) -> Vec<Rgb> {
        let (limits, colors) = (self.limits(), self.colors());
        let [lower, upper] = self.ends();
        let zone = self.zone();
        let parts = match zone {
            Some([l, u]) => vec![([lower, l], n / 2), ([u, upper], n - n / 2)],
            None => vec![([lower, upper], n)],
        };
        let at = |[from, to]: [f64; 2], i: usize, n: usize| from + (i as f64 + 0.5) / n as f64 * (to - from);
        let steps = parts.into_iter().flat_map(|(part, n)| (0..n).map(move |i| at(part, i, n)));
        steps.map(|d| blend(&limits, &colors, zone.is_some(), d)).collect()
    }
}

/// Why a scale cannot color anything.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ScaleError {
    /// The ends are not numbers, or the wrong way round.
    #[error("`lower` ({0}) must be a number below `upper` ({1})")]
    Ends(f64, f64),
    /// No bands, or more than anyone can tell apart.
    #[error("`bands` is {0}; it must be from 1 to 99")]
    Bands(u32),
    /// The zone is empty.
    #[error("`tolerance` [{0}, {1}] must be two numbers that rise")]
    Tolerance(f64, f64),
    /// There is no such palette.
    #[error("`palette` is ‘{0}’; there are {list}", list = palette::NAMES.join(", "))]
    Palette(String),
}

impl Scale {
    /// Makes sure that a scale from a file can be used.
    ///
    /// # Errors
    /// See [`ScaleError`].
    pub fn check(&self) -> Result<(), ScaleError> {
        let (lower, upper) = (self.lower, self.upper);
        if !(lower.is_finite() && upper.is_finite() && lower < upper) {
            return Err(ScaleError::Ends(lower, upper));
        }
        if !(1..=99).contains(&self.bands) {
            return Err(ScaleError::Bands(self.bands));
        }
        if let Some([l, u]) = self.tolerance
            && !(l.is_finite() && l < u && u.is_finite())
        {
            return Err(ScaleError::Tolerance(l, u));
        }
        if palette::NAMES.contains(&self.palette.as_str()) {
            Ok(())
        } else {
            Err(ScaleError::Palette(self.palette.clone()))
        }
    }
}

/// See [`Scale::slot`].
pub fn slot(limits: &[f64], deviation: f64) -> usize {
    let middle = limits.len() / 2;
    let above = limits[middle..].iter().filter(|l| deviation > **l).count();
    let below = limits[..middle].iter().filter(|l| deviation < **l).count();
    middle + above - below
}

/// Each band has its color in its middle; between two middles colors are mixed, beyond the last ones they stay. A tolerance zone
/// is no part of that: it has its one color, and on either side the mixing begins anew.
fn blend(limits: &[f64], colors: &[Rgb], zoned: bool, deviation: f64) -> Rgb {
    let middle = limits.len() / 2;
    let (from, to) = match (zoned, slot(limits, deviation)) {
        (true, s) if s == middle => return colors[middle],
        (true, s) if s < middle => (0, middle - 1),
        (true, _) => (middle, limits.len() - 1),
        (false, _) => (0, limits.len() - 1),
    };
    let centers: Vec<f64> = limits[from..=to].windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
    let next = centers.iter().filter(|c| **c < deviation).count();
    if next == 0 || next == centers.len() {
        return colors[from + next.clamp(1, centers.len())];
    }
    let (low, high) = (centers[next - 1], centers[next]);
    palette::mix(colors[from + next], colors[from + next + 1], (deviation - low) / (high - low))
}

/// The `i`-th of `n` equal steps from `a` to `b`, exact at both ends.
fn between(a: f64, b: f64, i: u32, n: u32) -> f64 {
    let t = f64::from(i) / f64::from(n);
    if i == n { b } else { a + t * (b - a) }
}

/// The next of 1, 1.5, 2, 3, 5, 7 times a power of ten that is not less.
fn round_up(x: f64) -> f64 {
    if !(x > 0.0 && x.is_finite()) {
        return 0.001;
    }
    let exponent = libm::log10(x).floor() as i32;
    // Decimal text is the one way to the nearest double of a decimal number.
    let candidates = [(1.0, 0), (1.5, 0), (2.0, 0), (3.0, 0), (5.0, 0), (7.0, 0), (1.0, 1)];
    let of = |(m, e): (f64, i32)| format!("{m}e{}", exponent + e).parse().unwrap_or(x);
    candidates.into_iter().map(of).find(|c| *c >= x).unwrap_or(x)
}

/// Digits after the point: micrometers, and more where a hundredth of `upper` is finer; at most 6.
fn decimals(upper: f64) -> u32 {
    (2.0 - libm::log10(upper).floor()).clamp(3.0, 6.0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn toleranced() -> Scale {
        Scale::for_deviations(7.0, Some([-0.1, 0.1]))
    }

    #[test]
    fn default_ranges() {
        assert_eq!((toleranced().lower, toleranced().upper), (-0.2, 0.2));
        assert_eq!(Scale::for_deviations(9.0, Some([-0.1, 0.3])).upper, 0.6);
        for (p95, upper) in [
            (0.32, 0.5),
            (0.5, 0.5),
            (0.51, 0.7),
            (0.71, 1.0),
            (1.01, 1.5),
            (3e-4, 3e-4),
            (0.0, 1e-3),
            (f64::NAN, 1e-3),
        ] {
            assert_eq!(Scale::for_deviations(p95, None).upper, upper, "{p95}");
        }
    }

    #[test]
    fn values_of_another_unit_have_the_digits_they_need() {
        let s = Scale::for_values(2.3e-8, "mm⁻²");
        assert_eq!((s.lower, s.upper, s.decimals, s.unit.as_str()), (-3e-8, 3e-8, 10, "mm⁻²"));
        assert_eq!(Scale::for_values(0.6, "mm⁻¹").decimals, 3);
        assert!(s.check().is_ok());
    }

    #[test]
    fn the_middle_band_is_the_tolerance_zone() {
        let s = toleranced();
        let limits = s.limits();
        assert_eq!(limits.len(), 10);
        assert_eq!(limits[4..6], [-0.1, 0.1]);
        let green = [0x2f, 0xa8, 0x4a];
        for d in [-0.1, 0.0, 0.1] {
            assert_eq!(s.color(d), green);
        }
        for d in [0.1 + 1e-9, -0.1 - 1e-9] {
            assert_ne!(s.color(d), green);
        }
    }

    #[test]
    fn beyond_the_scale_is_a_cap_and_nothing_is_gray() {
        let s = toleranced();
        assert_eq!(
            (s.slot(0.2), s.slot(0.2 + 1e-12), s.slot(-0.2), s.slot(-0.3)),
            (Some(9), Some(10), Some(1), Some(0))
        );
        assert_eq!((s.slot(f64::INFINITY), s.slot(f64::NAN), s.color(f64::NAN)), (Some(10), None, NO_VALUE));
    }

    /// The trap: a scale of 0 … 100 that other programs stretch to data of 4 … 100.
    #[test]
    fn colors_do_not_depend_on_the_data() {
        let scale = Scale { lower: 0.0, upper: 100.0, tolerance: None, ..toleranced() };
        let alone: Vec<Rgb> = (0..=100).map(|d| scale.color(f64::from(d))).collect();
        let data: Vec<f64> = (4..=100).map(f64::from).collect();
        for d in data {
            assert_eq!(scale.color(d), alone[d as usize]);
        }
        assert_eq!(scale.slot(4.0), Some(1));
        assert_eq!(scale.slot(50.0), Some(5));
    }

    #[test]
    fn the_ramp_passes_through_the_bands_colors() {
        let s = Scale { mode: Mode::Continuous, ..toleranced() };
        let (ramp, colors) = (s.ramp(256), s.colors());
        assert_eq!((ramp[0], ramp[255]), (colors[1], colors[9]));
        assert_eq!(s.color(0.0), colors[5]);
        assert_eq!(s.color(0.25), colors[10]);
    }

    #[test]
    fn what_is_within_tolerance_is_green_whatever_range_and_mode() {
        let green = [0x2f, 0xa8, 0x4a];
        for mode in [Mode::Bands, Mode::Continuous, Mode::GoNoGo] {
            for (lower, upper) in
                [(-0.1, 0.1), (-0.5, 0.5), (-1.0, 1.0), (-0.1, 2.0), (0.6, 0.9), (-9.0, -2.0)]
            {
                let s = Scale { mode, lower, upper, ..Scale::for_deviations(0.0, Some([-0.5, 0.5])) };
                assert!(s.check().is_ok());
                for i in 0..=1000 {
                    let d = -2.0 + 0.004 * f64::from(i);
                    let within = (-0.5..=0.5).contains(&d);
                    assert_eq!(s.color(d) == green, within, "{d} in {lower} … {upper}, {mode:?}");
                }
                assert!(s.limits().is_sorted() && s.limits().len() + 1 == s.colors().len());
            }
        }
        let ramp =
            Scale { mode: Mode::Continuous, ..Scale::for_deviations(0.0, Some([-0.5, 0.5])) }.ramp(256);
        assert!(!ramp.contains(&green));
    }

    #[test]
    fn go_no_go_knows_three_colors() {
        let s = Scale { mode: Mode::GoNoGo, ..toleranced() };
        assert_eq!([-0.11, -0.1, 0.1, 0.11].map(|d| s.slot(d)), [Some(0), Some(1), Some(1), Some(2)]);
    }
}
