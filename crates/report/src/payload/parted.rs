//! Surfaces of faces: each vertex is of one face, so that a reader learns of every place which face it is on.

use super::super::{Geometry, NoValue, ObjectFaces, ViewField, ViewObject};
use super::blob::ByteKind;
use super::contents::Payload;
use super::entry::{FaceEntry, FacesEntry, LinesEntry};
use super::grid::Grid;
use super::mesh::{MeshBytes, Ordered};
use super::planes::pack;
use trueness_document::scale::palette::hex;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::Point;
use trueness_measure::drawn_faces::{DrawnFace, DrawnFaces};

/// A surface parted where its faces meet.
pub struct Parted {
    mesh: Mesh,
    /// Of each vertex its face.
    face: Vec<u32>,
    values: Vec<Vec<f64>>,
    reasons: Vec<Vec<NoValue>>,
    keep: Vec<u32>,
}

impl Parted {
    /// A vertex that several faces meet in becomes one of each.
    pub fn of(object: &ViewObject, mesh: &Mesh, faces: &ObjectFaces) -> Parted {
        let corners = || {
            let of = |(facet, face): (&[u32; 3], &u32)| facet.map(|v| (v, *face));
            mesh.faces.iter().zip(faces.of_facet).map(of)
        };
        let mut vertices: Vec<(u32, u32)> =
            corners().flatten().filter(|(v, _)| (*v as usize) < mesh.positions.len()).collect();
        vertices.par_sort_unstable();
        vertices.dedup();
        let number = |corner: (u32, u32)| vertices.binary_search(&corner).map_or(u32::MAX, |n| n as u32);
        let at = |v: &(u32, u32)| v.0 as usize;
        let kept = (0u32..).zip(&vertices).filter(|(_, v)| object.keep.binary_search(&v.0).is_ok());
        Parted {
            mesh: Mesh {
                positions: vertices.iter().map(|v| mesh.positions[at(v)]).collect(),
                faces: corners().map(|facet| facet.map(number)).collect(),
            },
            face: vertices.iter().map(|v| v.1).collect(),
            values: object.fields.iter().map(|f| vertices.iter().map(|v| f.at(at(v)).0).collect()).collect(),
            reasons: object.fields.iter().map(|f| vertices.iter().map(|v| f.at(at(v)).1).collect()).collect(),
            keep: kept.map(|(n, _)| n).collect(),
        }
    }

    /// The surface.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The object with that surface.
    pub fn object<'a>(&'a self, whole: &ViewObject<'a>) -> ViewObject<'a> {
        let field = |(n, f): (usize, &ViewField)| ViewField {
            comparison: f.comparison,
            values: &self.values[n],
            reasons: &self.reasons[n],
        };
        ViewObject {
            geometry: Geometry::Mesh(&self.mesh),
            fields: whole.fields.iter().enumerate().map(field).collect(),
            keep: &self.keep,
            name: whole.name,
            ..*whole
        }
    }

    /// The faces, that of each vertex in the order of the drawn ones, and lines along edges.
    pub fn entry(
        &self,
        part: &mut Payload,
        drawn: &DrawnFaces,
        (ordered, bytes, grid): (&Ordered, &MeshBytes, &Grid),
    ) -> FacesEntry {
        let own: Vec<i32> = ordered.source.iter().map(|v| self.face[*v as usize] as i32).collect();
        let of = part.add(&bytes.numbers(&own, 3), ByteKind::Differences);
        FacesEntry {
            list: drawn.faces.iter().map(face_entry).collect(),
            of,
            lines: lines_entry(part, &drawn.edges, grid),
        }
    }
}

fn face_entry(face: &DrawnFace) -> FaceEntry {
    let byte = |x: f32| (255.0 * x.clamp(0.0, 1.0)).round() as u8;
    let color = face.color.map(|[r, g, b, _]| hex([r, g, b].map(byte)));
    FaceEntry { number: face.number, name: face.name.clone(), kind: face.kind.name(), color }
}

/// Places of all lines one after another, and how many each has.
fn lines_entry(part: &mut Payload, lines: &[Vec<Point>], grid: &Grid) -> LinesEntry {
    let places: Vec<[u16; 3]> = lines.iter().flatten().map(|p| grid.place(p)).collect();
    let coordinate = |k: usize| {
        let at = |i: usize| i32::from(places[i][k]);
        pack((0..places.len()).into_par_iter().map(|i| at(i) - if i > 0 { at(i - 1) } else { 0 }), 2)
    };
    let positions = [0, 1, 2].map(coordinate).concat();
    let counts = pack((0..lines.len()).into_par_iter().map(|i| lines[i].len() as i32), 3);
    LinesEntry {
        lines: lines.len(),
        points: places.len(),
        positions: part.add(&positions, ByteKind::Differences),
        counts: part.add(&counts, ByteKind::Differences),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_document::info::CadSurface;

    /// Two squares with a common side: its ends are two vertices each, with the values of both.
    #[test]
    fn a_vertex_of_two_faces_is_one_of_each() {
        let positions: Vec<Point> =
            (0..6).map(|i| [f64::from(i / 2), f64::from(i % 2), f64::from(u8::from(i > 3))]).collect();
        let mesh = Mesh { positions, faces: vec![[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]] };
        let face = |number| DrawnFace { number, name: String::new(), kind: CadSurface::Plane, color: None };
        let drawn = DrawnFaces { faces: vec![face(7), face(9)], of_facet: vec![0, 0, 1, 1], edges: vec![] };
        let values = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let whole = ViewObject {
            geometry: Geometry::Mesh(&mesh),
            fields: vec![ViewField { comparison: 0, values: &values, reasons: &[] }],
            keep: &[3],
            ..ViewObject::measured(&[])
        };
        let faces = ObjectFaces { drawn: &drawn, of_facet: &drawn.of_facet };
        let parted = Parted::of(&whole, &mesh, &faces);
        assert_eq!(parted.mesh.positions.len(), 8);
        let object = parted.object(&whole);
        for (facet, (before, face)) in parted.mesh.faces.iter().zip(mesh.faces.iter().zip(&drawn.of_facet)) {
            for k in 0..3 {
                let v = facet[k] as usize;
                assert_eq!(parted.mesh.positions[v], mesh.positions[before[k] as usize]);
                assert_eq!(parted.face[v], *face);
                assert_eq!(object.fields[0].values[v], values[before[k] as usize]);
            }
        }
        assert_eq!(parted.keep.len(), 2);
        assert!(parted.keep.iter().all(|v| object.fields[0].values[*v as usize] == 3.0));
    }
}
