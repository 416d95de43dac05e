//! Files that end too early or too late, or become shorter while they are read.

use crate::common;

use common::{Folder, gzip, read};
use std::{
    fs::OpenOptions,
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};
use trueness_files::{Body, ReadOptions, open};

/// An array of `rows` points, C or Fortran order.
fn npy(rows: usize, fortran: bool) -> Vec<u8> {
    let order = if fortran { "True" } else { "False" };
    let text = format!("{{'descr': '<f8', 'fortran_order': {order}, 'shape': ({rows}, 3), }}\n");
    let numbers = (0..3 * rows).flat_map(|i| (i as f64).to_le_bytes());
    let head = [b"\x93NUMPY\x01\0", &(text.len() as u16).to_le_bytes()[..], text.as_bytes()].concat();
    head.into_iter().chain(numbers).collect()
}

fn binary_stl(facets: u32) -> Vec<u8> {
    let mut bytes = [&[b' '; 80][..], &facets.to_le_bytes()].concat();
    for f in 0..facets {
        let corners = [[f, 0, 0], [f, 1, 0], [f, 0, 1]].map(|p| p.map(|x| x as f32));
        bytes.extend([0u8; 12]);
        bytes.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0u8; 2]);
    }
    bytes
}

fn rows(count: usize) -> String {
    (0..count).map(|i| format!("{i}.25 {i}.5 -{i}.75\n")).collect()
}

fn ply_points(declared: usize, rows: usize) -> Vec<u8> {
    let properties = "property double x\nproperty double y\nproperty double z\n";
    let head =
        format!("ply\nformat binary_little_endian 1.0\nelement vertex {declared}\n{properties}end_header\n");
    head.into_bytes().into_iter().chain((0..3 * rows).flat_map(|i| (i as f64).to_le_bytes())).collect()
}

/// Cuts a file to a share of its length.
fn cut(path: &Path, length: u64) {
    OpenOptions::new().write(true).open(path).unwrap().set_len(length).unwrap();
}

#[test]
fn points_of_a_file_cut_between_blocks_are_an_error() {
    let folder = Folder::new();
    let files = [
        ("a.xyz", rows(400_000).into_bytes()),
        ("c.npy", npy(100_000, false)),
        ("f.npy", npy(100_000, true)),
        ("p.ply", ply_points(100_000, 100_000)),
    ];
    for (name, bytes) in files {
        let path = folder.file(name, &bytes);
        let options = ReadOptions { block: 10_000, ..ReadOptions::default() };
        let Body::Points(mut points) = open(&path, &options).unwrap().body else { panic!("{name}") };
        let mut block = vec![];
        points.next_block(&mut block).unwrap();
        assert!(!block.is_empty());
        cut(&path, bytes.len() as u64 / 2);
        let error = loop {
            match points.next_block(&mut block) {
                Ok(()) => assert!(!block.is_empty(), "{name}: read as a whole"),
                Err(e) => break e.to_string(),
            }
        };
        let told = error.contains(name)
            && error.contains("became shorter")
            && error.contains(&bytes.len().to_string())
            && error.contains("try again");
        assert!(told, "{error}");
    }
}

/// Another thread cuts the file and mends it again while it is read, over and over: every reading is an error or gives the
/// whole, and the program lives on.
#[test]
fn meshes_cut_while_they_are_read_are_an_error_or_whole() {
    let folder = Folder::new();
    let obj: String = (0..40_000).map(|i| format!("v {i} 0 0\nv {i} 1 0\nv {i} 0 1\nf -1 -2 -3\n")).collect();
    for (name, bytes) in [("m.stl", binary_stl(40_000)), ("m.obj", obj.into_bytes())] {
        let path = folder.file(name, &bytes);
        let done = AtomicBool::new(false);
        let (mut whole, mut refused) = (0, 0);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !done.load(Ordering::Relaxed) {
                    cut(&path, bytes.len() as u64 / 2);
                    std::thread::yield_now();
                    std::fs::write(&path, &bytes).unwrap();
                    std::thread::sleep(std::time::Duration::from_micros(300));
                }
            });
            for _ in 0..150 {
                match read(&path) {
                    Ok(_) => whole += 1,
                    Err(e) => {
                        assert!(e.to_string().contains(name), "{e}");
                        refused += 1;
                    }
                }
            }
            done.store(true, Ordering::Relaxed);
        });
        assert_eq!(whole + refused, 150);
    }
}

