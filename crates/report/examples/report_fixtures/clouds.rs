//! Reports of measured points against references far coarser than the points are apart, compared by the program itself.

use super::{record, uv_sphere, written};
use std::collections::BTreeMap;
use std::convert::Infallible;
use std::path::Path;
use trueness_document::Role;
use trueness_document::compare::MeasuredKind;
use trueness_document::tolerance::Tolerance;
use trueness_geom::cloud::PointStream;
use trueness_geom::deviation::surface::SurfaceOptions;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;
use trueness_measure::compare::{self, Inputs, Options, Reference};
use trueness_measure::file_numbers::LeftOut;
use trueness_report as report;
use trueness_report::views::compare::View;
use trueness_report::{ReportInput, ReportOptions};

/// Writes them all.
pub fn write_all(folder: &Path) {
    let dent = dented_cube(30_000, |_| true);
    written(folder, "dent", page(&dent, &cube(20.0), 0.1));
    // Nothing was measured where x is above 12.
    written(folder, "half_dent", page(&dented_cube(30_000, |p| p[0] < 12.0), &cube(20.0), 0.1));
    written(folder, "scratch", page(&scratched_cube(30_000), &cube(20.0), 0.1));
    let few: Vec<Point> = dent.iter().step_by(25).copied().collect();
    written(folder, "few", page(&few, &cube(20.0), 0.1));
    written(folder, "dense", page(&a_million(), &fine_cube(170), 0.1));
    written(folder, "bunny", page(&bunny_scans(), &bunny_model(), 0.5));
    // Coarser than the points, but not far coarser: the map is on the reference.
    written(folder, "sphere_points", page(&uv_sphere(200).positions, &uv_sphere(110), 0.05));
}

/// The points, all at once.
struct Once(Option<Vec<Point>>);

impl PointStream for Once {
    type Error = Infallible;
    fn expected(&self) -> Option<u64> {
        self.0.as_ref().map(|p| p.len() as u64)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<(), Infallible> {
        *block = self.0.take().unwrap_or_default();
        Ok(())
    }
}

/// The report of a comparison of points, as the program makes it.
pub fn page(points: &[Point], reference: &Mesh, tolerance: f64) -> Vec<u8> {
    let options = Options {
        surface: SurfaceOptions::default(),
        tolerance: Some(Tolerance { lower: -tolerance, upper: tolerance }),
        shown: 1_000_000,
        ..Options::default()
    };
    let references = [Reference {
        name: "nominal.stl".into(),
        mesh: reference,
        exact: None,
        left_out: LeftOut::default(),
    }];
    let sink = |_: &compare::DeviationBlock| Ok::<(), Infallible>(());
    let found = compare::run(&mut Once(Some(points.to_vec())), &references, &options, &Silent, sink).unwrap();
    let files = vec![
        record(Role::Measured, "points.xyz", points.len(), None),
        record(Role::Reference, "nominal.stl", reference.positions.len(), Some(reference.faces.len() as u64)),
    ];
    let inputs = Inputs {
        files,
        kind: MeasuredKind::Points,
        scale: None,
        reverse: vec![],
        alignment: None,
        doubts: vec![],
    };
    let document = compare::document(&found, inputs, &options);
    let view = View::new("points.xyz", None, &references, &found);
    let (objects, marks) = (view.objects(), view.marks(&document));
    let options = ReportOptions::default();
    let input = ReportInput { result: &document, objects: &objects, marks: &marks, options: &options };
    let mut page = vec![];
    report::write(&input, &Silent, &mut page).unwrap();
    page
}

/// A cube from the origin, in 12 facets.
pub fn cube(side: f64) -> Mesh {
    let positions = (0..8u32).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|b| side * f64::from(b))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    let faces = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Mesh { positions, faces }
}

