//! What others are measured against: a mesh, or the exact faces of a CAD model.

use super::deviations::Deviations;
use super::error::Error;
use super::part::{as_scan, of_input};
use crate::read::cad::{self, Chord};
use std::path::Path;
use trueness_document::Role;
use trueness_files::cad::CadFile;
use trueness_files::{Body, ReadOptions, open};
use trueness_geom::align::{Alignment, BestFit, ExactSurface, Target, best_fit};
use trueness_geom::closest::{Closest, Query, Tree};
use trueness_geom::deviation::sign_choice::{SignChoice, SignRequest};
use trueness_geom::deviation::surface::{ReferenceSurface, SurfaceOptions};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Progress, Silent};
use trueness_geom::space::Point;
use trueness_geom::topology::Soundness;
use trueness_measure::cad_faces::CadFaces;

/// A mesh with all that deviations from it need: built once, asked often, from any number of threads. It owns what it holds: the
/// mesh, its search tree (about 120 bytes a facet), and what the sign needs (36 at most). Of a CAD model it holds the exact faces, and
/// the mesh draws them only.
pub struct Reference {
    mesh: Mesh,
    surface: ReferenceSurface,
    exact: Option<Exact>,
}

/// The faces of a CAD model, and what is asked of them.
struct Exact {
    faces: CadFaces,
    options: SurfaceOptions,
    sign: SignChoice,
}

impl Reference {
    /// Of a mesh in millimeters with vertices shared by index, as [`read`](super::part::read) leaves it.
    ///
    /// Distances are exact for any mesh; the sign method is the one that is valid for this one, see [`Reference::sign`].
    /// Cost: that of [`Tree::build`] and of the topology, `n log n`.
    ///
    /// # Errors
    /// [`Error::Mesh`]: no facets, one that names no vertex, a coordinate that is not finite or, but for 0, not from 1e-50 to
    /// 1e60 mm. [`Error::Topology`]: more facets than can be connected.
    ///
    /// ```
    /// # use trueness::{Mesh, Reference};
    /// let positions = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0]];
    /// let reference = Reference::new(Mesh { positions, faces: vec![[0, 1, 2]] })?;
    /// assert_eq!(reference.deviations(&[[1.0, 1.0, -0.25]])?.get(0), Some(Ok(-0.25)));
    /// # Ok::<(), trueness::Error>(())
    /// ```
    pub fn new(mesh: Mesh) -> Result<Reference, Error> {
        Reference::with(mesh, &SurfaceOptions::default(), &Silent)
    }

    /// As [`Reference::new`], with a choice of sign and exclusions; `progress` may stop it.
    ///
    /// # Errors
    /// Those of [`Reference::new`]; a greatest distance that is negative or NaN; cancelled.
    ///
    /// ```
    /// use trueness::geom::progress::Silent;
    /// use trueness::{Exclusion, Mesh, Reference, SignRequest, SurfaceOptions};
    /// let positions = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0]];
    /// let options = SurfaceOptions { sign: SignRequest::None, max_distance: 1.0, skip_boundary: true };
    /// let reference = Reference::with(Mesh { positions, faces: vec![[0, 1, 2]] }, &options, &Silent)?;
    /// let found = reference.deviations(&[[1.0, 1.0, -0.25], [1.0, 1.0, 2.0], [-0.5, 1.0, 0.0]])?;
    /// let all: Vec<_> = found.iter().collect();
    /// assert_eq!(all, [Ok(0.25), Err(Exclusion::MaxDistance), Err(Exclusion::BoundaryEdge)]);
    /// # Ok::<(), trueness::Error>(())
    /// ```
    pub fn with(mesh: Mesh, options: &SurfaceOptions, progress: &dyn Progress) -> Result<Reference, Error> {
        Query { max_distance: options.max_distance, ..Query::default() }.check()?;
        let tree = Tree::build_watched(&mesh, progress)?;
        let surface = ReferenceSurface::new(&tree, &mesh, options, progress)?;
        Ok(Reference { mesh, surface, exact: None })
    }

    /// Of a file: a mesh, or a CAD model, whose faces then are exact. What only draws them lies within a twenty-thousandth of its size.
    ///
    /// # Errors
    /// Those of [`read`](super::part::read) and [`Reference::new`]; [`Error::NoFacets`] for points, [`Error::Incomplete`] for a model
    /// with faces that are not read.
    ///
    /// ```
    /// let reference = trueness::Reference::read("../../corpus/bunny/zipper_res4.ply")?;
    /// assert_eq!(reference.mesh().faces.len(), 948);
    /// assert!(!reference.soundness().closed);
    /// let points = trueness::Reference::read("../../corpus/bunny/scans.ply");
    /// assert!(matches!(points, Err(trueness::Error::NoFacets { .. })));
    /// # Ok::<(), trueness::Error>(())
    /// ```
    pub fn read(path: impl AsRef<Path>) -> Result<Reference, Error> {
        Reference::read_with(path, &SurfaceOptions::default(), &Silent)
    }

    /// As [`Reference::read`], with a choice of sign and exclusions; `progress` may stop it.
    ///
    /// # Errors
    /// Those of [`Reference::read`] and [`Reference::with`].
    pub fn read_with(
        path: impl AsRef<Path>,
        options: &SurfaceOptions,
        progress: &dyn Progress,
    ) -> Result<Reference, Error> {
        let input = open(path.as_ref(), &ReadOptions::default())?;
        if let Body::Cad(file) = input.body {
            return Reference::of_model(path.as_ref(), &file, options, progress);
        }
        let part = of_input(input)?;
        if part.is_cloud() {
            return Err(Error::NoFacets { path: part.provenance.path });
        }
        Reference::with(part.mesh, options, progress)
    }

