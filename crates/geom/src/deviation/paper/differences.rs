//! How the paper's values differ from the distances to the surface.

use super::Value;
use crate::stats::sketch::Sketch;

/// Counts over the points that have both values.
#[derive(Clone, Debug, Default)]
pub struct Differences {
    /// Points compared.
    pub count: u64,
    /// Points where the values differ by more than rounding can explain ([`Value::rounding`]).
    pub differing: u64,
    /// Differing points where the paper's value is too small.
    pub too_small: u64,
    /// Greatest difference, millimeters; 0 where none differs.
    pub max_difference: f64,
    sizes: Sketch,
}

impl Differences {
    /// Adds points: the paper's values and the unsigned exact distances. Points whose exact distance is NaN (there is
    /// none) are passed over.
    pub fn push(&mut self, paper: &[Value], exact: &[f64]) {
        let mut sizes = Vec::new();
        for (value, exact) in paper.iter().zip(exact).filter(|(_, exact)| !exact.is_nan()) {
            let difference = value.distance - exact;
            self.count += 1;
            if difference.abs() > value.rounding {
                self.differing += 1;
                self.too_small += u64::from(difference < 0.0);
                sizes.push(difference.abs());
            }
        }
        self.max_difference = sizes.iter().copied().fold(self.max_difference, f64::max);
        self.sizes.push(&sizes);
    }
    /// Median size of the differences where the values differ, millimeters, to a relative error of 2^-15.
    pub fn median_difference(&self) -> Option<f64> {
        let last = self.sizes.count().checked_sub(1)?;
        let middle = self.sizes.at(&[last / 2, last.div_ceil(2)]);
        Some(middle.iter().sum::<f64>() / middle.len() as f64)
    }
}