/// Points on the cube of 20 mm with a noise of 0.02 mm, and a dent of 0.5 mm in the middle of the top.
fn dented_cube(n: usize, wanted: impl Fn(&Point) -> bool) -> Vec<Point> {
    let mut random = Random::new(7);
    let mut points = vec![];
    while points.len() < n {
        let (axis, high) = (random.below(3) as usize, random.below(2) == 1);
        let mut p = [0.0; 3].map(|_: f64| 20.0 * random.unit());
        p[axis] = if high { 20.0 } else { 0.0 } + 0.04 * (random.unit() - 0.5);
        if axis == 2 && high {
            p[2] -= 0.5 * (-((p[0] - 10.0).powi(2) + (p[1] - 10.0).powi(2)) / 4.0).exp();
        }
        if wanted(&p) {
            points.push(p);
        }
    }
    points
}

/// A cube of 20 mm whose faces are cut into `n` × `n` squares of two facets each.
fn fine_cube(n: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let mut numbers = BTreeMap::new();
    for (axis, high) in (0..3usize).flat_map(|axis| [0, n].map(|high| (axis, high))) {
        let mut vertex = |i: u32, j: u32| {
            let mut place = [0; 3];
            (place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]) = (high, i, j);
            *numbers.entry(place).or_insert_with(|| {
                mesh.positions.push(place.map(|x| 20.0 * f64::from(x) / f64::from(n)));
                mesh.positions.len() as u32 - 1
            })
        };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            mesh.faces.extend(if high > 0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
        }
    }
    mesh
}

/// A million points 0.02 mm before or behind the faces of that cube, at random; but for 25 single ones, which lie 0.3 mm under
/// the top at every third millimeter from 4 to 16.
fn a_million() -> Vec<Point> {
    let mut random = Random::new(3);
    let mut point = |_| {
        let (axis, high) = (random.below(3) as usize, random.below(2) == 1);
        let mut p = [0.0; 3].map(|_: f64| 20.0 * random.unit());
        p[axis] = if high { 20.0 } else { 0.0 } + if random.below(2) == 1 { 0.02 } else { -0.02 };
        p
    };
    let mut points: Vec<Point> = (0..1_000_000).map(&mut point).collect();
    let single = |k: usize| [4.0 + 3.0 * (k % 5) as f64, 4.0 + 3.0 * (k / 5) as f64, 19.7];
    (0..25).for_each(|k| points[40_000 * k] = single(k));
    points
}

/// The same without the dent, and on the top instead a scratch across the middle, 0.24 mm wide and 0.6 mm deep: narrower than
/// the points are apart.
fn scratched_cube(n: usize) -> Vec<Point> {
    let mut random = Random::new(7);
    let mut point = || {
        let (axis, high) = (random.below(3) as usize, random.below(2) == 1);
        let mut p = [0.0; 3].map(|_: f64| 20.0 * random.unit());
        p[axis] = if high { 20.0 } else { 0.0 } + 0.04 * (random.unit() - 0.5);
        if axis == 2 && high && (p[1] - 10.0 - 0.2 * (p[0] - 10.0)).abs() < 0.12 {
            p[2] -= 0.6;
        }
        p
    };
    (0..n).map(|_| point()).collect()
}

/// Numbers of a binary PLY after its header.
fn after_header(name: &str) -> (Vec<u8>, usize) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/bunny").join(name);
    let bytes = std::fs::read(path).unwrap();
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    (bytes, start)
}

fn point(bytes: &[u8]) -> Point {
    [0, 4, 8].map(|k| f64::from(f32::from_le_bytes(bytes[k..k + 4].try_into().unwrap())))
}

fn bunny_scans() -> Vec<Point> {
    let (bytes, start) = after_header("scans.ply");
    bytes[start..].chunks_exact(13).map(point).collect()
}

/// The coarsest model: 453 vertices, 948 facets.
fn bunny_model() -> Mesh {
    let (bytes, start) = after_header("zipper_res4.ply");
    let (vertices, faces) = bytes[start..].split_at(453 * 12);
    let face = |b: &[u8]| [1, 5, 9].map(|k| u32::from_le_bytes(b[k..k + 4].try_into().unwrap()));
    Mesh {
        positions: vertices.chunks_exact(12).map(point).collect(),
        faces: faces.chunks_exact(13).map(face).collect(),
    }
}