    fn of_model(
        path: &Path,
        file: &CadFile,
        options: &SurfaceOptions,
        progress: &dyn Progress,
    ) -> Result<Reference, Error> {
        let mut record = cad::record(Role::Reference, path, file);
        let (faces, drawn) = cad::faces(path, file, Chord::MEASURED, &mut record, progress)?;
        if let Some(missing) = record.incomplete {
            return Err(Error::Incomplete { path: record.path, what: missing.text });
        }
        // The facets find places alone: the sign is that of the faces.
        let unsigned = SurfaceOptions { sign: SignRequest::None, ..*options };
        let exact = Exact { faces, options: *options, sign: SignChoice::by_normal(options.sign) };
        Ok(Reference { exact: Some(exact), ..Reference::with(drawn, &unsigned, progress)? })
    }

    /// The mesh; of a CAD model the one that draws its faces.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// How the sign is found, and why so.
    pub fn sign(&self) -> &SignChoice {
        self.exact.as_ref().map_or_else(|| self.surface.sign(), |exact| &exact.sign)
    }

    /// The exact faces, where it is a CAD model.
    pub fn faces(&self) -> Option<&CadFaces> {
        self.exact.as_ref().map(|exact| &exact.faces)
    }

    /// What the topology says about the mesh. The faults of a CAD model are found by [`tasks::check`](crate::tasks::check).
    pub fn soundness(&self) -> &Soundness {
        self.surface.soundness()
    }

    /// The exact deviation of each point from the nearest place of the mesh or the faces. Runs on the current rayon pool.
    ///
    /// # Errors
    /// [`Error::Query`] for a point that is not finite.
    ///
    /// ```
    /// let reference = trueness::Reference::read("../../corpus/shapes/trimesh__unit_cube.STL")?;
    /// let found = reference.deviations(&[[0.0; 3], [0.0, 0.0, 2.0]])?;
    /// assert_eq!(found.iter().collect::<Vec<_>>(), [Ok(-0.5), Ok(1.5)]);
    /// # Ok::<(), trueness::Error>(())
    /// ```
    pub fn deviations(&self, points: &[Point]) -> Result<Deviations, Error> {
        self.deviations_watched(points, &Silent)
    }

    /// As [`Reference::deviations`]; `progress` hears of points and may stop it.
    ///
    /// # Errors
    /// Those of [`Reference::deviations`]; cancelled.
    pub fn deviations_watched(&self, points: &[Point], progress: &dyn Progress) -> Result<Deviations, Error> {
        Ok(Deviations::new(match &self.exact {
            Some(exact) => exact.faces.deviations(points, &exact.options, progress)?,
            None => self.surface.deviations(points, progress)?,
        }))
    }

    /// The nearest place of the mesh. Of a CAD model it is the exact one, and the face is the facet that draws it.
    ///
    /// # Errors
    /// [`Error::Query`] for a point that is not finite.
    ///
    /// ```
    /// # use trueness::{Mesh, Reference};
    /// # let positions = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0]];
    /// let reference = Reference::new(Mesh { positions, faces: vec![[0, 1, 2]] })?;
    /// let nearest = reference.nearest(&[1.0, 2.0, 5.0])?;
    /// assert_eq!((nearest.point, nearest.distance, nearest.face), ([1.0, 2.0, 0.0], 5.0, 0));
    /// # Ok::<(), trueness::Error>(())
    /// ```
    pub fn nearest(&self, point: &Point) -> Result<Closest, Error> {
        let drawn = |p: &Point| {
            let found = self.surface.tree().closest(p, f64::INFINITY)?;
            found.ok_or(Error::Mesh(trueness_geom::closest::MeshError::NoFaces))
        };
        let Some(exact) = &self.exact else { return drawn(point) };
        let near = exact.faces.search.nearest(point);
        let at = if near.distance.is_finite() { near.place } else { *point };
        Ok(Closest { distance: near.distance, point: near.place, ..drawn(&at)? })
    }

    /// The motion that brings a scan onto this mesh or these faces, from any starting pose, with its uncertainty and warnings. A scan without
    /// facets is a cloud of points.
    ///
    /// # Errors
    /// [`Error::Align`]: fewer than three points, all on one line, a coordinate out of range, no point near the mesh.
    ///
    /// ```
    /// use trueness::{Reference, geom::rigid::Rigid, read};
    /// let reference = Reference::read("../../corpus/bunny/zipper_res4.ply")?;
    /// let mut scan = read("../../corpus/bunny/zipper_res3.ply")?;
    /// let turn = Rigid::rotation_about([0.0, 0.1, 0.0], [0.3, -2.0, 1.0]);
    /// scan.mesh.positions.iter_mut().for_each(|p| *p = turn.point(*p));
    /// let found = reference.align(&scan.mesh)?;
    /// assert!(found.reference_from_measured.after(&turn).angle() < 0.01);
    /// # Ok::<(), trueness::Error>(())
    /// ```
    pub fn align(&self, scan: &Mesh) -> Result<Alignment, Error> {
        let exact = self.faces().map(|faces| faces as &dyn ExactSurface);
        let target = Target::new(&self.mesh, self.surface.tree()).drawing(exact);
        Ok(best_fit(&as_scan(scan), &target, &BestFit::default(), &Silent)?)
    }
}

impl std::fmt::Debug for Reference {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Reference")
            .field("facets", &self.mesh.faces.len())
            .field("sign", self.sign())
            .finish()
    }
}
