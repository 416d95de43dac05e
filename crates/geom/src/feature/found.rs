//! The data found for a nominal feature.

/// The data found for a feature.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Numbers of the facets, ascending; none in a cloud.
    pub facets: Vec<u32>,
    /// Numbers of their vertices (without the rim, where it does not count), or of the points of a cloud, ascending.
    pub points: Vec<u32>,
    /// Numbers of the vertices that were left out as its rim, ascending: how far it goes they tell all the same.
    pub rim: Vec<u32>,
    /// Area of the facets, mm².
    pub area: f64,
}
