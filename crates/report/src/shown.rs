//! What the first view shows.

use super::object::{ViewObject, ViewRole};
use trueness_geom::space::Point;

/// So many times more points than vertices make a reference far coarser than the points.
const MIN_POINTS_PER_VERTEX: usize = 4;
/// Fewer points than these hardly look like the part.
const MIN_POINTS_SHOWN: usize = 2000;

/// Numbers of the objects that the first view shows. A measured mesh is shown with its map. Points are shown if there are enough of them
/// and the reference is far coarser. Else it is the reference that carries the map of the first comparison; without such a map, the points
/// over the plain reference. Of other things, all but what was there before a repair.
pub fn first_view(objects: &[ViewObject]) -> Vec<usize> {
    let mapped = |role| {
        let fits = |o: &&ViewObject| o.role == role && o.mesh().is_some() && o.field(0).is_some();
        objects.iter().find(fits)
    };
    let points = objects.iter().filter(|o| o.role == ViewRole::Measured).filter_map(|o| o.points());
    let points = points.map(<[Point]>::len).sum::<usize>();
    let reference = mapped(ViewRole::Reference);
    let coarse = reference.is_some_and(|r| {
        points
            >= MIN_POINTS_SHOWN
                .max(MIN_POINTS_PER_VERTEX * r.gathered.map_or(r.places().len(), |g| g.vertices))
    });
    let measured = mapped(ViewRole::Measured).is_some() || coarse;
    let shown = |o: &ViewObject| match o.role {
        ViewRole::Measured => measured || reference.is_none(),
        ViewRole::Reference => !measured && (o.comparison.unwrap_or(0) == 0),
        ViewRole::Before | ViewRole::Deviation | ViewRole::Partition => false,
        _ => true,
    };
    (0..).zip(objects).filter(|(_, o)| shown(o)).map(|(n, _)| n).collect()
}

/// The objects that the first view shows.
pub fn shown_objects<'a>(objects: &'a [ViewObject<'a>]) -> Vec<&'a ViewObject<'a>> {
    first_view(objects).into_iter().map(|n| &objects[n]).collect()
}

/// Whether objects show values of the first map.
pub fn mapped(shown: &[&ViewObject]) -> bool {
    shown.iter().any(|o| o.field(0).is_some())
}
