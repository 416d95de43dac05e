//! The check of meshes on every file of the corpus: counts of an independent program, and the same in every format.

use crate::common;

use common::Folder;
use std::collections::BTreeMap;
use std::path::Path;
use trueness_files::{Body, ReadOptions, SourceMesh, open, write};
use trueness_geom::check::{self, Options, Report, check};
use trueness_geom::progress::Silent;

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../corpus");

fn mesh(path: &Path) -> SourceMesh {
    match open(path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}")).body {
        Body::Mesh(m) => m,
        Body::Points(_) | Body::Splines(_) | Body::Cad(_) | Body::Drawing(_) => {
            panic!("{}: points", path.display())
        }
    }
}

fn report(m: &SourceMesh) -> Report {
    let options = Options { limit: usize::MAX, ..Options::default() };
    check(&m.mesh, m.stored_normals.as_deref(), &options, &Silent).unwrap()
}

/// The columns of `check.tsv`.
fn counted(m: &SourceMesh, r: &Report) -> BTreeMap<&'static str, usize> {
    let degenerate = r.found(check::DEGENERATE_FACETS).unwrap();
    let corners = |n: f64| degenerate.items.iter().filter(|f| f.measures[0].1 == n).count();
    let mut all: BTreeMap<&'static str, usize> = [
        check::BOUNDARY_EDGES,
        check::NON_MANIFOLD_EDGES,
        check::NON_MANIFOLD_VERTICES,
        check::INCONSISTENT_ORIENTATION,
        check::DUPLICATE_FACETS,
        check::SELF_INTERSECTIONS,
    ]
    .map(|kind| (kind.name, r.found(kind).unwrap().count))
    .into();
    all.extend([("facets", m.mesh.faces.len()), ("vertices", r.vertices), ("edges", r.edges)]);
    let repeated = degenerate.count - corners(3.0);
    all.extend([("shells", r.soundness.shells), ("repeated_vertex", repeated), ("collinear", corners(3.0))]);
    all
}

#[test]
fn every_count_is_that_of_an_independent_program() {
    let table = std::fs::read_to_string(format!("{CORPUS}/check.tsv")).unwrap();
    let mut lines = table.lines().map(|line| line.split('\t').collect::<Vec<&str>>());
    let head = lines.next().unwrap();
    let mut compared = 0;
    for line in lines {
        let m = mesh(&Path::new(CORPUS).join(line[0]));
        let got = counted(&m, &report(&m));
        for (column, want) in head.iter().zip(&line).skip(1).filter(|(_, want)| **want != "-") {
            assert_eq!(got[column].to_string(), *want, "{} {column}", line[0]);
            compared += 1;
        }
    }
    assert_eq!(compared, 982);
}

/// Every kind but the one that hangs on normals, which only STL stores.
fn counts(r: &Report) -> Vec<(&'static str, usize)> {
    let found = r.defects.iter().filter(|(kind, _)| kind.name != "reversed_normals");
    found.filter_map(|(kind, found)| Some((kind.name, found.as_ref()?.count))).collect()
}

#[test]
fn the_format_changes_nothing() {
    let folder = Folder::new();
    let table = std::fs::read_to_string(format!("{CORPUS}/check.tsv")).unwrap();
    for file in table.lines().skip(1).map(|line| line.split('\t').next().unwrap()) {
        let m = mesh(&Path::new(CORPUS).join(file));
        let want = counts(&report(&m));
        let single = m.mesh.positions.iter().flatten().all(|x| f64::from(*x as f32) == *x);
        for format in ["ply", "obj", "off", "stl"].iter().filter(|f| single || **f != "stl") {
            let path = folder.path().join(format!("again.{format}"));
            if write::mesh(&path, &m.mesh).is_err() {
                continue;
            }
            let again = mesh(&path);
            assert_eq!(counts(&report(&again)), want, "{file} as {format}");
        }
    }
}
