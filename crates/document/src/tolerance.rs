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

/// Why points farther away than `max_distance`, which do not count, would hide what is out of one of these zones; nothing where they do not.
pub fn cannot_fail(max_distance: f64, zones: impl Iterator<Item = Tolerance>) -> Option<String> {
    let limits = zones.flat_map(|zone| [zone.lower, zone.upper]);
    let hidden =
        limits.filter(|limit| max_distance <= limit.abs()).max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    Some(format!(
        "points farther away do not count, so that none could be out of a tolerance of {hidden:+} mm; give several times the tolerance"
    ))
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
