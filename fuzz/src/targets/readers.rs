//! The readers. Each case is read twice: as what it seems to be, with the usual options, and as its own format, without
//! welding and in blocks of a few points.

use super::{Target, files};
use crate::mutate::{below, mutated};
use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use std::io::{Read, Write};
use std::path::Path;
use trueness_files::{Body, Format, ReadError, ReadOptions, SourceMesh, Weld, open};

/// STL in text and binary.
pub const STL: Target = Target {
    name: "stl",
    extension: "stl",
    seeds: |corpus| files(corpus, &["stl"]),
    mutate: |random, case, other| mutated(random, case, other, STL_WORDS),
    run: |_, path| both(path, Format::named("stl")),
    size: <[u8]>::len,
};

const STL_WORDS: &[&[u8]] =
    &[b"solid", b"facet normal 0 0 1", b"outer loop", b"vertex 1 2 3", b"endloop", b"endfacet", b"endsolid"];

/// PLY in text and both binary orders.
pub const PLY: Target = Target {
    name: "ply",
    extension: "ply",
    seeds: |corpus| files(corpus, &["ply"]),
    mutate: |random, case, other| mutated(random, case, other, PLY_WORDS),
    run: |_, path| both(path, Format::named("ply")),
    size: <[u8]>::len,
};

const PLY_WORDS: &[&[u8]] = &[
    b"format ascii 1.0\n",
    b"format binary_little_endian 1.0\n",
    b"format binary_big_endian 1.0\n",
    b"element vertex 3\n",
    b"element face 1\n",
    b"element tristrips 1\n",
    b"property float x\n",
    b"property double y\n",
    b"property uchar z\n",
    b"property list uchar int vertex_indices\n",
    b"property list uint double vertex_index\n",
    b"comment\n",
    b"end_header\n",
];

/// OBJ.
pub const OBJ: Target = Target {
    name: "obj",
    extension: "obj",
    seeds: |corpus| files(corpus, &["obj"]),
    mutate: |random, case, other| mutated(random, case, other, OBJ_WORDS),
    run: |_, path| both(path, Format::named("obj")),
    size: <[u8]>::len,
};

const OBJ_WORDS: &[&[u8]] = &[
    b"v 1 2 3\n",
    b"v 1 2 3 4\n",
    b"vn 0 0 1\n",
    b"f 1 2 3\n",
    b"f -1 -2 -3\n",
    b"f 1/1/1 2//2 3/3 4\n",
    b"\\\n",
];

/// OFF.
pub const OFF: Target = Target {
    name: "off",
    extension: "off",
    seeds: |corpus| files(corpus, &["off"]),
    mutate: |random, case, other| mutated(random, case, other, OFF_WORDS),
    run: |_, path| both(path, Format::named("off")),
    size: <[u8]>::len,
};

const OFF_WORDS: &[&[u8]] = &[
    b"OFF",
    b"COFF",
    b"NOFF",
    b"STOFF",
    b"4OFF",
    b"nOFF",
    b"OFF BINARY",
    b"3 0 1 2\n",
    b"4 3 2 1 0 255 0 0\n",
];

/// Tables of points: XYZ, CSV, PTS and their relatives.
pub const TABLE: Target = Target {
    name: "table",
    extension: "csv",
    seeds: |corpus| {
        let mut all = files(corpus, &["xyz", "csv", "pts", "txt", "asc"]);
        all.extend(TABLES.iter().map(|t| t.to_vec()));
        all
    },
    mutate: |random, case, other| mutated(random, case, other, TABLE_WORDS),
    run: |_, path| both(path, Format::named("table")),
    size: <[u8]>::len,
};

const TABLES: [&[u8]; 5] = [
    b"x,y,z\n1,2,3\n4,5,6\n",
    b"name;z;y;x\r\na;1,5;2;3\r\nb;4;5,25;-6\r\n",
    b"3\n0 0 0 12 255 0 0\n1 0 0 13 255 0 0\n0 1e-1 0 14 255 0 0\n",
    b"\xef\xbb\xbf# x y\n1.5 2.5\n3.5\t4.5\n\n5 6 \n",
    b"\"X [mm]\",\"Y [mm]\",\"Z [mm]\"\n\"1\",\"2\",\"3\"\n",
];

const TABLE_WORDS: &[&[u8]] =
    &[b"x y z\n", b"X;Y;Z\n", b"1;2;3\n", b"1,5;2,5;3,5\n", b"1\t2\t3\n", b"#", b"//", b"\"1\""];

