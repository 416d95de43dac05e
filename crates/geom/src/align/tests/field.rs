//! The grid of distances and the table of pairs, beside what they stand for.

use super::parts::{bracket, random_pose};
use crate::align::features::{PairFrame, PairTable};
use crate::align::field::{Field, SampleBlock};
use crate::align::sample::{Samples, on_surface};
use crate::closest::Tree;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::{Point, dot, minus, norm};
use std::collections::{BTreeMap, BTreeSet};

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

/// The score of a pose is that of exact distances, as far as a grid can tell. For nearly all samples it is within the share of
/// reach by which a surface may bend in half a cell.
#[test]
fn the_grid_tells_what_exact_distances_do() {
    let reference = bracket(4.0);
    let tree = Tree::build(&reference).unwrap();
    let reach = 5.0;
    let field = Field::new(&tree, &reference.bounds(), reach, &Silent).unwrap();
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
                let score = field.score(&placed, &SampleBlock::of(&one, middle), reach);
                sum += score;
                let p = pose.point(samples.points[i]);
                let hit = tree.closest(&p, f64::INFINITY).unwrap().unwrap();
                let facet = crate::align::field::facet_normal(&reference, hit.face).unwrap();
                let cosine = dot(pose.vector(samples.normals[i]), facet);
                let cosine = if oriented { cosine } else { cosine.abs() };
                let agrees = samples.normals[i] == [0.0; 3] || cosine >= 0.35;
                let share = (hit.distance / reach).min(1.0);
                let exact = if agrees { 1.0 - share * share } else { 0.0 };
                far_off += usize::from((score - exact).abs() > 0.1);
            }
            assert!(far_off < samples.points.len() / 20, "{far_off}");
            // All at once: the same, but for the order of the sum.
            let all = field.score(&placed, &SampleBlock::of(&samples, middle), reach);
            assert!((all - sum).abs() < 1e-4 * sum.max(1.0), "{all} {sum}");
        }
    }
}

/// A pair finds all pairs whose four numbers are within half a cell of its own. It finds none more than one and a half cells
/// away. It finds as many as are counted.
#[test]
fn pairs_are_found_where_they_lie() {
    let places = on_surface(&bracket(4.0), 60, 3);
    let all: Vec<_> = places.points.iter().copied().zip(places.normals.iter().copied()).collect();
    let (step, least) = (4.0, 8.0);
    let table = PairTable::new(&places, step, least);
    // Distance and angles in cells, by arc cosines.
    let numbers = |i: usize, j: usize| {
        let x = minus(all[j].0, all[i].0);
        let angle = |c: f64| libm::acos(c.clamp(-1.0, 1.0)) * 16.0 / std::f64::consts::PI;
        let [a, b] = [i, j].map(|k| angle(dot(all[k].1, x) / norm(x)));
        [norm(x) / step, a, b, angle(dot(all[i].1, all[j].1))]
    };
    let pairs = (0..60u16).flat_map(|i| (0..60u16).map(move |j| [i, j]));
    let pairs: Vec<([u16; 2], [f64; 4])> = pairs
        .filter(|[i, j]| i != j)
        .map(|p| (p, numbers(usize::from(p[0]), usize::from(p[1]))))
        .filter(|(_, own)| own[0] * step >= least)
        .collect();
    assert!(pairs.len() > 2000, "{}", pairs.len());
    let mut known = BTreeMap::new();
    known.extend(pairs.iter().copied());
    for ([i, j], own) in &pairs {
        let (a, b) = (all[usize::from(*i)], all[usize::from(*j)]);
        let like = table.like(a, b);
        assert_eq!(like.len(), table.count_like(a, b));
        let apart = |other: &[f64; 4]| (0..4).map(|k| (own[k] - other[k]).abs()).fold(0.0, f64::max);
        let found: BTreeSet<[u16; 2]> = like.iter().copied().collect();
        assert_eq!(found.len(), like.len());
        assert!(found.iter().all(|p| apart(&known[p]) <= 1.5 + 1e-9));
        assert!(pairs.iter().all(|(p, other)| apart(other) > 0.5 - 1e-9 || found.contains(p)), "{i} {j}");
        if let Some(frame) = PairFrame::best(a, b)
            && let Some(pose) = table.pose(&frame, [*i, *j])
        {
            assert!(pose.displacement(a.0) < 1e-9);
        }
    }
}
