//! Broken bytes: every small file of the corpus cut off anywhere, and with bytes changed at random, is answered or refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Folder, read};
use std::path::{Path, PathBuf};
use trueness_geom::num::random::Random;

/// Larger files say nothing new and cost time.
const SMALL: u64 = 6000;

fn small_files() -> Vec<PathBuf> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    let mut files: Vec<PathBuf> = ["shapes", "broken"]
        .iter()
        .flat_map(|f| std::fs::read_dir(corpus.join(f)).unwrap())
        .map(|e| e.unwrap().path())
        .filter(|p| std::fs::metadata(p).unwrap().len() < SMALL)
        .collect();
    files.sort();
    assert!(files.len() > 60);
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
    for path in small_files() {
        let bytes = std::fs::read(&path).unwrap();
        for end in (0..bytes.len()).step_by(1 + bytes.len() / 150) {
            try_bytes(&folder, &name(&path), &bytes[..end]);
        }
    }
}

#[test]
fn changed_bytes() {
    let folder = Folder::new();
    let mut random = Random::new(11);
    for path in small_files() {
        let original = std::fs::read(&path).unwrap();
        if original.is_empty() {
            continue;
        }
        for _ in 0..100 {
            let mut bytes = original.clone();
            for _ in 0..=random.below(4) {
                let at = random.below(bytes.len() as u64) as usize;
                bytes[at] = random.next_u64() as u8;
            }
            try_bytes(&folder, &name(&path), &bytes);
        }
    }
}
