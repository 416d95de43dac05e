//! The characteristics that an inspection evaluates: one file each, one line in [`ALL`].
//!
//! Each evaluates its value as its standard defines it and says where the value is reached; what is allowed and what
//! follows from it is not its business.

mod angle;
mod angularity;
mod circular_runout;
mod coaxiality;
mod cylindricity;
mod distance;
mod exact;
mod flatness;
mod kind;
mod line_profile;
mod located;
mod material;
mod measured_feature;
mod orientation;
mod parallelism;
mod perpendicularity;
mod position;
mod profile;
mod reason;
mod roundness;
mod size;
mod straightness;
mod surface_profile;
mod symmetry;
mod texture;
mod total_runout;
mod value;

pub(crate) use exact::{COORDINATES, nearest};
pub use kind::{Allowed, Characteristic, Measuring, Question, Refusal, Spec};
pub(crate) use located::{datum_source, frame};
pub use measured_feature::{Element, ExcludedPoints, MeasuredFeature, Others};
pub use reason::{Impossible, Lack, NoElement, NotMeasured, PointsBeyond};
pub use size::Size;
pub use texture::Texture;
pub use value::{FrameOf, Missing, Place, Value};

/// All of them, in the order of ISO 1101, then dimensions, then texture.
pub static ALL: &[&dyn Characteristic] = &[
    &straightness::Straightness,
    &flatness::Flatness,
    &roundness::Roundness,
    &cylindricity::Cylindricity,
    &line_profile::LineProfile,
    &surface_profile::SurfaceProfile,
    &parallelism::Parallelism,
    &perpendicularity::Perpendicularity,
    &angularity::Angularity,
    &position::Position,
    &coaxiality::Coaxiality,
    &symmetry::Symmetry,
    &circular_runout::CircularRunout,
    &total_runout::TotalRunout,
    &size::Size,
    &distance::Distance,
    &angle::Angle,
    &texture::Texture,
];

#[cfg(test)]
mod tests {
    use super::ALL;
    use trueness_document::plan::KINDS;

    #[test]
    fn plans_know_the_words_of_all_characteristics() {
        assert_eq!(ALL.iter().map(|c| c.word()).collect::<Vec<_>>(), KINDS);
    }
}
