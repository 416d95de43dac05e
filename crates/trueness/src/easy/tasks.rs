//! The tasks, with their defaults.

use super::error::Error;
use super::part::{Part, as_scan};
use trueness_geom::align::Measured;
use trueness_geom::check::{self, Report};
use trueness_geom::fit::{self, Fit};
use trueness_geom::mesh::Mesh;
use trueness_geom::noise;
use trueness_geom::plane::Plane;
use trueness_geom::progress::Silent;
use trueness_geom::segment::{self, Segmentation};
use trueness_geom::shape::Kind;
use trueness_geom::space::Point;
use trueness_section::{self as section, Contour, SectionError};
use trueness_solid::repair::{self, Repaired};
use trueness_surface::curvature::{self, Curvatures};
use trueness_surface::{self as surface, SurfaceFit};

/// The defects of a mesh with their places: all are counted, the first 1,000 of each kind listed. The facets that the reader left out
/// count as defects too. It is exact for coordinates that are 0 or from 1e-50 to 1e45 mm. A mesh that was not read needs vertices shared by
/// index ([`crate::geom::topology::weld`]). Other limits and options: [`crate::geom::check::check()`].
///
/// # Errors
/// [`Error::Check`]: a facet that names no vertex.
///
/// ```
/// let part = trueness::read("../../corpus/broken/hole_one_triangle.stl")?;
/// let report = trueness::check(&part)?;
/// assert!(!report.sound);
/// assert_eq!(report.count(trueness::geom::check::BOUNDARY_EDGES), 3);
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn check(part: &Part) -> Result<Report, Error> {
    let normals = part.stored_normals.as_deref();
    let mut report = check::check(&part.mesh, normals, &check::Options::default(), &Silent)?;
    let left_out = part.nonfinite_facets.len();
    report.sound &= left_out == 0;
    for (kind, found) in &mut report.defects {
        if let Some(found) = found.as_mut().filter(|_| *kind == check::NOT_FINITE_FACETS) {
            found.count += left_out;
        }
    }
    Ok(report)
}

/// The mesh mended, with all changes; no vertex that stays is moved. Coordinates are 0 or from 1e-50 to 1e45 mm. Options: [`crate::solid::repair::repair()`].
///
/// # Errors
/// [`Error::Repair`]: a facet that names no vertex, coordinates out of range.
///
/// ```
/// let part = trueness::read("../../corpus/broken/hole_one_triangle.stl")?;
/// let mended = trueness::repair(&part.mesh)?;
/// assert!(!mended.before.sound && mended.after.sound);
/// assert_eq!(mended.mesh.faces.len(), part.mesh.faces.len() + 1);
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn repair(mesh: &Mesh) -> Result<Repaired, Error> {
    Ok(repair::repair(mesh, &repair::Options::default(), &Silent)?)
}

/// The element of least squares (orthogonal distances). Kinds in the plane read x and y only. Other methods and options:
/// [`crate::geom::fit::fit()`].
///
/// # Errors
/// [`Error::Fit`]: too few points, a coordinate that is no number, points that determine no such element.
///
/// ```
/// use trueness::{Kind, Shape, fit};
/// let points = [[5.0, 0.0, 1.0], [-5.0, 0.0, 1.0], [0.0, 5.0, 1.0], [0.0, 0.0, 6.0], [0.0, 0.0, -4.0]];
/// let found = fit(&points, Kind::Sphere)?;
/// let Shape::Sphere { center, radius } = found.shape else { panic!("it is a sphere") };
/// assert!((radius - 5.0).abs() < 1e-12 && (center[2] - 1.0).abs() < 1e-12);
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn fit(points: &[Point], kind: Kind) -> Result<Fit, Error> {
    Ok(fit::fit(points, kind, &fit::Options::default(), &Silent)?)
}

