//! Which points count, and what they do not cover, through the whole comparison.

use super::*;
use crate::file_numbers::LeftOut;
use std::convert::Infallible;
use trueness_document::compare::{CompareDocument, MeasuredKind};
use trueness_document::{InputRecord, Role};
use trueness_geom::cloud::Whole;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::{cross, minus, norm};

/// A cube from the origin, in 12 facets.
fn cube(side: f64) -> Mesh {
    let positions = (0..8u32).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|b| side * f64::from(b))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    let faces = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Mesh { positions, faces }
}

/// Points on five sides of the cube, with 0.01 mm of noise; nothing on the upper one.
fn open_at_the_top(n: usize, side: f64) -> Vec<Point> {
    let mut random = Random::new(3);
    let mut points = vec![];
    while points.len() < n {
        let (axis, far) = (random.below(3) as usize, random.below(2) == 1);
        let mut p = [0.0; 3].map(|_: f64| side * random.unit());
        p[axis] = if far { side } else { 0.0 } + 0.02 * (random.unit() - 0.5);
        // Near the upper rim a nearest place could lie on the upper side.
        if !(axis == 2 && far) && p[2] < side - 0.02 {
            points.push(p);
        }
    }
    points
}

/// Points against a mesh, in blocks of 1000; with the area of the facets that a map has no value on.
fn compared(points: &[Point], mesh: &Mesh, options: &Options) -> (Comparisons, CompareDocument, f64) {
    let references = [Reference { name: "x".into(), mesh, exact: None, left_out: LeftOut::default() }];
    let mut stream = Blocks(points.chunks(1000).map(<[Point]>::to_vec).rev().collect());
    let found = run(&mut stream, &references, options, &Silent, |_| Ok::<(), Infallible>(())).unwrap();
    let files = vec![InputRecord::of_no_file(Role::Measured), InputRecord::of_no_file(Role::Reference)];
    let inputs = Inputs {
        files,
        kind: MeasuredKind::Points,
        scale: None,
        reverse: vec![],
        alignment: None,
        doubts: vec![],
    };
    let document = document(&found, inputs, options);
    let map = found.references[0].map.as_ref().unwrap();
    let (drawn, values) = (map.mesh.as_ref().unwrap_or(mesh), &map.values);
    let gray = drawn.faces.iter().filter(|f| f.iter().any(|v| !values[*v as usize].is_finite()));
    let area = |f: &[u32; 3]| {
        let [a, b, c] = f.map(|v| drawn.positions[v as usize]);
        0.5 * norm(cross(minus(b, a), minus(c, a)))
    };
    let gray = gray.map(area).sum();
    (found, document, gray)
}

struct Blocks(Vec<Vec<Point>>);