#[test]
fn bytes_behind_an_array_or_points_are_refused() {
    let folder = Folder::new();
    for fortran in [false, true] {
        let two = [npy(4, fortran), npy(4, fortran)].concat();
        for (name, bytes) in [("two.npy", two.clone()), ("two.npy.gz", gzip(&two))] {
            let said = read(&folder.file(name, &bytes)).unwrap_err().to_string();
            assert!(said.contains("bytes follow the 4 points") && said.contains("save"), "{said}");
        }
        assert_eq!(read(&folder.file("one.npy", &npy(4, fortran))).unwrap().points.len(), 4);
    }
    let said = read(&folder.file("p.ply", &ply_points(3, 5))).unwrap_err().to_string();
    assert!(said.contains("48 bytes follow the 3 vertices"), "{said}");
    let text =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let text = format!("{text}end_header\n1 2 3\n");
    assert_eq!(read(&folder.file("q.ply", format!("{text}\n \n").as_bytes())).unwrap().points.len(), 1);
    // Rows of numbers are vertices that the header does not count.
    let said =
        read(&folder.file("q.ply", format!("{text}4 5 6\n\n7 8 9").as_bytes())).unwrap_err().to_string();
    assert!(
        said.contains("1 vertices announced, 3 present") && said.contains("correct the number"),
        "{said}"
    );
    let said = read(&folder.file("q.ply", format!("{text}4 5 six\n").as_bytes())).unwrap_err().to_string();
    assert!(said.contains("8 bytes follow the 1 vertices"), "{said}");
}

#[test]
fn lines_behind_a_mesh_are_warned_of() {
    let folder = Folder::new();
    let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (name, text) in [("m.off", off), ("m.ply", ply)] {
        for (more, warnings) in [("", 0), ("\n \n", 0), ("3 0 2 1\n", 1)] {
            let whole = read(&folder.file(name, format!("{text}{more}").as_bytes())).unwrap();
            assert_eq!((whole.faces, whole.warnings), (1, warnings), "{name} {more:?}");
        }
    }
}

#[test]
fn zero_bytes_in_text_are_told() {
    let folder = Folder::new();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let stl = format!("solid a\n{}", facet.repeat(20));
    for (name, text) in [("m.obj", obj), ("m.stl", &stl), ("p.xyz", "1 2 3\n4 5 6\n")] {
        // A tail of zeros is what a full disk or a crash leaves.
        let bytes = [text.as_bytes(), &[0; 600]].concat();
        let said = read(&folder.file(name, &bytes)).unwrap_err().to_string();
        assert!(said.contains("zero bytes within text"), "{said}");
    }
    // Behind what says that it has ended they fill up a block.
    for (name, text, faces) in [("m.off", off, 1), ("m.stl", &format!("{stl}endsolid a\n"), 20)] {
        let filled = [text.as_bytes(), &[0; 600]].concat();
        let read = read(&folder.file(name, &filled)).unwrap();
        assert_eq!((read.faces, read.warnings), (faces, 0), "{name}");
        let cut = [&text.as_bytes()[..text.len() - 20], &[0; 600]].concat();
        assert!(common::read(&folder.file(name, &cut)).is_err(), "{name}");
    }
}

/// A hole takes no room on the disk: the header says how little of it there is to read.
#[test]
fn a_long_file_that_declares_little_is_not_read_as_a_whole() {
    let folder = Folder::new();
    let path = folder.file("hole.stl", &binary_stl(3));
    cut(&path, 1 << 40);
    let whole = read(&path).unwrap();
    assert_eq!((whole.faces, whole.warnings), (3, 1));
    let path = folder.file("hole.obj", b"v 0 0 0\n");
    cut(&path, 1 << 40);
    assert!(read(&path).unwrap_err().to_string().contains("zero bytes"));
}

