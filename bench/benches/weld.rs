//! Loose triangles to shared vertices.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use trueness_bench::shapes;
use trueness_geom::topology::weld;

fn corners(c: &mut Criterion) {
    let mesh = shapes::torus(400);
    let at = |v: u32| mesh.positions[v as usize].map(|x| x as f32);
    let soup: Vec<[[f32; 3]; 3]> = mesh.faces.iter().map(|face| face.map(at)).collect();
    let mut group = c.benchmark_group("weld");
    group.sample_size(10).throughput(Throughput::Elements(soup.len() as u64));
    group.bench_function(soup.len().to_string(), |b| b.iter(|| weld::corners(soup.len(), |f, k| soup[f][k])));
}

criterion_group!(benches, corners);
criterion_main!(benches);
