//! Amplitude parameters of areal surface texture.
//!
//! ISO 25178-2:2021, height parameters: parameters of the heights of the scale-limited surface over the definition area. The integrals
//! are weighted sums: each height stands for the area given with it.

/// Height parameters; lengths in the unit of the heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// Arithmetic mean height: mean of the magnitudes.
    pub sa: f64,
    /// Root mean square height.
    pub sq: f64,
    /// Maximum height: greatest less least.
    pub sz: f64,
    /// Skewness: mean cube over Sq³. Absent where Sq is zero.
    pub ssk: Option<f64>,
    /// Kurtosis: mean fourth power over Sq⁴. Absent where Sq is zero.
    pub sku: Option<f64>,
}

/// The parameters of `heights` above the form, each with its area as weight. `None` without heights, where a number is not
/// finite, or where the areas do not sum to more than zero. The mean height is taken off first: it belongs to the form.
///
/// ```
/// // A square profile of height ±1: all magnitudes are 1.
/// let t = trueness_geom::zone::texture::texture(&[1.0, -1.0, 1.0, -1.0], &[1.0; 4]).unwrap();
/// assert_eq!((t.sa, t.sq, t.sz, t.ssk, t.sku), (1.0, 1.0, 2.0, Some(0.0), Some(1.0)));
/// ```
pub fn texture(heights: &[f64], areas: &[f64]) -> Option<Texture> {
    let pairs = || heights.iter().copied().zip(areas.iter().copied());
    let whole: f64 = pairs().map(|(_, a)| a).sum();
    if heights.is_empty() || heights.len() != areas.len() || !(whole > 0.0 && whole.is_finite()) {
        return None;
    }
    if !heights.iter().all(|z| z.is_finite()) || !areas.iter().all(|a| *a >= 0.0) {
        return None;
    }
    let mean = pairs().map(|(z, a)| a * z).sum::<f64>() / whole;
    let moment = |f: fn(f64) -> f64| pairs().map(|(z, a)| a * f(z - mean)).sum::<f64>() / whole;
    let sq = moment(|z| z * z).sqrt();
    let range = heights.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], z| [l.min(*z), h.max(*z)]);
    let shape = |m: f64, power: f64| (sq > 0.0).then(|| m / power);
    Some(Texture {
        sa: moment(f64::abs),
        sq,
        sz: range[1] - range[0],
        ssk: shape(moment(|z| z * z * z), sq * sq * sq),
        sku: shape(moment(|z| z * z * z * z), sq * sq * sq * sq),
    })
}
