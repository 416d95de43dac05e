//! Broken bytes: every small file of the corpus, arrays, tables and packed files, cut off anywhere and with bytes changed at
//! random, are answered or refused.

use crate::common;

use common::{Folder, gzip, read};
use std::path::{Path, PathBuf};
use trueness_geom::num::random::Random;

/// Larger files say nothing new and cost time.
const SMALL: u64 = 6000;

/// The bytes to break, under names that end as their format does.
fn sound_files() -> Vec<(String, Vec<u8>)> {
    let mut all: Vec<(String, Vec<u8>)> =
        small_files().into_iter().map(|p| (name(&p), std::fs::read(p).unwrap())).collect();
    all.extend([
        ("c.npy".into(), npy(1, "<f8", false)),
        ("fortran.npy".into(), npy(2, ">f4", true)),
        ("integers.npy".into(), npy(3, "<i2", false)),
        ("named.csv".into(), b"z;y;x\r\n1,5;2;3\r\n4;5,25;-6\r\n".to_vec()),
        ("scan.pts".into(), b"3\n0 0 0 12 255 0 0\n1 0 0 13 255 0 0\n0 1e-1 0 14 255 0 0\n".to_vec()),
        (
            "thick.csv".into(),
            b"Nr;\"X [in]\";Y [in];Z [in];note\n1;\"1,5\";2;3;\"a;b\"\n2;4;5,25;-6;\n;;;;\n".to_vec(),
        ),
        ("plane.xyz".into(), b"# x y\n1.5 2.5\n3.5\t4.5\n\n5 6 \n".to_vec()),
    ]);
    let packed: Vec<(String, Vec<u8>)> =
        all.iter().step_by(9).map(|(name, bytes)| (format!("{name}.gz"), gzip(bytes))).collect();
    all.extend(packed);
    all
}

/// An array of six points.
fn npy(version: u8, descr: &str, fortran: bool) -> Vec<u8> {
    let order = if fortran { "True" } else { "False" };
    let text = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': (6, 3), }}\n");
    let length = (text.len() as u32).to_le_bytes();
    let length = if version == 1 { &length[..2] } else { &length[..] };
    let size: usize = descr[2..].parse().unwrap();
    [b"\x93NUMPY", &[version, 0][..], length, text.as_bytes(), &vec![63; 18 * size]].concat()
}

fn small_files() -> Vec<PathBuf> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    let mut files: Vec<PathBuf> = ["shapes", "broken", "scans"]
        .iter()
        .flat_map(|f| std::fs::read_dir(corpus.join(f)).unwrap())
        .map(|e| e.unwrap().path())
        .filter(|p| std::fs::metadata(p).unwrap().len() < SMALL)
        .collect();
    files.sort();
    assert!(files.len() > 75);
    files
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

/// A panic or an endless loop is the failure; an error must name the file.
fn try_bytes(folder: &Folder, name: &str, bytes: &[u8]) {
    let path = folder.file(name, bytes);
    if let Err(e) = read(&path) {
        assert!(e.to_string().contains(name), "{e}");
    }
}

#[test]
fn cut_off_anywhere() {
    let folder = Folder::new();
    for (name, bytes) in sound_files() {
        for end in (0..bytes.len()).step_by(1 + bytes.len() / 150) {
            try_bytes(&folder, &name, &bytes[..end]);
        }
    }
}

#[test]
fn changed_bytes() {
    let folder = Folder::new();
    let mut random = Random::new(11);
    for (name, original) in sound_files() {
        if original.is_empty() {
            continue;
        }
        for _ in 0..100 {
            let mut bytes = original.clone();
            for _ in 0..=random.below(4) {
                let at = random.below(bytes.len() as u64) as usize;
                bytes[at] = random.next_u64() as u8;
            }
            try_bytes(&folder, &name, &bytes);
        }
    }
}

#[test]
fn what_is_broken_here_is_sound_before() {
    let folder = Folder::new();
    let made = sound_files().into_iter().filter(|(name, _)| !name.ends_with(".gz")).rev().take(7);
    for (name, bytes) in made {
        let whole = read(&folder.file(&name, &bytes)).unwrap_or_else(|e| panic!("{e}"));
        assert!(whole.points.len() >= 2, "{name}");
    }
}
