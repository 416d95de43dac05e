//! The options of a check.

/// The kinds to look for and from where on they count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Findings of each kind that are listed; all are counted.
    pub limit: usize,
    /// Look for self-intersections, which takes as long as all the rest.
    pub self_intersections: bool,
    /// Distance, mm, up to which two places may have been meant as one: for T-junctions and unshared vertices. `None`:
    /// eight times the spacing of single-precision numbers at the largest coordinate.
    pub gap: Option<f64>,
    /// Facets with a smaller angle than this, radians, are slivers.
    pub sliver_angle: f64,
    /// Shells with a smaller diagonal than this share of the diagonal of the whole are islands.
    pub island_share: f64,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            limit: 1000,
            self_intersections: true,
            gap: None,
            sliver_angle: 0.1f64.to_radians(),
            island_share: 0.01,
        }
    }
}
