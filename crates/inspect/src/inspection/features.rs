//! The features of a plan in the measured data.

use super::cloud;
use super::data::{Data, Stop};
use super::nearby;
use super::nominals::Nominals;
use super::parted::Parted;
use super::take;
use crate::characteristic::Taken;
use crate::plan::Plan;
use trueness_geom::progress::Progress;

/// The features of data that lie where they are evaluated, and whether what they are sought in was measured, not computed.
pub(super) fn taken(
    plan: &Plan,
    data: &Data,
    nominals: &Nominals,
    progress: &dyn Progress,
) -> Result<(Vec<Taken>, bool), Stop> {
    let measured = data.measured.as_ref().map(cloud::distinct);
    let measured = measured.as_deref();
    let parted = match measured {
        Some(mesh) => Parted::new(plan, mesh, nominals, data.seed, progress)?,
        None => None,
    };
    let mut features = take::features(plan, (data, measured), nominals, parted.as_ref(), progress)?;
    nearby::tell(plan, measured, nominals, parted.as_ref(), &mut features, progress)?;
    Ok((features, parted.is_none_or(|parted| parted.is_scan())))
}
