//! The report of the check of a CAD model.

use super::answers::check_document;
use super::clouds::cube;
use trueness_document::info::CadSurface;
use trueness_geom::space::Point;
use trueness_measure::drawn_faces::{DrawnFace, DrawnFaces};
use trueness_report::{ReportInput, ReportOptions};

/// A cube of 20 mm whose top has an edge across its middle, and none to the right. The top is red.
pub fn page(options: &ReportOptions) -> Vec<u8> {
    let mesh = cube(20.0);
    let face = |n: u64| DrawnFace {
        number: 100 + n,
        name: if n == 1 { "LID".into() } else { String::new() },
        kind: CadSurface::Plane,
        color: (n == 1).then_some([1.0, 0.0, 0.0, 1.0]),
    };
    let corner = |i: u32| mesh.positions[i as usize];
    let across: [Point; 2] = [[0.0, 10.0, 20.0], [20.0, 10.0, 20.0]];
    let ends = [[0, 1], [1, 3], [3, 2], [2, 0], [4, 5], [7, 6], [6, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
    let mut edges: Vec<Vec<Point>> = ends.iter().map(|[a, b]| vec![corner(*a), corner(*b)]).collect();
    edges.push(across.to_vec());
    let of_facet = (0..mesh.faces.len() as u32).map(|facet| facet / 2).collect();
    let faces = DrawnFaces { faces: (0..6).map(face).collect(), of_facet, edges };
    let of_drawing = trueness_measure::model_check::OF_DRAWING.map(String::from).to_vec();
    let document = trueness_document::check::CheckDocument { of_drawing, ..check_document(&mesh) };
    let view = trueness_report::views::check::View::new(&document, "part.stp", &mesh, Default::default());
    let view = view.with_faces(Some(&faces));
    let (objects, marks) = (view.objects(), &view.marks[..]);
    super::bytes(&ReportInput { result: &document, objects: &objects, marks, options })
}
