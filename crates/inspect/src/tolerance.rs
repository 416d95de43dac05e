//! What is allowed.

/// A zone of allowed deviations; both limits belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Least allowed deviation, millimeters.
    pub lower: f64,
    /// Greatest allowed deviation, millimeters.
    pub upper: f64,
}

/// How bad a deviation is: how far it lies beyond the zone (below 0 within it), or its size where there is no zone.
pub fn badness(deviation: f64, zone: Option<[f64; 2]>) -> f64 {
    zone.map_or(deviation.abs(), |[lower, upper]| (deviation - upper).max(lower - deviation))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beyond_the_zone_counts_and_not_the_size() {
        let zone = Some([-0.05, 0.3]);
        assert!(badness(-0.2, zone) > badness(0.35, zone));
        assert!(badness(0.29, zone) < 0.0 && badness(0.0, zone) < badness(0.29, zone));
        assert_eq!(badness(-0.2, None), 0.2);
    }
}
