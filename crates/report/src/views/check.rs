//! What a report draws of a check: the mesh, and every listed defect on it.

use crate::{Geometry, Mark, MarkGroup, Marks, ObjectFaces, ViewObject, ViewRole};
use trueness_document::check::{CheckDocument, Defects, Item};
use trueness_document::scale::palette::category;
use trueness_geom::check::{DefectKind, Shows};
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Point, cross, minus, plus, unit};
use trueness_geom::topology::Topology;
use trueness_measure::check::found;
use trueness_measure::drawn_faces::DrawnFaces;
use trueness_measure::file_numbers::LeftOut;

/// A checked mesh prepared for drawing.
pub struct View<'a> {
    name: &'a str,
    mesh: &'a Mesh,
    faces: Option<&'a DrawnFaces>,
    /// The defects, in the order of the document's kinds found, item by item.
    pub marks: Vec<Marks>,
}

impl<'a> View<'a> {
    /// Of the mesh that the document is of, without the facets `left_out` of the file; `name` is shown to the reader.
    pub fn new(document: &CheckDocument, name: &'a str, mesh: &'a Mesh, left_out: LeftOut) -> View<'a> {
        let groups = groups(&found(&document.defects), mesh, left_out);
        let marks = Marks { role: ViewRole::Defects, comparison: None, groups };
        View { name, mesh, faces: None, marks: vec![marks] }
    }

    /// The same of a CAD model with these faces.
    pub fn with_faces(self, faces: Option<&'a DrawnFaces>) -> View<'a> {
        View { faces, ..self }
    }

    /// The mesh.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let geometry = Geometry::Mesh(self.mesh);
        vec![ViewObject {
            role: ViewRole::Part,
            name: self.name,
            color: None,
            comparison: None,
            geometry,
            fields: vec![],
            keep: &[],
            gathered: None,
            faces: self.faces.map(|drawn| ObjectFaces { drawn, of_facet: &drawn.of_facet }),
        }]
    }
}

/// The listed defects of each kind found in a mesh.
pub(crate) fn groups(found: &[(&DefectKind, &Defects)], mesh: &Mesh, left_out: LeftOut) -> Vec<MarkGroup> {
    let mut shells = Shells::default();
    let group = |(n, (kind, defects)): (usize, &(&DefectKind, &Defects))| MarkGroup {
        key: format!("defect.{}", kind.name),
        color: category(n),
        items: defects.items.iter().map(|item| mark(mesh, kind.shows, item, left_out, &mut shells)).collect(),
    };
    found.iter().enumerate().map(group).collect()
}

fn mark(mesh: &Mesh, shows: Shows, item: &Item, left_out: LeftOut, shells: &mut Shells) -> Mark {
    let own: Vec<u32> = item.facets.iter().map(|f| left_out.in_mesh(*f)).collect();
    let place = |v: &u32| mesh.positions.get(*v as usize).copied();
    let vertices: Vec<Point> = item.vertices.iter().filter_map(place).collect();
    let normal = if shows == Shows::Ring { opening(&vertices) } else { normal(mesh, &own) };
    let mut mark = Mark { normal, ..Mark::default() };
    let facets = |mark: &mut Mark| {
        own.iter().filter_map(|f| corners(mesh, *f)).for_each(|t| mark.add_facet(t));
    };
    match shows {
        Shows::Points => mark.points.extend(&vertices),
        Shows::Line => mark.add_line(&vertices, false),
        Shows::Ring => mark.add_line(&vertices, true),
        Shows::PointAndLine => match &vertices[..] {
            [point, line @ ..] => {
                mark.points.push(*point);
                mark.add_line(line, false);
            }
            [] => facets(&mut mark),
        },
        Shows::Shell => {
            let facets = shells.of(mesh, own.first().copied());
            mark.triangles.extend(facets.into_iter().filter_map(|f| corners(mesh, f)));
        }
        Shows::Facets => facets(&mut mark),
    }
    mark.finite()
}

fn corners(mesh: &Mesh, facet: u32) -> Option<[Point; 3]> {
    let [a, b, c] = mesh.faces.get(facet as usize)?.map(|v| mesh.positions.get(v as usize).copied());
    Some([a?, b?, c?])
}

