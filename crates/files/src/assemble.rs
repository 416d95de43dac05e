//! From the vertices and faces of a file to a mesh.

use crate::{
    Warning,
    error::{Fault, Located, Result},
    polygon::{Cut, triangulate},
};
use trueness_geom::parallel::prelude::*;
use trueness_geom::{
    mesh::Mesh,
    space::Point,
    topology::weld::{self, Position, WeldError},
};

/// Gathers the faces of an indexed file, cutting polygons as they come.
#[derive(Default)]
pub(crate) struct Faces {
    pub triangles: Vec<[u32; 3]>,
    polygons: u64,
    somehow: u64,
    slight: u64,
}

impl Faces {
    /// Takes one face of any number of corners, all of them valid indices into `positions`.
    ///
    /// Triangles keep the corner they begin with.
    pub fn push(&mut self, positions: &[Point], corners: &[u32]) {
        match *corners {
            [a, b, c] => self.triangles.push([a, b, c]),
            [] | [_] | [_, _] => self.slight += 1,
            _ => {
                self.polygons += 1;
                let cut = triangulate(positions, corners, |t| self.triangles.push(t));
                self.somehow += u64::from(cut == Cut::Somehow);
            }
        }
    }

    /// Takes all faces of another gathering, behind its own.
    pub fn append(&mut self, mut later: Faces) {
        if self.triangles.is_empty() {
            std::mem::swap(&mut self.triangles, &mut later.triangles);
        }
        self.triangles.append(&mut later.triangles);
        self.polygons += later.polygons;
        self.somehow += later.somehow;
        self.slight += later.slight;
    }

    /// Whether no face has come yet.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.slight == 0
    }

    /// The mesh, welded if asked for; adds the warnings about it.
    pub fn mesh(self, positions: Vec<Point>, weld: bool, warnings: &mut Vec<Warning>) -> Result<Mesh> {
        if self.polygons > 0 {
            warnings.push(Warning::Polygons { count: self.polygons });
        }
        if self.somehow > 0 {
            warnings.push(Warning::CutSomehow { count: self.somehow });
        }
        if self.slight > 0 {
            warnings.push(Warning::Slight { count: self.slight });
        }
        let mesh = Mesh { positions, faces: self.triangles };
        if weld { welded(mesh, warnings) } else { Ok(mesh) }
    }
}

/// Checks that so many vertices can be numbered.
pub(crate) fn numbered(what: &'static str, count: u64) -> Result<()> {
    let limit = u64::from(u32::MAX);
    if count > limit { Err(Fault::TooMany { what, count, limit }.into()) } else { Ok(()) }
}

/// Joins vertices at the same place. Where there are none, the mesh keeps its own order of vertices.
fn welded(mesh: Mesh, warnings: &mut Vec<Warning>) -> Result<Mesh> {
    let before = mesh.positions.len();
    let joined = weld::mesh(&mesh).map_err(|e| too_many(&e, mesh.faces.len()))?.mesh;
    if joined.positions.len() == before {
        return Ok(mesh);
    }
    warnings.push(Warning::Joined { before: before as u64, after: joined.positions.len() as u64 });
    Ok(joined)
}

/// Joins vertices within `distance` of one another.
pub(crate) fn within(mesh: &Mesh, distance: f64, warnings: &mut Vec<Warning>) -> Result<Mesh> {
    let before = mesh.positions.len();
    let joined = weld::within(mesh, distance).map_err(|e| too_many(&e, mesh.faces.len()))?.mesh;
    if joined.positions.len() < before {
        warnings.push(Warning::Welded {
            distance,
            before: before as u64,
            after: joined.positions.len() as u64,
        });
    }
    Ok(joined)
}

/// Position of a corner as a file holds it.
pub(crate) trait Corner: Position {
    fn widened(self) -> Point;
}
impl Corner for [f32; 3] {
    fn widened(self) -> Point {
        self.map(f64::from)
    }
}
impl Corner for Point {
    fn widened(self) -> Point {
        self
    }
}

/// Facets given by the positions of their corners become a mesh: welded, or three vertices each.
pub(crate) fn corners<P: Corner>(
    facets: usize,
    corner: impl Fn(usize, usize) -> P + Sync,
    weld: bool,
) -> Result<Mesh> {
    if weld {
        return weld::corners(facets, corner).map_err(|e| too_many(&e, facets));
    }
    numbered("corners of facets", 3 * facets as u64)?;
    let positions = (0..3 * facets).into_par_iter().map(|c| corner(c / 3, c % 3).widened()).collect();
    let faces = (0..facets as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    Ok(Mesh { positions, faces })
}

fn too_many(error: &WeldError, facets: usize) -> Located {
    match *error {
        WeldError::TooManyFacets { .. } => {
            Fault::TooMany { what: "facets", count: facets as u64, limit: weld::MAX_FACETS as u64 }.into()
        }
        WeldError::NoSuchVertex { vertex, vertices, .. } => {
            Fault::NoSuchVertex { index: i64::from(vertex), count: vertices as u64 }.into()
        }
    }
}
