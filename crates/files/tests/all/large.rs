//! Files beyond what 32 bits can address: an STL of more than 2 GB (MeshLab 823: read as broken), and one of more than 4 GB.

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use trueness_files::{Body, ReadOptions, SourceMesh};
use trueness_geom::check::{self, Options, check};
use trueness_geom::progress::Silent;

/// Zeros throughout, which the file system does not store, but for the count and the very last facet.
fn write_mostly_empty(file: &mut File, facets: u64) -> std::io::Result<()> {
    file.set_len(84 + 50 * facets)?;
    file.seek(SeekFrom::Start(80))?;
    file.write_all(&(facets as u32).to_le_bytes())?;
    file.seek(SeekFrom::Start(84 + 50 * (facets - 1) + 12))?;
    for x in [1.0f32, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0] {
        file.write_all(&x.to_le_bytes())?;
    }
    Ok(())
}

fn read_of_size(facets: u64) -> SourceMesh {
    let path = std::env::temp_dir().join(format!("trueness-large-{facets}-{}.stl", std::process::id()));
    let mut file = File::create(&path).unwrap();
    let read =
        write_mostly_empty(&mut file, facets).map(|()| trueness_files::open(&path, &ReadOptions::default()));
    std::fs::remove_file(&path).unwrap();
    let input = read.unwrap().unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(input.provenance.bytes, 84 + 50 * facets);
    let Body::Mesh(mesh) = input.body else { panic!("not a mesh") };
    assert_eq!(mesh.mesh.faces.len() as u64, facets);
    assert_eq!(mesh.mesh.positions, [[0.0; 3], [1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]);
    assert_eq!(mesh.mesh.faces[0], [0, 0, 0]);
    assert_eq!(mesh.mesh.faces[facets as usize - 1], [1, 2, 3]);
    mesh
}

#[test]
fn stl_of_more_than_two_gigabytes() {
    let facets = 43_000_001;
    assert!(50 * facets > 1 << 31);
    read_of_size(facets);
}

#[test]
#[ignore = "takes 6 GB of memory and half a minute"]
fn stl_of_more_than_four_gigabytes_is_read_and_checked() {
    let facets = 90_000_001;
    assert!(50 * facets > 1 << 32);
    let mesh = read_of_size(facets);
    let report = check(&mesh.mesh, mesh.stored_normals.as_deref(), &Options::default(), &Silent).unwrap();
    // The last facet has its corners on a line: without area, but with edges.
    assert_eq!(report.found(check::DEGENERATE_FACETS).unwrap().count as u64, facets);
    assert_eq!((report.edges, report.found(check::BOUNDARY_EDGES).unwrap().count), (3, 3));
}
