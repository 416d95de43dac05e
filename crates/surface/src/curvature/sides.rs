//! Normals of a cloud to one side.

use super::jet::Jet;
use super::terms::NoCurvature;
use trueness_geom::num::sum::Sum;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, Vector, dot, minus, norm};
use trueness_geom::spatial::lists::lists;
use trueness_geom::topology::union::Sets;

/// A part is a body by the mean of n · (p − c) over the mean distance |p − c| from its middle c. That ratio is at least
/// this share of the length of its mean normal. In a closed body the former is above 0 (three times volume over area)
/// and the latter 0, however it is shaped. In a flat sheet the former is 0 and the latter 1.
const MIN_BODY_RATIO: f64 = 0.25;

type JetResult = Result<Jet, NoCurvature>;

/// Turns the normals of each part that hangs together to one side, and gives the number of parts.
///
/// Neighbors agree about the side along the tree that is least in all in `1 − |cosine|` of their normals (Kruskal 1956); equal ones by
/// number.
pub(super) fn turn(
    points: &[Point],
    places: &mut [JetResult],
    links: &[Vec<u32>],
    progress: &dyn Progress,
) -> Result<usize, Cancelled> {
    let normal = |i: u32| places[i as usize].as_ref().ok().map(|jet| jet.bend.normal);
    let mut edges: Vec<(u64, [u32; 2])> = (0..places.len() as u32)
        .into_par_iter()
        .flat_map_iter(|i| {
            let own = normal(i);
            links[i as usize].iter().filter_map(move |&n| {
                let bend = 1.0 - dot(own?, normal(n)?).abs();
                // The bits of numbers that are not negative rise as the numbers do.
                Some((bend.max(0.0).to_bits(), [i.min(n), i.max(n)]))
            })
        })
        .collect();
    edges.par_sort_unstable();
    edges.dedup();
    if progress.cancelled() {
        return Err(Cancelled);
    }
    let sets = Sets::new(places.len());
    let mut tree = vec![];
    for (_, [a, b]) in edges {
        if sets.root(a) != sets.root(b) {
            sets.join(a, b);
            tree.extend([[a, b], [b, a]]);
        }
    }
    if progress.cancelled() {
        return Err(Cancelled);
    }
    let (parts, part_of) = sets.numbered(|i| places[i as usize].is_ok());
    agree(places, tree);
    let inward = inward(points, places, parts, &part_of);
    for (place, part) in places.iter_mut().zip(&part_of) {
        if inward.get(*part as usize).is_some_and(|turn| *turn) {
            *place = place.map(Jet::turned);
        }
    }
    Ok(parts)
}

/// Goes along the tree from the least number of each part.
fn agree(places: &mut [JetResult], tree: Vec<[u32; 2]>) {
    let (first, others) = lists(places.len(), tree);
    let mut met = vec![false; places.len()];
    let mut open = vec![];
    for start in 0..places.len() as u32 {
        if met[start as usize] {
            continue;
        }
        met[start as usize] = true;
        open.push(start);
        while let Some(i) = open.pop() {
            let Ok(own) = places[i as usize] else { continue };
            for &n in &others[first[i as usize] as usize..first[i as usize + 1] as usize] {
                if std::mem::replace(&mut met[n as usize], true) {
                    continue;
                }
                let place = &mut places[n as usize];
                if place.is_ok_and(|jet| dot(jet.bend.normal, own.bend.normal) < 0.0) {
                    *place = place.map(Jet::turned);
                }
                open.push(n);
            }
        }
    }
}

/// For each part whether it looks inward, and must be turned.
fn inward(points: &[Point], places: &[JetResult], parts: usize, part_of: &[u32]) -> Vec<bool> {
    let of = |i: usize| Some((part_of[i] as usize, places[i].as_ref().ok()?.bend.normal));
    let known = || (0..places.len()).filter_map(|i| of(i).map(|(part, normal)| (i, part, normal)));
    let mut counts = vec![0.0; parts];
    let mut middles = vec![[Sum::default(); 3]; parts];
    let mut normals = vec![[Sum::default(); 3]; parts];
    let add = |sums: &mut [Sum; 3], v: Vector| (0..3).for_each(|k| sums[k] = sums[k].plus(v[k]));
    for (i, part, normal) in known() {
        counts[part] += 1.0;
        add(&mut middles[part], points[i]);
        add(&mut normals[part], normal);
    }
    let middles: Vec<Point> =
        middles.iter().zip(&counts).map(|(sums, n)| sums.map(|s| s.value() / n)).collect();
    let mut outward = vec![[Sum::default(); 2]; parts];
    for (i, part, normal) in known() {
        let away = minus(points[i], middles[part]);
        let [along, far] = outward[part];
        outward[part] = [along.plus(dot(normal, away)), far.plus(norm(away))];
    }
    (0..parts)
        .map(|part| {
            let [along, far] = outward[part].map(Sum::value);
            let mean = normals[part].map(|s| s.value() / counts[part]);
            if along.abs() >= MIN_BODY_RATIO * norm(mean) * far {
                return along < 0.0;
            }
            let largest = (0..3).fold(0, |best, k| if mean[k].abs() > mean[best].abs() { k } else { best });
            mean[largest] < 0.0
        })
        .collect()
}
