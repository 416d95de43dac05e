//! Deviations of many points.

use trueness_geom::deviation::surface::Exclusion;
use trueness_geom::stats::statistics::Summary;

/// The deviation of a point, millimeters, positive outside; or why it has none.
pub type Deviation = Result<f64, Exclusion>;

/// The deviations of points from a reference, in the order of the points.
#[derive(Clone, Debug)]
pub struct Deviations {
    values: Vec<f64>,
}

impl Deviations {
    /// Of what a surface measured; see [`Exclusion::of`].
    pub(super) fn new(values: Vec<f64>) -> Deviations {
        Deviations { values }
    }

    /// Number of points, excluded ones too.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// That of point `index`; `None` beyond the last one.
    pub fn get(&self, index: usize) -> Option<Deviation> {
        self.values.get(index).map(|v| deviation(*v))
    }

    /// One for each point.
    pub fn iter(&self) -> impl Iterator<Item = Deviation> {
        self.values.iter().map(|v| deviation(*v))
    }

    /// Those of the points that have one.
    pub fn measured(&self) -> impl Iterator<Item = f64> {
        self.values.iter().copied().filter(|v| v.is_finite())
    }

    /// How many points are excluded for this reason.
    pub fn excluded(&self, why: Exclusion) -> usize {
        self.values.iter().filter(|v| Exclusion::of(**v) == Some(why)).count()
    }

    /// Statistics of all deviations, the positive and the negative ones. Excluded points do not count. Cost: a sort.
    pub fn statistics(&self) -> Summary {
        Summary::of(&self.values)
    }

    /// Share of the measured points within `[lower, upper]`, the limits included, 0 to 1; `None` where nothing was measured.
    ///
    /// ```
    /// # use trueness::{Mesh, Reference};
    /// # let positions = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0]];
    /// let reference = Reference::new(Mesh { positions, faces: vec![[0, 1, 2]] })?;
    /// let deviations = reference.deviations(&[[1.0, 1.0, 0.05], [2.0, 2.0, 0.3]])?;
    /// assert_eq!(deviations.share_within(-0.1, 0.1), Some(0.5));
    /// # Ok::<(), trueness::Error>(())
    /// ```
    pub fn share_within(&self, lower: f64, upper: f64) -> Option<f64> {
        let count = self.measured().count();
        let within = self.measured().filter(|d| (lower..=upper).contains(d)).count();
        (count > 0).then(|| within as f64 / count as f64)
    }
}

fn deviation(value: f64) -> Deviation {
    Exclusion::of(value).map_or(Ok(value), Err)
}