/// The planes, cylinders, cones, spheres and tori of a mesh; of one without faces, those of its points. Options:
/// [`crate::geom::segment::mesh()`], [`crate::geom::segment::cloud()`].
///
/// # Errors
/// [`Error::Segment`]: nothing there, a coordinate that is no number.
///
/// ```
/// let part = trueness::read("../../corpus/shapes/trimesh__unit_cube.STL")?;
/// assert_eq!(trueness::segment(&part.mesh)?.regions.len(), 6);
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn segment(mesh: &Mesh) -> Result<Segmentation, Error> {
    let options = segment::Options::default();
    Ok(match as_scan(mesh) {
        Measured::Points { points, .. } => segment::cloud(points, &options, &Silent)?,
        Measured::Mesh(mesh) => segment::mesh(mesh, &options, &Silent)?,
    })
}

/// The lines, arcs and curves of a row of points in order, and the joins between them, with their uncertainties. Options:
/// [`crate::section::contour()`].
///
/// # Errors
/// [`Error::Section`]: too few points, numbers that are none, points out of order.
///
/// ```
/// let line = (0..30).map(|i| [f64::from(i) - 30.0, 0.0]);
/// let rise = (0..30).map(|i| [f64::from(i), f64::from(i)]);
/// let points: Vec<[f64; 2]> = line.chain(rise).collect();
/// let found = trueness::contour(&points)?;
/// assert_eq!((found.segments.len(), found.joins.len()), (2, 1));
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn contour(points: &[[f64; 2]]) -> Result<Contour, Error> {
    Ok(section::contour(points, &section::Options::default(), &Silent)?)
}

/// The lines, arcs and curves in which a plane cuts a mesh, in the frame of the plane ([`Plane::frame`]). Each closed or open chain is a
/// contour. The cut of a drawing's facets is taken as exact, that of a scan as measured. None where the plane misses the mesh. Options:
/// [`crate::section::cut()`], [`crate::section::chain_contour()`].
///
/// # Errors
/// [`Error::Section`]: a coordinate that is no number; a normal without direction.
///
/// ```
/// use trueness::{Plane, read, sections};
/// let cube = read("../../corpus/shapes/trimesh__unit_cube.STL")?.mesh;
/// let found = sections(&cube, &Plane { normal: [0.0, 0.0, 1.0], offset: 0.25 })?;
/// assert_eq!((found.len(), found[0].segments.len()), (1, 4));
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn sections(mesh: &Mesh, plane: &Plane) -> Result<Vec<Contour>, Error> {
    let frame = plane.frame().ok_or(SectionError::NoDirection)?;
    let (options, noise) = (section::Options::default(), noise::mesh(mesh, 0, &Silent).ok());
    let mesh = &section::CutMesh::new(mesh, noise);
    let chains = section::cut(mesh.mesh, plane, &Silent).map_err(SectionError::from)?;
    let each = chains.iter().map(|chain| section::chain_contour(chain, &frame, mesh, &options, &Silent));
    Ok(each.collect::<Result<_, _>>()?)
}

/// The B-spline surface of least squares through scattered points. Options: [`crate::surface::fit()`].
///
/// # Errors
/// [`Error::Surface`]: points that allow no surface.
///
/// ```
/// let place = |k: u32| (f64::from(k % 30), f64::from(k / 30));
/// let points: Vec<[f64; 3]> = (0..900).map(place).map(|(x, y)| [x, y, 0.01 * x * y]).collect();
/// let found = trueness::surface(&points)?;
/// assert!(found.deviations.iter().all(|d| d.abs() < 1e-3));
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn surface(points: &[Point]) -> Result<SurfaceFit, Error> {
    Ok(surface::fit(points, &surface::Options::default(), &Silent)?)
}

/// Curvatures at the vertices of a mesh; of one without faces, at its points. Options: [`crate::surface::curvature::mesh()`],
/// [`crate::surface::curvature::cloud()`].
///
/// # Errors
/// [`Error::Curvature`]: a facet that names no vertex. Single places have their own reasons.
///
/// ```
/// let part = trueness::read("../../corpus/bunny/zipper_res4.ply")?;
/// let found = trueness::curvature(&part.mesh)?;
/// assert_eq!(found.places.len(), part.points().len());
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn curvature(mesh: &Mesh) -> Result<Curvatures, Error> {
    let options = curvature::Options::default();
    Ok(match as_scan(mesh) {
        Measured::Points { points, .. } => curvature::cloud(points, &options, &Silent)?,
        Measured::Mesh(mesh) => curvature::mesh(mesh, &options, &Silent)?,
    })
}
