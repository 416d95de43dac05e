//! Files beyond what 32 bits can address: an STL of more than 2 GB (MeshLab 823: read as broken).
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use trueness_files::{Body, ReadOptions};

const FACETS: u64 = 43_000_001;

/// Zeros throughout, which the file system does not store, but for the count and the very last facet.
fn write_mostly_empty(file: &mut File) -> std::io::Result<()> {
    file.set_len(84 + 50 * FACETS)?;
    file.seek(SeekFrom::Start(80))?;
    file.write_all(&(FACETS as u32).to_le_bytes())?;
    file.seek(SeekFrom::Start(84 + 50 * (FACETS - 1) + 12))?;
    for x in [1.0f32, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0] {
        file.write_all(&x.to_le_bytes())?;
    }
    Ok(())
}

#[test]
fn stl_of_more_than_two_gigabytes() {
    let path = std::env::temp_dir().join(format!("trueness-large-{}.stl", std::process::id()));
    let mut file = File::create(&path).unwrap();
    let read = write_mostly_empty(&mut file).map(|()| trueness_files::open(&path, &ReadOptions::default()));
    std::fs::remove_file(&path).unwrap();
    let input = read.unwrap().unwrap_or_else(|e| panic!("{e}"));
    assert!(input.provenance.bytes > 1 << 31);
    let Body::Mesh(mesh) = input.body else { panic!("not a mesh") };
    assert_eq!(mesh.mesh.faces.len() as u64, FACETS);
    assert_eq!(mesh.mesh.positions, [[0.0; 3], [1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]);
    assert_eq!(mesh.mesh.faces[0], [0, 0, 0]);
    assert_eq!(mesh.mesh.faces[FACETS as usize - 1], [1, 2, 3]);
}
