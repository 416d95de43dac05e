//! Reading files of each kind from the page cache.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::{env, fmt::Write, fs, process};
use trueness_bench::{read_mesh, read_points, shapes};
use trueness_geom::mesh::Mesh;

fn readers(c: &mut Criterion) {
    let folder = env::temp_dir().join(format!("trueness-bench-{}", process::id()));
    fs::create_dir_all(&folder).expect("a folder for the files");
    let mesh = shapes::torus(250);
    let points = shapes::scan(&mesh, 300_000, 0.5);

    let mut group = c.benchmark_group("read");
    group.sample_size(10);
    group.throughput(Throughput::Elements(mesh.faces.len() as u64));
    let stl = folder.join("mesh.stl");
    fs::write(&stl, binary_stl(&mesh)).expect("room for the file");
    group.bench_function("stl", |b| b.iter(|| read_mesh(&stl)));

    group.throughput(Throughput::Elements(points.len() as u64));
    let xyz = folder.join("points.xyz");
    let text = points.iter().fold(String::new(), |mut text, [x, y, z]| {
        let _ = writeln!(text, "{x:.6} {y:.6} {z:.6}");
        text
    });
    fs::write(&xyz, text).expect("room for the file");
    group.bench_function("xyz", |b| b.iter(|| read_points(&xyz)));

    let ply = folder.join("points.ply");
    let head = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n\
         property double z\nend_header\n",
        points.len()
    );
    let body = points.iter().flatten().flat_map(|x| x.to_le_bytes());
    fs::write(&ply, head.bytes().chain(body).collect::<Vec<u8>>()).expect("room for the file");
    group.bench_function("ply", |b| b.iter(|| read_points(&ply)));
    group.finish();
    fs::remove_dir_all(&folder).expect("our own folder");
}

/// Binary STL with zero normals, which readers must not rely on anyway.
fn binary_stl(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((mesh.faces.len() as u32).to_le_bytes());
    for face in &mesh.faces {
        bytes.extend([0; 12]);
        for v in face {
            bytes.extend(mesh.positions[*v as usize].iter().flat_map(|x| (*x as f32).to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

criterion_group!(benches, readers);
criterion_main!(benches);
