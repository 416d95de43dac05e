//! What is read from memory, packed or as a stream, is what is read from the file.

use crate::common;

use common::{Folder, Whole, gzip, whole};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use trueness_files::drawing::{self, Entity, Layer};
use trueness_files::write::{self, Block, Layout};
use trueness_files::{
    FORMATS, Fault, FileSources, MemorySources, ReadError, ReadOptions, SourceBytes, Sources, open,
    open_from, open_normals, open_normals_from, sha256,
};
use trueness_geom::mesh::Mesh;

/// All files below a folder.
fn below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { below(&path) } else { vec![path] }).collect()
}

/// All files of the corpus, and one of each format that is written.
fn files(folder: &Folder) -> Vec<PathBuf> {
    let mut all = below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus"));
    assert!(all.len() > 250, "{}", all.len());
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 4.0]];
    let mesh = Mesh { positions, faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] };
    let mut add = |name: &str, write: &dyn Fn(&Path)| {
        all.push(folder.path().join(name));
        write(&folder.path().join(name));
    };
    for format in FORMATS {
        for ending in format.written_as {
            if format.writes_meshes() {
                add(&format!("mesh.{ending}"), &|path| {
                    write::mesh(path, &mesh).unwrap();
                });
            }
            if format.writes_points() {
                add(&format!("points.{ending}"), &|path| {
                    let mut file = write::points(path, Layout::default()).unwrap();
                    file.write(&Block { points: &mesh.positions, ..Block::default() }).unwrap();
                    file.finish().unwrap();
                });
            }
        }
    }
    let entities = vec![Entity::Line { start: [0.0, 0.0], end: [3.0, 4.0] }];
    let layers = [Layer { name: "a".into(), entities, ..Layer::default() }];
    let curves = |write: fn(&mut dyn Write, &[Layer]) -> std::io::Result<()>| {
        let layers = &layers;
        move |path: &Path| write(&mut File::create(path).unwrap(), layers).unwrap()
    };
    add("curves.dxf", &curves(drawing::dxf));
    add("curves.step", &curves(drawing::step));
    add("curves.iges", &curves(drawing::iges));
    all
}

/// All that is told of an input, or of the fault.
fn told(sources: &dyn Sources, name: &Path) -> Result<(String, Whole), String> {
    let read = || -> Result<_, ReadError> {
        let input = open_from(sources, name, &ReadOptions::default())?;
        let (provenance, warnings) = (&input.provenance, &input.warnings);
        let told = format!("{provenance:?} {warnings:?}");
        let normals = match &input.body {
            trueness_files::Body::Mesh(mesh) => format!("{:?}", mesh.stored_normals),
            trueness_files::Body::Splines(model) => format!("{model:?}"),
            trueness_files::Body::Cad(file) => format!("{file:?}"),
            trueness_files::Body::Drawing(drawing) => format!("{drawing:?}"),
            trueness_files::Body::Points(_) => String::new(),
        };
        Ok((told + &normals, whole(input)?))
    };
    read().map_err(|error| error.to_string())
}

fn assert_same(a: Result<(String, Whole), String>, b: Result<(String, Whole), String>, name: &Path) -> bool {
    match (a, b) {
        (Ok((told_a, a)), Ok((told_b, b))) => {
            assert_eq!(told_a, told_b, "{}", name.display());
            let bits = |w: &Whole| w.points.as_flattened().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert!(bits(&a) == bits(&b), "{}", name.display());
            assert_eq!((a.kind, a.format, a.faces), (b.kind, b.format, b.faces), "{}", name.display());
            true
        }
        (Err(a), Err(b)) => {
            assert_eq!(a, b);
            false
        }
        (a, b) => panic!("{}: {:?}, {:?}", name.display(), a.map(|w| w.0), b.map(|w| w.0)),
    }
}

