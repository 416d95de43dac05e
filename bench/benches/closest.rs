//! Building the search tree, and asking it.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use trueness_bench::shapes;
use trueness_geom::{
    closest::{Query, Signs, Tree},
    progress::Silent,
};

fn build(c: &mut Criterion) {
    let mut group = c.benchmark_group("closest/build");
    group.sample_size(10);
    for n in [100, 400] {
        let mesh = shapes::torus(n);
        group.throughput(Throughput::Elements(mesh.faces.len() as u64));
        group.bench_function(mesh.faces.len().to_string(), |b| {
            b.iter_batched(|| (), |()| Tree::build(&mesh), BatchSize::LargeInput);
        });
    }
}

fn query(c: &mut Criterion) {
    let mesh = shapes::torus(400);
    let tree = Tree::build(&mesh).expect("a torus");
    let signs = Signs::new(&tree);
    let scan = shapes::scan(&mesh, 200_000, 0.5);
    let far: Vec<_> = scan.iter().map(|p| p.map(|x| 1.5 * x)).collect();
    let query = Query::default();
    let mut group = c.benchmark_group("closest/query");
    group.sample_size(10).throughput(Throughput::Elements(scan.len() as u64));
    group.bench_function("scan", |b| b.iter(|| tree.distances(&scan, &query, &Silent)));
    group.bench_function("scan, signed", |b| b.iter(|| signs.distances(&scan, &query, &Silent)));
    group.bench_function("far", |b| b.iter(|| tree.distances(&far, &query, &Silent)));
    group.bench_function("one point", |b| {
        let mut next = scan.iter().cycle();
        b.iter(|| next.next().map(|p| tree.closest(p, f64::INFINITY)));
    });
}

criterion_group!(benches, build, query);
criterion_main!(benches);