/// Mean of the facets' normals by area.
fn normal(mesh: &Mesh, facets: &[u32]) -> Option<Point> {
    let of = |f: &u32| corners(mesh, *f).map(|[a, b, c]| cross(minus(b, a), minus(c, a)));
    let sum = facets.iter().filter_map(of).fold([0.0; 3], plus);
    unit(sum).map(|(n, _)| n).filter(|n| n.iter().all(|x| x.is_finite()))
}

/// Which way an opening looks: its rim runs as the facets do, so seen from outside it goes clockwise.
fn opening(ring: &[Point]) -> Option<Point> {
    let (first, rest) = ring.split_first()?;
    let fan = rest.windows(2).map(|p| cross(minus(p[1], *first), minus(p[0], *first)));
    unit(fan.fold([0.0; 3], plus)).map(|(n, _)| n).filter(|n| n.iter().all(|x| x.is_finite()))
}

/// Which facets hang together; found out when first asked for.
#[derive(Default)]
struct Shells(Option<Vec<u32>>);

impl Shells {
    /// The facets of the shell that `facet` is of.
    fn of(&mut self, mesh: &Mesh, facet: Option<u32>) -> Vec<u32> {
        let of = self.0.get_or_insert_with(|| Topology::of(mesh).map_or(vec![], |t| t.shell_of));
        let Some(shell) = facet.and_then(|f| of.get(f as usize)) else { return vec![] };
        (0..).zip(of.iter()).filter(|(_, s)| *s == shell).map(|(f, _)| f).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_document::{InputRecord, Role};
    use trueness_geom::check::{Options, check};
    use trueness_geom::progress::Silent;
    use trueness_measure::check::document;

    fn drawn(mesh: &Mesh) -> Vec<(String, Vec<[usize; 3]>)> {
        let report = check(mesh, None, &Options::default(), &Silent).unwrap();
        let file = InputRecord::of_no_file(Role::Mesh);
        let document =
            document(&report, file, mesh.faces.len() as u64, LeftOut::default(), &Options::default());
        let view = View::new(&document, "x", mesh, LeftOut::default());
        let sizes = |m: &Mark| [m.triangles.len(), m.segments.len(), m.points.len()];
        let groups = view.marks[0].groups.iter();
        groups.map(|g| (g.key.clone(), g.items.iter().map(sizes).collect())).collect()
    }

    fn tetrahedron(faces: &[[u32; 3]]) -> Mesh {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Mesh { positions, faces: faces.to_vec() }
    }

    #[test]
    fn a_hole_is_a_ring_and_its_edges_are_lines() {
        let open = tetrahedron(&[[0, 2, 1], [0, 1, 3], [1, 2, 3]]);
        let drawn = drawn(&open);
        let of = |key: &str| drawn.iter().find(|(k, _)| k == key).map(|(_, items)| items.clone());
        assert_eq!(of("defect.holes").unwrap(), [[0, 3, 0]]);
        assert_eq!(of("defect.boundary_edges").unwrap(), [[0, 1, 0]; 3]);
        assert_eq!(of("defect.dangling_facets").unwrap(), [[1, 3, 0]; 3]);
    }

    #[test]
    fn an_opening_looks_outwards() {
        // The face that is gone looked down.
        let open = tetrahedron(&[[0, 1, 3], [1, 2, 3], [0, 3, 2]]);
        let topology = Topology::of(&open).unwrap();
        let rim: Vec<[u32; 2]> = topology.boundary_edges.iter().map(|e| e.vertices).collect();
        let next = |v: u32| rim.iter().find(|e| e[0] == v).unwrap()[1];
        let ring = [0, next(0), next(next(0))].map(|v| open.positions[v as usize]);
        assert_eq!(opening(&ring), Some([0.0, 0.0, -1.0]));
    }

    #[test]
    fn a_shell_is_all_its_facets() {
        let inside_out = tetrahedron(&[[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]);
        assert_eq!(drawn(&inside_out), [("defect.inside_out_shells".to_string(), vec![[4, 0, 0]])]);
    }
}
