//! What was found by a plan.

use super::align::Alignment;
use super::deviation::Deviations;
use super::faces_view::DrawnFace;
use super::uncertainty::Uncertainty;
use crate::characteristic::{MeasuredFeature, NotMeasured, Spec, Value};
use crate::noise::NoiseOrReason;
use trueness_document::compare::Warning;
use trueness_document::face::FaceRecord;
use trueness_geom::scan::Scan;

/// All features and values of a plan.
pub struct Inspection {
    /// The characteristics with all exact dimensions, those of the model too.
    pub specs: Vec<Spec>,
    /// What is to be said of each characteristic by the model alone.
    pub notes: Vec<Vec<String>>,
    /// The features, in the plan's order.
    pub features: Vec<MeasuredFeature>,
    /// The faces of the reference, a CAD model, that each feature is; none of other references.
    pub faces: Vec<Vec<FaceRecord>>,
    /// The values of the characteristics, in the plan's order, or why there are none.
    pub values: Vec<Result<Value, NotMeasured>>,
    /// What each value would be with the points of its features and datums of which it is not certain whose they are; `None`
    /// where there are none.
    pub with_others: Vec<Option<Result<Value, NotMeasured>>>,
    /// The values in other poses in which the data fit about as well, where the alignment has found such.
    pub in_other_poses: Vec<Vec<Result<Value, NotMeasured>>>,
    /// The noise of what was measured, and how far neighbors share it; or why none is told.
    pub noise: NoiseOrReason,
    /// The uncertainty of each value, where the plan states one or the noise of the points.
    pub uncertainties: Vec<Option<Uncertainty>>,
    /// The measured data where they were evaluated: aligned.
    pub measured: Option<Scan>,
    /// The partition of the measured data, each face and each class of what is of none by itself; empty where no report is asked for, or
    /// nothing is sought.
    pub drawn: Vec<DrawnFace>,
    /// What took them there.
    pub alignment: Alignment,
    /// What makes it unlikely that the aligned data are of the part that the plan describes.
    pub doubts: Vec<Warning>,
    /// Deviations from the reference, where the plan asks for them.
    pub deviations: Option<Deviations>,
}