/// Lengths of what stands behind each facet, as its attribute word says. They are passed over where they fill the file up
/// exactly, and are colors where the file is as long without them.
#[test]
fn bytes_behind_each_facet_are_passed_over_where_the_length_proves_them() {
    let folder = Folder::new();
    let mut random = common::Random(11);
    for case in 0..60 {
        let facets = 1 + random.below(40);
        let (mut bytes, mut wanted) = ([&[b' '; 80][..], &(facets as u32).to_le_bytes()].concat(), vec![]);
        let mut payload = 0;
        for _ in 0..facets {
            let corners: [[f32; 3]; 3] =
                std::array::from_fn(|_| std::array::from_fn(|_| random.below(1000) as f32));
            let length = if case % 3 == 0 { 4 } else { random.below(70) };
            bytes.extend([0; 12]);
            bytes.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
            bytes.extend((length as u16).to_le_bytes());
            bytes.extend((0..length).map(|_| random.bits() as u8));
            wanted.extend(corners.map(|p| p.map(f64::from)));
            payload += length;
        }
        let corners = |bytes: &[u8]| {
            let input = open(&folder.file("a.stl", bytes), &ReadOptions::default()).unwrap();
            let Body::Mesh(source) = input.body else { panic!("no mesh") };
            let places = source.mesh.faces.iter().flatten().map(|v| source.mesh.positions[*v as usize]);
            (places.collect::<Vec<_>>(), input.warnings)
        };
        assert_eq!(corners(&bytes), (wanted.clone(), vec![]), "{case}");
        if payload == 0 {
            continue;
        }
        // A byte more or less proves nothing: what follows as many facets of 50 bytes is told.
        for other in [[&bytes[..], &[0]].concat(), bytes[..bytes.len() - 1].to_vec()] {
            let told = corners(&other).1[0].to_string();
            assert!(told.contains("bytes after the declared content"), "{case} {told}");
        }
        // The same facets with these words and nothing behind them: colors.
        let mut plain = bytes[..84].to_vec();
        for (f, corners) in wanted.as_chunks::<3>().0.iter().enumerate() {
            plain.extend([0; 12]);
            plain.extend(corners.as_flattened().iter().flat_map(|x| (*x as f32).to_le_bytes()));
            plain.extend([f as u8, 0x80]);
        }
        assert_eq!(corners(&plain), (wanted, vec![]), "{case}");
    }
}

/// What stands behind `endsolid` on its line is a name; lines of text behind it are told; what may be facets is refused.
#[test]
fn words_behind_the_end_of_a_solid() {
    let folder = Folder::new();
    let facet = " facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n endfacet\n";
    let names = [
        "",
        "part",
        "name of the part",
        "v2, 12 facets (facet 3)",
        "a facet normal",
        "solid",
        "endsolid x",
        "vertex 1 2 3",
        "# made by",
        "end loop",
    ];
    let tails = ["", "# a comment", "some words here", "12 facets written\n\n2 files", "-- end of file --"];
    let mut random = common::Random(3);
    for name in names {
        for behind in names {
            for tail in tails {
                let end = ["\n", "\r\n", "\r"][random.below(3)];
                let solids = 1 + random.below(2);
                let one = format!("solid {name}\n{facet}endsolid {behind}\n");
                let text = (one.repeat(solids) + tail).replace('\n', end);
                let found =
                    read(&folder.file("a.stl", text.as_bytes())).unwrap_or_else(|e| panic!("{text}\n{e}"));
                let warnings = usize::from(solids > 1) + usize::from(!tail.is_empty());
                assert_eq!((found.faces, found.warnings), (solids, warnings), "{text}");
            }
        }
    }
    for tail in [
        "text\nfacet normal 0 0 1\n",
        "text\n vertex 0 0 0\n",
        "facett normal 0 0 1\n outer loop\n",
        "a\nend loop\n",
    ] {
        let text = format!("solid a\n{facet}endsolid a\n{tail}");
        let said = read(&folder.file("a.stl", text.as_bytes())).unwrap_err().to_string();
        assert!(said.contains("line 10"), "{said}");
    }
}

/// Numbers behind the rows of an OFF file are colors; words there are refused at their line, unless `#` begins them.
#[test]
fn words_behind_the_rows_of_off() {
    let folder = Folder::new();
    let file = |header: &str, vertex: &str, face: &str, end: &str| {
        format!("{header}\n3 1 0\n0 0 0\n1 0 0{vertex}\n0 1 0\n3 0 1 2{face}\n{end}")
    };
    for (header, vertex, face, end) in [
        ("OFF", "", "", ""),
        ("OFF # name of the part", " # a corner", " # a face", "# the end"),
        ("OFF", "", " 255 0 0", ""),
        ("OFF", "", " 0.5 0.5 0.5 1", ""),
        ("OFF", "", " 7", ""),
    ] {
        let text = file(header, vertex, face, end);
        let found = read(&folder.file("a.off", text.as_bytes())).unwrap_or_else(|e| panic!("{text}\n{e}"));
        assert_eq!((found.faces, found.warnings), (1, 0), "{text}");
    }
    for (header, vertex, face, line) in [
        ("OFF", " a corner", "", "line 4"),
        ("OFF", "", " red", "line 6"),
        ("OFF", "", " // a face", "line 6"),
        ("OFF", "", " 255 0 0 red", "line 6"),
        ("OFF name", "", "", "line 1"),
    ] {
        let text = file(header, vertex, face, "");
        let said = read(&folder.file("a.off", text.as_bytes())).unwrap_err().to_string();
        assert!(said.contains(line), "{text}\n{said}");
    }
}
