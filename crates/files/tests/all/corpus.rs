//! Every file of the corpus is read as an independent program says it should be.

use crate::common;

use common::{Folder, gzip, read};
use trueness_files::{Body, ReadOptions, Weld, open};

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../corpus");

/// A line of `expected.tsv`.
struct Expected {
    file: String,
    result: String,
    note: String,
    faces: Option<usize>,
    vertices: Option<usize>,
}

fn expected() -> Vec<Expected> {
    let table = std::fs::read_to_string(format!("{CORPUS}/expected.tsv")).unwrap();
    let lines = table.lines().skip(1).map(|line| {
        let c: Vec<&str> = line.split('\t').collect();
        let text = |i: usize| c[i].to_string();
        Expected {
            file: text(0),
            result: text(1),
            note: text(2),
            faces: c[3].parse().ok(),
            vertices: c[4].parse().ok(),
        }
    });
    lines.collect()
}

#[test]
fn every_file_gives_the_reference_result() {
    let list = expected();
    assert_eq!(list.len(), 133);
    for e in &list {
        let path = format!("{CORPUS}/{}", e.file);
        let (result, warned, faces, vertices) = match read(path.as_ref()) {
            Ok(r) => (r.kind, r.warnings > 0, r.faces, r.points.len()),
            Err(error) => {
                assert_eq!(e.result, "refused", "{error}");
                let text = error.to_string();
                assert!(text.starts_with(&path) && text.contains("; "), "{text}");
                assert!(
                    e.note == "-" || text.contains(&format!(", {}: ", e.note)),
                    "{text}, expected {}",
                    e.note
                );
                continue;
            }
        };
        assert_eq!(result, e.result, "{path}");
        assert!(e.note == "*" || warned == (e.note == "warned"), "{path}: warned {warned}");
        assert_eq!(Some(vertices), e.vertices, "{path}: vertices");
        assert_eq!(if result == "mesh" { Some(faces) } else { None }, e.faces, "{path}: faces");
    }
}

#[test]
fn no_file_is_missing_from_the_table() {
    let listed: Vec<String> = expected().into_iter().map(|e| e.file).collect();
    for folder in ["broken", "shapes", "scans"] {
        for entry in std::fs::read_dir(format!("{CORPUS}/{folder}")).unwrap() {
            let name = format!("{folder}/{}", entry.unwrap().file_name().to_str().unwrap());
            assert!(listed.contains(&name), "{name} has no line in expected.tsv");
        }
    }
}

#[test]
fn a_packed_file_reads_as_the_file_itself() {
    let folder = Folder::new();
    for e in expected().iter().filter(|e| e.result != "refused") {
        let plain = std::fs::read(format!("{CORPUS}/{}", e.file)).unwrap();
        let name = e.file.rsplit('/').next().unwrap();
        let packed = folder.path().join(format!("{name}.gz"));
        std::fs::write(&packed, gzip(&plain)).unwrap();
        let a = read(format!("{CORPUS}/{}", e.file).as_ref()).unwrap();
        let b = read(&packed).unwrap_or_else(|error| panic!("{error}"));
        assert!(b.gzip && !a.gzip);
        assert_eq!((a.format, &a.points, a.faces), (b.format, &b.points, b.faces), "{}", e.file);
    }
}

#[test]
fn the_example_has_the_stated_numbers() {
    let points = read(format!("{CORPUS}/bunny/scans.ply").as_ref()).unwrap();
    assert_eq!((points.kind, points.points.len()), ("points", 362_272));
    for (i, faces) in [69_451, 16_301, 3_851, 948].into_iter().enumerate() {
        let mesh = read(format!("{CORPUS}/bunny/zipper_res{}.ply", i + 1).as_ref()).unwrap();
        assert_eq!((mesh.kind, mesh.faces), ("mesh", faces));
    }
}

/// Old exporters sign the header without the word `comment`.
#[test]
fn an_unknown_header_line_of_a_ply_is_a_warning_before_the_first_element_and_an_error_after_it() {
    let signature = "Created by Blender3D 247 - www.blender.org, source file: part.blend\n";
    let element = "element vertex 1\n";
    let rest = "property float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
    let folder = Folder::new();
    let before =
        folder.file("before.ply", format!("ply\nformat ascii 1.0\n{signature}{element}{rest}").as_bytes());
    let input = open(&before, &ReadOptions::default()).unwrap();
    let said: Vec<String> = input.warnings.iter().map(ToString::to_string).collect();
    assert!(
        said.len() == 1 && said[0].contains("line 3") && said[0].contains("Created by Blender3D"),
        "{said:?}"
    );
    assert_eq!(read(&before).unwrap().points, [[1.0, 2.0, 3.0]]);
    let after =
        folder.file("after.ply", format!("ply\nformat ascii 1.0\n{element}{signature}{rest}").as_bytes());
    let error = open(&after, &ReadOptions::default()).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("line 4") && error.contains("Created by"), "{error}");
}

#[test]
fn without_welding_the_vertices_are_those_of_the_file() {
    let options = ReadOptions { weld: Weld::None, ..ReadOptions::default() };
    let vertices = |file: &str| match open(format!("{CORPUS}/shapes/{file}").as_ref(), &options).unwrap().body
    {
        Body::Mesh(m) => m.mesh.positions.len(),
        Body::Points(_) | Body::Splines(_) | Body::Cad(_) | Body::Drawing(_) => panic!("no mesh"),
    };
    assert_eq!(vertices("assimp__cube_uv.ply"), 24);
    assert_eq!(vertices("trimesh__unit_cube.STL"), 36);
}
