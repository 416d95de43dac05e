//! Nominal features: elements within bounds, how near to them measured facets and points must lie, and how much of them was measured.
//!
//! After Xu and Yang, A digital quality characterization technique for 3D printing based on the STL model (in Chinese), section 3. Which of those near
//! a feature are its own the [partition](crate::partition) of the whole scan tells.

mod bounds;
mod covered;
mod extent;
mod found;
mod nominal;
mod rules;
mod surface;

pub use covered::{covered, farthest_covered};
pub(crate) use extent::Extent;
pub use found::Found;
pub use nominal::{FeatureError, Nearness, Nominal};
pub use surface::NominalSurface;

use crate::mesh::Mesh;
use crate::space::{Aabb, Point, normal};
use rules::Rules;

/// The points of a cloud that belong to `nominal`: those near it and within its bounds. A cloud without normals does not
/// tell which way it faces; what lies behind a thin wall is kept apart by the distance alone.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
///
/// ```
/// use trueness_geom::feature::{Nearness, Nominal, in_cloud};
/// let pin = Nominal::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 1.0], radius: 2.0, length: 9.0 };
/// let near = Nearness { distance: 0.1, angle: 0.2, margin: 1.0, rim: true, inward: None };
/// let points = [[2.05, 0.0, 3.0], [2.05, 0.0, 0.5], [2.2, 0.0, 3.0]];
/// assert_eq!(in_cloud(&points, &pin, &near)?.points, [0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn in_cloud(points: &[Point], nominal: &Nominal, near: &Nearness) -> Result<Found, FeatureError> {
    let rules = Rules::new(nominal, near)?;
    let bounds = rules.bounds();
    let is_near = |p: &Point| bounds.holds(p) && rules.point(*p);
    let points = (0..points.len() as u32).filter(|i| is_near(&points[*i as usize])).collect();
    Ok(Found { points, ..Found::default() })
}

/// The facets, out of some of a mesh, that are near `nominal`. Their corners are as near to it as that says and within its
/// bounds, and they face as it does. Facets without area are none.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
///
/// ```
/// use trueness_geom::feature::{Nearness, Nominal, facets_near};
/// use trueness_geom::mesh::Mesh;
/// // A square floor of two facets, and a wall.
/// let corners = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
/// let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary: corners.clone() };
/// let near = Nearness { distance: 0.1, angle: 0.2, margin: 0.0, rim: true, inward: None };
/// let positions = [corners, vec![[0.0, 0.0, 9.0]]].concat();
/// let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3], [0, 4, 1]] };
/// assert_eq!(facets_near(&mesh, &[0, 1, 2], &floor, &near)?, [0, 1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn facets_near(
    mesh: &Mesh,
    facets: &[u32],
    nominal: &Nominal,
    near: &Nearness,
) -> Result<Vec<u32>, FeatureError> {
    let rules = Rules::new(nominal, near)?;
    let bounds = rules.bounds();
    let is_near = |f: &u32| {
        let corners = mesh.faces.get(*f as usize)?.map(|v| mesh.positions.get(v as usize).copied());
        let [Some(a), Some(b), Some(c)] = corners else { return None };
        let inside = [a, b, c].iter().all(|p| bounds.holds(p));
        Some(inside && rules.facet([a, b, c], normal([a, b, c])?))
    };
    Ok(facets.iter().copied().filter(|f| is_near(f) == Some(true)).collect())
}

/// The box around a nominal feature.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
///
/// ```
/// use trueness_geom::feature::{Nominal, bounds_of};
/// let ball = Nominal::Sphere { center: [0.0; 3], radius: 3.0 };
/// assert!(bounds_of(&ball)?.holds(&[0.0, -3.0, 0.0]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bounds_of(nominal: &Nominal) -> Result<Aabb, FeatureError> {
    Ok(Extent::new(nominal)?.bounds())
}

/// Places all over a nominal feature: of a plane those of a grid within its boundary, of what is round some on rings.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
///
/// ```
/// use trueness_geom::feature::{Nominal, places_over};
/// let ball = Nominal::Sphere { center: [0.0; 3], radius: 3.0 };
/// assert!(places_over(&ball)?.iter().all(|[x, y, z]| ((x * x + y * y + z * z).sqrt() - 3.0).abs() < 1e-12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn places_over(nominal: &Nominal) -> Result<Vec<Point>, FeatureError> {
    Ok(Extent::new(nominal)?.places())
}
