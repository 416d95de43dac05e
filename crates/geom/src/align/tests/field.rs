//! The grid of distances and the table of pairs, beside what they stand for.

use super::parts::{bracket, random_pose};
use crate::align::features::{PairFrame, PairTable};
use crate::align::field::{Field, SampleBlock};
use crate::align::sample::{Samples, on_surface};
use crate::closest::Tree;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::{Point, dot, minus, norm};

/// Samples on the surface and beside it, with and without normals, in any pose, a number that fills no whole block.
fn samples(oriented: bool) -> Samples {
    let mut samples = on_surface(&bracket(4.0), 333, 5);
    let random = &mut Random::new(6);
    for (i, p) in samples.points.iter_mut().enumerate() {
        *p = p.map(|x| x + 8.0 * (random.unit() - 0.5));
        if i % 10 == 3 {
            samples.normals[i] = [0.0; 3];
        }
        if i % 50 == 7 {
            *p = [1e9, -1e7, 3.0];
        }
    }
    samples.oriented = oriented;
    samples
}

/// The worth of a pose is that of exact distances, as far as a grid can tell: within the share of reach by which a surface may bend in
/// half a cell, for nearly all samples.
#[test]
fn the_grid_tells_what_exact_distances_do() {
    let reference = bracket(4.0);
    let tree = Tree::build(&reference).unwrap();
    let reach = 5.0;
    let field = Field::new(&reference, &tree, &reference.bounds(), reach, &Silent).unwrap();
    let random = &mut Random::new(9);
    for oriented in [true, false] {
        let samples = samples(oriented);
        let middle: Point = [3.0, -20.0, 7.0];
        for _ in 0..4 {
            let pose = random_pose(random, 5.0).inverse();
            let placed = field.placed(&pose, middle);
            let (mut far_off, mut sum) = (0, 0.0);
            for i in 0..samples.points.len() {
                let one = Samples {
                    points: vec![samples.points[i]],
                    normals: vec![samples.normals[i]],
                    weights: vec![1.0],
                    oriented,
                };
                let worth = field.worth(&placed, &SampleBlock::of(&one, middle), reach);
                sum += worth;
                let p = pose.point(samples.points[i]);
                let hit = tree.closest(&p, f64::INFINITY).unwrap().unwrap();
                let facet = crate::align::field::facet_normal(&reference, hit.face).unwrap();
                let cosine = dot(pose.vector(samples.normals[i]), facet);
                let cosine = if oriented { cosine } else { cosine.abs() };
                let agrees = samples.normals[i] == [0.0; 3] || cosine >= 0.35;
                let share = (hit.distance / reach).min(1.0);
                let exact = if agrees { 1.0 - share * share } else { 0.0 };
                far_off += usize::from((worth - exact).abs() > 0.1);
            }
            assert!(far_off < samples.points.len() / 20, "{far_off}");
            // All at once: the same, but for the order of the sum.
            let all = field.worth(&placed, &SampleBlock::of(&samples, middle), reach);
            assert!((all - sum).abs() < 1e-4 * sum.max(1.0), "{all} {sum}");
        }
    }
}

/// A pair finds the pairs that lie like it, itself among them, and none that lie otherwise; there are as many as are counted.
#[test]
fn pairs_are_found_where_they_lie() {
    let places = on_surface(&bracket(4.0), 60, 3);
    let all: Vec<_> = places.points.iter().copied().zip(places.normals.iter().copied()).collect();
    let (step, least) = (4.0, 8.0);
    let table = PairTable::new(&places, step, least);
    let mut tried = 0;
    for (i, j) in (0..60).flat_map(|i| (0..60).map(move |j| (i, j))) {
        let like = table.like(all[i], all[j]);
        assert_eq!(like.len(), table.count_like(all[i], all[j]));
        let length = |[a, b]: [usize; 2]| norm(minus(all[b].0, all[a].0));
        if length([i, j]) < least {
            continue;
        }
        tried += 1;
        assert!(like.contains(&[i as u16, j as u16]), "{i} {j}");
        let angles = |[a, b]: [usize; 2]| {
            let x = minus(all[b].0, all[a].0);
            [dot(all[a].1, x) / norm(x), dot(all[b].1, x) / norm(x), dot(all[a].1, all[b].1)]
                .map(|c| libm::acos(c.clamp(-1.0, 1.0)).to_degrees())
        };
        for pair in like.iter().map(|p| p.map(usize::from)) {
            assert!((length(pair) - length([i, j])).abs() <= 1.5 * step + 1e-9);
            let (own, other) = (angles([i, j]), angles(pair));
            assert!(
                (0..3).all(|k| (own[k] - other[k]).abs() <= 1.5 * 180.0 / 16.0 + 1e-6),
                "{own:?} {other:?}"
            );
        }
        if let Some(frame) = PairFrame::best(all[i], all[j])
            && let Some(pose) = table.pose(&frame, [i as u16, j as u16])
        {
            assert!(pose.displacement(all[i].0) < 1e-9);
        }
    }
    assert!(tried > 2000, "{tried}");
}
