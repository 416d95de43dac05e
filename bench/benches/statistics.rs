//! Statistics of deviations: all at hand, and as a stream.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use trueness_geom::{
    num::random::Random,
    stats::statistics::{Accumulator, Summary},
};

fn statistics(c: &mut Criterion) {
    let mut random = Random::new(1);
    // The sum of a few uniform numbers: near enough to a normal distribution.
    let values: Vec<f64> = (0..1 << 20).map(|_| (0..6).map(|_| random.unit() - 0.5).sum()).collect();
    let mut group = c.benchmark_group("statistics");
    group.sample_size(10).throughput(Throughput::Elements(values.len() as u64));
    group.bench_function("exact", |b| b.iter(|| Summary::of(&values)));
    group.bench_function("stream", |b| {
        b.iter(|| {
            let mut all = Accumulator::new();
            values.chunks(100_000).for_each(|block| all.push(block));
            all.summary()
        });
    });
}

criterion_group!(benches, statistics);
criterion_main!(benches);
