//! What the tests share.

use std::{
    io::Write,
    path::{Path, PathBuf},
    sync::atomic::{AtomicU64, Ordering::Relaxed},
};
use trueness_files::{Body, Input, ReadError, ReadOptions, open};
use trueness_geom::space::Point;

/// An empty folder, removed when it goes out of scope.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new() -> Folder {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let name = format!("trueness-files-test-{}-{}", std::process::id(), NEXT.fetch_add(1, Relaxed));
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
    pub fn path(&self) -> &Path {
        &self.0
    }
    /// A file of these bytes.
    pub fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A file read to its end.
#[derive(Debug)]
pub struct Whole {
    pub kind: &'static str,
    pub format: &'static str,
    pub gzip: bool,
    pub warnings: usize,
    pub points: Vec<Point>,
    pub faces: usize,
}

pub fn read(path: &Path) -> Result<Whole, ReadError> {
    read_with(path, &ReadOptions::default())
}

pub fn read_with(path: &Path, options: &ReadOptions) -> Result<Whole, ReadError> {
    whole(open(path, options)?)
}

/// An input read to its end.
pub fn whole(input: Input) -> Result<Whole, ReadError> {
    let (kind, faces) = match &input.body {
        Body::Mesh(m) => ("mesh", m.mesh.faces.len()),
        Body::Points(_) => ("points", 0),
        Body::Splines(_) => ("splines", 0),
        Body::Cad(_) => ("cad", 0),
        Body::Drawing(_) => ("drawing", 0),
    };
    let mut stream = input.body.into_points();
    let (mut points, mut block) = (vec![], vec![]);
    loop {
        stream.next_block(&mut block)?;
        if block.is_empty() {
            break;
        }
        points.append(&mut block);
    }
    let p = input.provenance;
    let warnings = input.warnings.len();
    Ok(Whole { kind, format: p.format, gzip: p.gzip, warnings, points, faces })
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(vec![], flate2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// A generator of numbers that are the same in every run.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 >> 33
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n.max(1) as u64) as usize
    }
}
