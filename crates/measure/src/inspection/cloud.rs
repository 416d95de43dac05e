//! The places of a measured cloud.

use std::borrow::Cow;
use trueness_geom::scan::Scan;
use trueness_geom::topology::weld::first_at_their_places;

/// A cloud with each place once: copies of a point tell nothing new, and neighbors that are copies tell nothing at all. A mesh as it is.
pub(super) fn distinct(scan: &Scan) -> Cow<'_, Scan> {
    let Scan::Cloud(points) = scan else { return Cow::Borrowed(scan) };
    let numbers = first_at_their_places(points);
    if numbers.len() == points.len() {
        return Cow::Borrowed(scan);
    }
    Cow::Owned(Scan::Cloud(numbers.iter().map(|n| points[*n as usize]).collect()))
}