/// Arrays of NumPy.
pub const NPY: Target = Target {
    name: "npy",
    extension: "npy",
    seeds: |_| {
        let kinds = [
            (1, "<f8", false, 3),
            (2, ">f4", true, 3),
            (3, "<i2", false, 4),
            (1, "|u1", true, 2),
            (1, ">i8", false, 3),
        ];
        kinds
            .into_iter()
            .map(|(version, descr, fortran, width)| npy(version, descr, fortran, width))
            .collect()
    },
    mutate: |random, case, other| mutated(random, case, other, NPY_WORDS),
    run: |_, path| both(path, Format::named("npy")),
    size: <[u8]>::len,
};

const NPY_WORDS: &[&[u8]] = &[
    b"\x93NUMPY",
    b"'descr': '<f8'",
    b"'>f4'",
    b"'<u8'",
    b"'|b1'",
    b"True",
    b"False",
    b"(6, 3)",
    b"(3,)",
    b"(0, 3)",
    b"}",
];

/// An array of six points.
fn npy(version: u8, descr: &str, fortran: bool, width: usize) -> Vec<u8> {
    let order = if fortran { "True" } else { "False" };
    let text = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': (6, {width}), }}\n");
    let length = (text.len() as u32).to_le_bytes();
    let length = if version == 1 { &length[..2] } else { &length[..] };
    let size: usize = descr[2..].parse().expect("a type ends in its size");
    [b"\x93NUMPY", &[version, 0][..], length, text.as_bytes(), &vec![63; 6 * width * size]].concat()
}

/// Files packed by gzip, of every format.
pub const GZ: Target = Target {
    name: "gz",
    extension: "gz",
    seeds: |corpus| {
        let plain = files(corpus, &["stl", "ply", "obj", "off", "xyz", "csv"]);
        plain.iter().map(|bytes| packed(bytes)).collect()
    },
    mutate: |random, case, other| match random.below(4) {
        0 => mutated(random, case, other, &[b"\x1f\x8b\x08"]),
        // Several members are one file.
        1 => [case, &other.repeat(1 + below(random, 3))].concat().into_iter().take(LONGEST).collect(),
        _ => packed(&mutated(random, &unpacked(case), &unpacked(other), STL_WORDS)),
    },
    run: |_, path| both(path, None),
    // Of what it unpacks to: a packed file may well be a hundred times smaller.
    size: |bytes| bytes.len().max(unpacked(bytes).len()),
};

/// The longest packed case, bytes.
const LONGEST: usize = 1 << 16;

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(vec![], Compression::fast());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).expect("memory takes everything")
}

/// What can be unpacked, up to the first fault.
fn unpacked(bytes: &[u8]) -> Vec<u8> {
    let mut out = vec![];
    let _ = MultiGzDecoder::new(bytes).take(1 << 26).read_to_end(&mut out);
    out
}

pub(super) fn both(path: &Path, format: Option<&'static Format>) {
    read(path, &ReadOptions::default());
    read(path, &ReadOptions { format, weld: Weld::None, block: 5, ..ReadOptions::default() });
}

/// Reads to the end and checks what is promised of all that was read.
fn read(path: &Path, options: &ReadOptions) {
    let input = match open(path, options) {
        Ok(input) => input,
        Err(e) => return refused(&e, path),
    };
    if let Body::Mesh(source) = &input.body {
        whole(source);
    }
    let (mut points, mut block) = (input.body.into_points(), vec![]);
    loop {
        match points.next_block(&mut block) {
            Ok(()) if block.is_empty() => return,
            Ok(()) => assert!(block.iter().flatten().all(|x| x.is_finite()), "a point that is not finite"),
            Err(e) => return refused(&e, path),
        }
    }
}

fn whole(source: &SourceMesh) {
    let (mesh, count) = (&source.mesh, source.mesh.positions.len());
    assert!(mesh.faces.iter().flatten().all(|v| (*v as usize) < count), "a face that names no vertex");
    assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()), "a vertex that is not finite");
    let normals = source.stored_normals.as_ref().map_or(mesh.faces.len(), Vec::len);
    assert!(normals == mesh.faces.len(), "{normals} normals of {} facets", mesh.faces.len());
}

/// An error names the file and what to do.
pub(super) fn refused(e: &ReadError, path: &Path) {
    let text = e.to_string();
    assert!(text.starts_with(&path.display().to_string()), "an error without file: {text}");
    assert!(
        !e.fault.remedy().is_empty() && text.ends_with(e.fault.remedy()),
        "an error without remedy: {text}"
    );
}
