//! Options of a repair. The default, with all steps, stands beside their list.

use super::step::Step;

/// Which holes are filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Holes {
    /// Holes whose patch has at most this share of the area of their shell.
    UpTo(f64),
    /// All, even the rim of a sheet; of a flat one, which would enclose nothing, none.
    All,
}

/// Options of a repair.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The steps to do, in any order.
    pub steps: Vec<&'static Step>,
    /// Distance, mm, up to which two places may have been meant as one; `None`: as in [`check::Options::gap`](trueness_geom::check::Options::gap).
    pub gap: Option<f64>,
    /// Distance, mm, up to which edges are stitched; `None`: a ten-thousandth of the diagonal.
    pub stitch: Option<f64>,
    /// Which holes are filled.
    pub holes: Holes,
    /// Shells with a smaller share of the diagonal of the whole are removed; `None`: none.
    pub islands: Option<f64>,
    /// The result shall be exact in single precision, as a file may hold no more: vertices are rounded before anything is
    /// decided. Without it they are where shells cannot be united otherwise.
    pub single: bool,
}
