//! The features of a plan in the measured data.

use super::data::Data;
use super::faces_view::{self, DrawnFace};
use super::nominals::Nominals;
use super::parted::Parted;
use super::stop::Stop;
use super::{cloud, extract_features, missing_feature_hint};
use crate::characteristic::MeasuredFeature;
use crate::plan::Plan;
use trueness_geom::progress::Progress;

/// The features of a plan, and what they were found with.
pub(super) struct Features {
    pub all: Vec<MeasuredFeature>,
    /// Whether what they are sought in was measured, not computed.
    pub is_scan: bool,
    /// The partition, where a report can show it.
    pub drawn: Vec<DrawnFace>,
}

/// The features of data that lie where they are evaluated.
pub(super) fn extracted(
    plan: &Plan,
    data: &Data,
    nominals: &Nominals,
    progress: &dyn Progress,
) -> Result<Features, Stop> {
    let measured = data.measured.as_ref().map(cloud::distinct);
    let measured = measured.as_deref();
    let parted = match measured {
        Some(scan) => Parted::new(plan, scan, nominals, data.seed, progress)?,
        None => None,
    };
    let mut features =
        extract_features::features(plan, (data, measured), nominals, parted.as_ref(), progress)?;
    missing_feature_hint::add(plan, measured, nominals, parted.as_ref(), &mut features, progress)?;
    let shown = parted.as_ref().filter(|_| data.shown > 0);
    let drawn = shown.map_or(vec![], |parted| faces_view::drawn(plan, parted));
    let is_scan = parted.is_none_or(|parted| parted.partition().is_scan);
    Ok(Features { all: features, is_scan, drawn })
}
