//! The least distances that the coordinates of a mesh can tell apart.

use crate::space::Aabb;

/// Spacing of single-precision numbers at the largest coordinate of `bounds`, mm; 0 for an empty box.
///
/// Most meshes have passed through single precision once; two places closer than a few spacings may have been one.
pub fn spacing(bounds: &Aabb) -> f64 {
    let largest = bounds.min.iter().chain(&bounds.max).map(|x| x.abs()).filter(|x| x.is_finite());
    let largest = largest.fold(0.0, f64::max);
    if largest == 0.0 { 0.0 } else { libm::pow(2f64, libm::log2(largest).floor()) * f64::from(f32::EPSILON) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_that_of_single_precision() {
        for x in [1.0f32, 1.5, 1e6, 12.0, 1e-3, 77.7] {
            let bounds = Aabb { min: [-0.5 * f64::from(x), 0.0, 0.0], max: [f64::from(x), 0.0, 0.0] };
            assert_eq!(spacing(&bounds), f64::from(x.next_up()) - f64::from(x), "{x}");
        }
        assert_eq!(spacing(&Aabb::EMPTY), 0.0);
    }
}
