//! What geometry tells apart, and the words that documents have for it.
//!
//! Each is mapped by a `match` over all of its variants, so that a new one is given its word before anything compiles.

use trueness_document::Word;
use trueness_document::compare::SignBy;
use trueness_document::repair::RepairStep;
use trueness_geom::deviation::sign_choice::SignMethod;
use trueness_solid::repair::{STEPS, Step};

/// Something that geometry tells apart, and its word in documents.
pub trait ToWord: Copy {
    /// What documents hold.
    type Word;
    /// The word for it.
    fn word(self) -> Word<Self::Word>;
}

/// A word of documents, and what it is to geometry.
pub trait ToGeometry: Copy {
    /// What geometry has for it.
    type Geometry;
    /// What the word means.
    fn geometry(self) -> Self::Geometry;
}

/// Maps the variants of an enum of geometry to those of the same names in documents, and back.
macro_rules! mapped {
    ($($geometry:path => $document:path { $($variant:ident)* })*) => {
        $(
            impl ToWord for $geometry {
                type Word = $document;
                fn word(self) -> Word<$document> {
                    type Document = $document;
                    type Geometry = $geometry;
                    Word(match self {
                        $(Geometry::$variant => Document::$variant,)*
                    })
                }
            }

            impl ToGeometry for $document {
                type Geometry = $geometry;
                fn geometry(self) -> $geometry {
                    type Document = $document;
                    type Geometry = $geometry;
                    match self {
                        $(Document::$variant => Geometry::$variant,)*
                    }
                }
            }
        )*

        /// Name and word of all that is mapped, for the test that loops over it.
        #[cfg(test)]
        fn all() -> Vec<(&'static str, &'static str)> {
            let mut all = vec![];
            $(
                {
                    type Geometry = $geometry;
                    all.extend(Geometry::ALL.map(|kind| (kind.name(), kind.word().name())));
                    all.extend(Geometry::ALL.map(|kind| (kind.name(), kind.word().geometry().name())));
                    type Document = $document;
                    assert_eq!(Geometry::ALL.len(), Document::ALL.len());
                    assert_eq!(Geometry::ALL.map(|kind| *kind.word()), Document::ALL);
                }
            )*
            all
        }
    };
}

mapped! {
    trueness_geom::shape::Kind => trueness_document::shape::ShapeKind { Line2 Line Plane Circle2 Circle Ellipse2 Sphere Cylinder Cone Torus }
    trueness_geom::fit::Method => trueness_document::shape::FitMethod { Gaussian MinimumZone MinimumCircumscribed MaximumInscribed Robust }
    trueness_surface::curvature::NoCurvature => trueness_document::curvature::NoCurvature { NotFinite Unused NotASurface Boundary FewNeighbors Undetermined Folded }
    trueness_geom::check::Severity => trueness_document::check::Severity { Error Warning }
    trueness_surface::BaseKind => trueness_document::surface::BaseKind { Plane Xy Cylinder Sphere Mesh }
    trueness_surface::Reached => trueness_document::surface::Reached { Tolerance Noise Points Memory }
    trueness_section::Continuity => trueness_document::section::Continuity { G0 G1 G2 }
    trueness_section::RowKind => trueness_document::section::Taken { Row Facets Scan }
    trueness_section::DimensionKind => trueness_document::section::DimensionKind { Angle Width Centers Gap }
    trueness_section::OfferKind => trueness_document::section::OfferKind { Horizontal Vertical Parallel InLine RightAngle Tangent EqualRadii Concentric Radius Diameter Length Distance Centers }
}

impl ToWord for SignMethod {
    type Word = SignBy;
    fn word(self) -> Word<SignBy> {
        Word(match self {
            SignMethod::Pseudonormal => SignBy::Pseudonormal,
            SignMethod::Winding => SignBy::Winding,
            SignMethod::Normal => SignBy::Normal,
            SignMethod::None => SignBy::None,
        })
    }
}

/// The words of all steps of the repair, in their order: as many as there are steps.
const STEP_WORDS: [RepairStep; STEPS.len()] = RepairStep::ALL;

impl ToWord for &Step {
    type Word = RepairStep;
    fn word(self) -> Word<RepairStep> {
        // Every step is one of the list.
        let place = STEPS.iter().position(|step| *step == self).unwrap_or_default();
        Word(STEP_WORDS[place])
    }
}

impl ToGeometry for RepairStep {
    type Geometry = &'static Step;
    fn geometry(self) -> &'static Step {
        let place = STEP_WORDS.iter().position(|word| *word == self).unwrap_or_default();
        STEPS[place]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_the_names_that_geometry_has() {
        for (name, word) in all() {
            assert_eq!(name, word);
        }
        use SignMethod::{None, Normal, Pseudonormal, Winding};
        for method in [Pseudonormal, Winding, Normal, None] {
            assert_eq!(method.word().name(), method.name());
        }
        for step in STEPS {
            assert_eq!((step.word().name(), step.word().geometry()), (step.name, step));
        }
    }
}