impl PointStream for Blocks {
    type Error = Infallible;
    fn expected(&self) -> Option<u64> {
        None
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<(), Infallible> {
        *block = self.0.pop().unwrap_or_default();
        Ok(())
    }
}

#[test]
fn what_is_not_covered_is_what_the_map_shows_gray() {
    let (mesh, points) = (cube(40.0), open_at_the_top(20_000, 40.0));
    for shown in [0, 2000] {
        let options = Options { shown, coverage: Some(Coverage::Auto), ..Options::default() };
        let (_, document, gray) = compared(&points, &mesh, &options);
        let c = document.comparisons[0].coverage.as_ref().unwrap();
        assert!((c.uncovered - gray).abs() < 1e-9 * c.area, "{} drawn gray, {} told", gray, c.uncovered);
        // Creases part the sides: one of six, whole and alone.
        assert!((c.area - 9600.0).abs() < 1e-9 && (c.uncovered - 1600.0).abs() < 1e-9, "{c:?}");
        assert!((c.uncovered_share.unwrap() - 1.0 / 6.0).abs() < 1e-12);
    }
    // A report alone tells it too.
    let options = Options { shown: 2000, ..Options::default() };
    let (_, document, gray) = compared(&points, &mesh, &options);
    assert!((document.comparisons[0].coverage.as_ref().unwrap().uncovered - gray).abs() < 1e-6);
    // Where the points end within a side, pieces with one corner too far count as the map draws them: gray.
    let half: Vec<Point> = points.iter().filter(|p| p[0] < 17.0).copied().collect();
    let (_, document, gray) = compared(&half, &mesh, &options);
    let c = document.comparisons[0].coverage.as_ref().unwrap();
    assert!((c.uncovered - gray).abs() < 1e-6 && c.uncovered > 1600.0, "{gray} drawn gray, {c:?}");
    // Points that are left out cover nothing: of those that look downward only the lower side is left.
    let down = Facing::new(0.5, vec![[0.0, 0.0, -1.0]; points.len()]);
    let options = Options { shown: 2000, facing: Some(down), ..Options::default() };
    let (_, document, gray) = compared(&points, &mesh, &options);
    let c = document.comparisons[0].coverage.as_ref().unwrap();
    assert!((c.uncovered - 8000.0).abs() < 1e-6 && (c.uncovered - gray).abs() < 1e-6, "{c:?}");
}

#[test]
fn the_turned_cube_faces_like_the_other() {
    // Inside out, outward is still out of the material.
    let (mesh, points) = (cube(40.0), open_at_the_top(3000, 40.0));
    let mut turned = mesh.clone();
    turned.faces.iter_mut().for_each(|f| f.swap(1, 2));
    let normals: Vec<_> = (points.iter())
        .map(|p| {
            let k = (0..3).min_by(|a, b| rim(p[*a]).total_cmp(&rim(p[*b]))).unwrap();
            let mut n = [0.0; 3];
            n[k] = if p[k] > 20.0 { 1.0 } else { -1.0 };
            n
        })
        .collect();
    let options = Options { facing: Some(Facing::new(0.1, normals)), ..Options::default() };
    let count = |mesh: &Mesh| compared_count(&points, mesh, &options);
    let (straight, inside_out) = (count(&mesh), count(&turned));
    assert_eq!(straight, inside_out);
    // Beside edges the nearest side may be another one.
    assert!(straight > 2970, "{straight}");
}

fn rim(x: f64) -> f64 {
    x.abs().min((x - 40.0).abs())
}

fn compared_count(points: &[Point], mesh: &Mesh, options: &Options) -> u64 {
    let references = [Reference { name: "x".into(), mesh, exact: None, left_out: LeftOut::default() }];
    let mut stream = Whole::<Infallible>::new(points.to_vec());
    let found = run(&mut stream, &references, options, &Silent, |_| Ok::<(), Infallible>(())).unwrap();
    found.references[0].summary.all.count
}

#[test]
fn outliers_do_not_depend_on_blocks_and_leave_no_trace_in_what_is_counted() {
    let (mesh, mut points) = (cube(40.0), open_at_the_top(5000, 40.0));
    for (i, far) in [(17, 1.0), (2500, -0.7), (4999, 3.0)] {
        points[i] = [20.0, -far, 20.0];
    }
    let tolerance = Some(trueness_document::tolerance::Tolerance { lower: -0.1, upper: 0.1 });
    let options = Options {
        tolerance,
        shown: 100,
        outliers: Some(OutlierRule::Mad(8.0)),
        coverage: Some(Coverage::Auto),
        ..Options::default()
    };
    let (found, mut with, _) = compared(&points, &mesh, &options);
    let c = &found.references[0];
    assert!(c.excluded.contains(&(Excluded::Outlier, 3)), "{:?}", c.excluded);
    let kept: Vec<usize> = (0..points.len()).filter(|i| ![17, 2500, 4999].contains(i)).collect();
    let clean: Vec<Point> = kept.iter().map(|i| points[*i]).collect();
    let plain = Options { outliers: None, ..options.clone() };
    let (_, mut without, _) = compared(&clean, &mesh, &plain);
    assert!(with.comparisons[0].worst.iter().all(|w| w.deviation.abs() < 0.02));
    // Sums are taken in pieces of the list, in which outliers keep their places: the last bits may differ.
    let [a, b] = [&with, &without].map(|d| d.comparisons[0].deviation.all.clone());
    assert_eq!((a.count, a.min, a.max, a.median, a.mad), (b.count, b.min, b.max, b.median, b.mad));
    for (a, b) in [(a.mean, b.mean), (a.std_dev, b.std_dev), (a.rms, b.rms), (a.mean_abs, b.mean_abs)] {
        assert!((a.unwrap() - b.unwrap()).abs() < 1e-16);
    }
    without.comparisons[0].deviation = with.comparisons[0].deviation.clone();
    // The same points are the lowest and the highest, by their numbers in the file with all.
    let c = &mut without.comparisons[0];
    for e in [&mut c.lowest, &mut c.highest].into_iter().flatten() {
        e.index = kept[e.index as usize] as u64;
    }
    // All else that is told of the points that count is what is told where the others never were.
    for d in [&mut with, &mut without] {
        let c = &mut d.comparisons[0];
        (c.outliers, c.excluded) = (None, Default::default());
        c.worst.iter_mut().for_each(|w| w.index = 0);
        c.sign.sample = 0;
        (c.sign.disagreement, c.sign.disagreement_reason) = (None, None);
    }
    let told = |d: &CompareDocument| serde_json::to_string(&d.comparisons[0]).unwrap();
    assert_eq!(told(&with), told(&without));
    // A point that an outlier of one reference is counts for another: the pairs know both.
    assert!(Excluded::of(found.shown.deviations[0][0]).is_none_or(|e| e == Excluded::Outlier));
}

#[test]
fn too_few_normals_are_refused() {
    let (mesh, points) = (cube(40.0), open_at_the_top(1500, 40.0));
    let options =
        Options { facing: Some(Facing::new(1.0, vec![[1.0, 0.0, 0.0]; 1499])), ..Options::default() };
    let references = [Reference { name: "x".into(), mesh: &mesh, exact: None, left_out: LeftOut::default() }];
    let mut stream = Whole::<Infallible>::new(points);
    let found = run(&mut stream, &references, &options, &Silent, |_| Ok::<(), Infallible>(()));
    assert!(matches!(found, Err(CompareError::Normals { normals: 1499, points: 1500 })));
}

/// Eight vertices with a sloping side between them: the map knows the side in between, by exact distances, the statistics do not.
#[test]
fn large_facets_of_a_measured_mesh_are_in_the_map() {
    let (mesh, mut scan) = (cube(40.0), cube(40.0));
    scan.positions.iter_mut().filter(|p| p[2] > 0.0).for_each(|p| p[2] += 0.01 * p[0]);
    let between = Between::of(&scan);
    let tree = Tree::build(&mesh).unwrap();
    let distance = |p: &Point| tree.closest(p, f64::INFINITY).unwrap().unwrap().distance;
    let sizes: Vec<u64> =
        between.points.iter().chain(&scan.positions).map(|p| distance(p).to_bits()).collect();
    let options = Options { shown: 100, ..Options::default() };
    let (_, document, gray) = compared(&scan.positions, &mesh, &options);
    let bare = document.comparisons[0].coverage.as_ref().unwrap();
    assert!((bare.uncovered - gray).abs() < 1e-9 && bare.uncovered > 0.9 * bare.area && bare.between == 0);
    let options = Options { between, ..options };
    let (found, document, gray) = compared(&scan.positions, &mesh, &options);
    let c = &document.comparisons[0];
    assert_eq!((c.deviation.all.count, c.deviation.all.max), (8, Some(distance(&[40.0, 0.0, 40.4]))));
    let coverage = c.coverage.as_ref().unwrap();
    assert_eq!((gray, coverage.uncovered, coverage.between), (0.0, 0.0, options.between.points.len() as u64));
    let map = found.references[0].map.as_ref().unwrap();
    let drawn = map.mesh.as_ref().unwrap();
    assert!(drawn.positions.len() > 5000 && map.reach < 3.0, "{} {}", drawn.positions.len(), map.reach);
    for (p, value) in drawn.positions.iter().zip(&map.values) {
        assert!(sizes.contains(&value.abs().to_bits()), "{value} is the distance of no place");
        if p[2] > 39.9 && p[0] > 0.1 && p[0] < 39.9 && p[1] > 0.1 && p[1] < 39.9 {
            assert!((value - 0.01 * p[0]).abs() <= 0.01 * map.reach, "{value} at {p:?}");
        }
    }
    // What faces another way is left out here as it is of points, by the normals behind those of the points.
    let normals = [vertex_normals(&scan), options.between.normals.clone()].concat();
    let up = normals.iter().map(|n| [0.0, 0.0, n[2]]).collect();
    let options = Options { facing: Some(Facing::new(0.1, up)), ..options };
    let (_, document, _) = compared(&scan.positions, &mesh, &options);
    let coverage = document.comparisons[0].coverage.as_ref().unwrap();
    // Of the sides two of six are left, the upper and the lower one.
    assert!((coverage.uncovered - 6400.0).abs() < 1e-6, "{coverage:?}");
}
