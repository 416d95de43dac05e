//! Datums associated one after the other, and the frame that they make.

use super::associate::associate;
use super::attitude::{Held, System};
use super::common::Common;
use super::error::DatumError;
use super::frame::State;
use super::source::{Datum, Rule, Source};
use crate::progress::Progress;

impl System {
    /// Associates the datums one after the other, each in the attitude that those before it leave, and makes their frame. A
    /// datum has one feature, or as a common datum (`A-B`) two or three, associated at once. These are coaxial cylinders or
    /// lines, coplanar planes, or two opposite planes. Every point of them counts alike.
    ///
    /// Cost: some passes over the points of each datum.
    ///
    /// # Errors
    /// [`DatumError`]: points that make no element, or a datum parallel to one that it should stand across. Also features that
    /// make no common datum, or more than three datums.
    ///
    /// ```
    /// use trueness_geom::progress::Silent;
    /// use trueness_geom::shape::Kind;
    /// use trueness_geom::zone::datum::{Datum, Rule, Source, System};
    /// // Two lines of one axis, the second one leaning by its own.
    /// let (a, b) = ([[0.0, 0.0, 0.0], [0.0, 0.0, 10.0]], [[0.0, 0.1, 90.0], [0.0, -0.1, 100.0]]);
    /// let line = |points| Source { points, kind: Kind::Line, outward: [0.0; 3] };
    /// let system = System::associated(&[vec![line(&a), line(&b)]], Rule::Gaussian, &Silent)?;
    /// let Datum::Axis { direction, .. } = system.datums[0] else { unreachable!() };
    /// // Slope of the straight line of least squares through the four: −1 / 8200.
    /// assert!((direction[1] / direction[2] + 1.0 / 8200.0).abs() < 1e-9);
    /// # Ok::<(), trueness_geom::zone::datum::DatumError>(())
    /// ```
    pub fn associated(
        sources: &[Vec<Source>],
        rule: Rule,
        progress: &dyn Progress,
    ) -> Result<System, DatumError> {
        let mut datums = Vec::new();
        for (datum, features) in sources.iter().enumerate() {
            let held = match datum {
                0 => Held::Nothing,
                _ => System::of(&datums)?.held(),
            };
            datums.push(match features.as_slice() {
                [one] => associate(datum, one, rule, held, progress)?,
                sources => Common { datum, sources, rule, held, progress }.associated()?,
            });
        }
        System::of(&datums)
    }

    /// The frame of datums that stand parallel or perpendicular to each other.
    ///
    /// # Errors
    /// [`DatumError`]: as for [`System::associated`].
    pub fn of(datums: &[Datum]) -> Result<System, DatumError> {
        let mut state = State::default();
        for (datum, d) in datums.iter().enumerate() {
            state.add(datum, d)?;
        }
        state.finished(datums)
    }
}
