//! A boundary whose faces are cut out of their surfaces: what areas, volumes, facets and distances are taken from.

use crate::agree::agree;
use crate::brep::{Brep, Solid};
use crate::measure::{self, Integrals};
use crate::model::Model;
use crate::tessellate::{Fineness, TessellateError, Tessellation};
use crate::trim::{Trim, TrimError};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Aabb, Point, plus, times};

/// A boundary with the trim of each face, or why it has none.
#[derive(Clone, Debug)]
pub struct Trimmed {
    /// The boundary.
    pub brep: Brep,
    /// One for each face.
    pub trims: Vec<Result<Trim, TrimError>>,
}

impl Trimmed {
    /// All instances of a model where they stand. Progress is told face by face.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn of(model: &Model, progress: &dyn Progress) -> Result<Trimmed, Cancelled> {
        Trimmed::new(model.assembled(), model.uncertainty.unwrap_or(0.0), progress)
    }

    /// Of a boundary; `uncertainty` is what its file says of its lengths, millimeters, 0 if nothing. Progress is told face by face.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(brep: Brep, uncertainty: f64, progress: &dyn Progress) -> Result<Trimmed, Cancelled> {
        let trim = |face| {
            let found = Trim::new(&brep, face, uncertainty);
            progress.advance(1);
            if progress.cancelled() { Err(Cancelled) } else { Ok(found) }
        };
        let trims = brep.faces.par_iter().map(trim).collect::<Result<_, _>>()?;
        Ok(Trimmed { brep, trims })
    }

    /// The same with closed shells that look out of what they enclose where the file contradicts itself; the faces that were turned.
    #[must_use]
    pub fn agreed(mut self) -> (Trimmed, Vec<u32>) {
        let turned = agree(&mut self.brep, &mut self.trims);
        (self, turned)
    }

    /// The trims, `None` for a face that has none.
    pub fn known(&self) -> Vec<Option<&Trim>> {
        self.trims.iter().map(|t| t.as_ref().ok()).collect()
    }

    /// Integrals of each face about one place amid the vertices; `None` for a face without trim. Progress is told face by face.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn integrals(&self, progress: &dyn Progress) -> Result<Vec<Option<Integrals>>, Cancelled> {
        let origin = self.middle();
        let of = |trim: &Result<Trim, TrimError>| {
            let found = trim.as_ref().ok().map(|trim| Integrals::of(trim, origin));
            progress.advance(1);
            if progress.cancelled() { Err(Cancelled) } else { Ok(found) }
        };
        self.trims.par_iter().map(of).collect()
    }

    /// The volume of a solid of this boundary by the integrals of all its faces; `None` where one of its faces has none.
    pub fn volume(&self, solid: &Solid, integrals: &[Option<Integrals>]) -> Option<f64> {
        let shells = std::iter::once(&solid.outer).chain(&solid.voids);
        let mut volume = 0.0;
        for shell in shells {
            for face in &self.brep.shells.get(*shell as usize)?.faces {
                volume += integrals.get(*face as usize)?.as_ref()?.volume;
            }
        }
        Some(volume)
    }

    /// The exact box of all faces that have a trim.
    pub fn bounds(&self) -> Aabb {
        let of = |trim: &Result<Trim, TrimError>| trim.as_ref().map_or(Aabb::EMPTY, measure::bounds);
        let boxes: Vec<Aabb> = self.trims.par_iter().map(of).collect();
        boxes.iter().fold(Aabb::EMPTY, |all, one| all.union(one))
    }

    /// Facets of all faces that have a trim; see [`Tessellation::new`].
    ///
    /// # Errors
    /// [`TessellateError`].
    pub fn tessellate(
        &self,
        fineness: Fineness,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Tessellation, TessellateError> {
        Tessellation::new(&self.brep, &self.known(), fineness, most, progress)
    }

    fn middle(&self) -> Point {
        let places = &self.brep.vertices;
        let sum = places.iter().fold([0.0; 3], |sum, v| plus(sum, v.place));
        times(1.0 / places.len().max(1) as f64, sum)
    }
}