#[test]
fn memory_gives_what_the_file_gives() {
    let (mut formats, mut refused) = (BTreeSet::new(), 0);
    let folder = Folder::new();
    for path in files(&folder) {
        let memory: MemorySources = [(path.clone(), std::fs::read(&path).unwrap())].into_iter().collect();
        let (a, b) = (told(&FileSources, &path), told(&memory, &path));
        formats.extend(a.as_ref().ok().map(|(_, whole)| whole.format));
        refused += usize::from(!assert_same(a, b, &path));
        assert_eq!(memory.length(&path), FileSources.length(&path));
        assert_eq!(memory.sha256(&path).unwrap(), sha256(&path).unwrap(), "{}", path.display());
        assert!(!memory.is_stream(&path) && !FileSources.is_stream(&path));
    }
    // Tables go by several names.
    for format in FORMATS.iter().filter(|format| format.reads() && !format.has_columns()) {
        assert!(formats.iter().any(|variant| variant.starts_with(format.name)), "{format:?} {formats:?}");
    }
    assert!(refused > 20, "{refused}");
}

#[test]
fn packed_memory_gives_what_the_packed_file_gives() {
    let folder = Folder::new();
    for path in files(&folder).iter().filter(|path| std::fs::metadata(path).unwrap().len() < 50_000) {
        let packed = gzip(&std::fs::read(path).unwrap());
        let name = path.file_name().unwrap().to_string_lossy();
        let path = folder.file(&format!("packed_{name}.gz"), &packed);
        let memory: MemorySources = [(path.clone(), packed)].into_iter().collect();
        assert_same(told(&FileSources, &path), told(&memory, &path), &path);
    }
}

/// Bytes that can be read once.
struct Upload(Vec<u8>);

impl Sources for Upload {
    fn bytes(&self, _: &Path) -> Result<SourceBytes, Fault> {
        Ok(SourceBytes::stream(Cursor::new(self.0.clone())))
    }
    fn is_stream(&self, _: &Path) -> bool {
        true
    }
}

#[test]
fn a_stream_gives_the_points_of_the_file() {
    let folder = Folder::new();
    for path in files(&folder) {
        let Ok((_, of_file)) = told(&FileSources, &path) else { continue };
        let upload = Upload(std::fs::read(&path).unwrap());
        let (_, of_stream) = told(&upload, &path).unwrap();
        assert_eq!(
            (of_file.points, of_file.faces),
            (of_stream.points, of_stream.faces),
            "{}",
            path.display()
        );
        assert_eq!(upload.length(&path), None);
        assert!(upload.sha256(&path).unwrap_err().to_string().contains("once only"));
    }
}

#[test]
fn normals_come_from_memory_too() {
    let folder = Folder::new();
    let text = "x y z nx ny nz\n1 2 3 0 0 1\n4 5 6 0 1 0\n";
    let path = folder.file("a.xyz", text.as_bytes());
    let memory: MemorySources = [("a.xyz", text)].into_iter().collect();
    let all = |mut points: trueness_files::PointSource| {
        let mut block = vec![];
        points.next_block(&mut block).unwrap();
        block
    };
    let options = ReadOptions::default();
    let of_file = all(open_normals(&path, None, &options).unwrap());
    assert_eq!(of_file, [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    assert_eq!(all(open_normals_from(&memory, "a.xyz".as_ref(), None, &options).unwrap()), of_file);
}

#[test]
fn a_name_that_is_not_there_is_told_with_the_nearest() {
    let memory: MemorySources = [("scan.stl", "solid"), ("plan.toml", "")].into_iter().collect();
    let error = open_from(&memory, "skan.stl".as_ref(), &ReadOptions::default()).map(|_| ()).unwrap_err();
    assert!(matches!(&error.fault, Fault::Unnamed { nearest: Some(name) } if name == "scan.stl"));
    assert!(error.to_string().starts_with("skan.stl: "), "{error}");
    let missing = open(Path::new("no/such"), &ReadOptions::default()).map(|_| ()).unwrap_err();
    assert!(matches!(missing.fault, Fault::Io(_)));
}
