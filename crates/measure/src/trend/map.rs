//! Mean and spread over many parts at places that all share.

use crate::statistics::{counted, statistics};
use trueness_document::place_map::{MapPlace, MapQuantity, PlaceMap, TrendMap};
use trueness_document::scale::Scale;
use trueness_geom::mesh::Mesh;
use trueness_geom::stats::statistics::Summary;

/// Sums under way: B. P. Welford, "Note on a method for calculating corrected sums of squares and products", Technometrics 4, 1962.
#[derive(Clone, Copy, Default)]
struct Running {
    count: u64,
    mean: f64,
    squares: f64,
}

impl Running {
    fn add(&mut self, x: f64) {
        self.count += 1;
        let before = x - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (x - self.mean);
    }
}

/// The map over all parts, from their maps in their order; `None` of none. `tolerance` is that of the deviations, which the colors show.
///
/// # Errors
/// The number of a map whose places are not those of the first, or which has another number of values.
pub fn map(maps: &[&PlaceMap], tolerance: Option<[f64; 2]>) -> Result<Option<TrendMap>, usize> {
    let Some(first) = maps.first() else { return Ok(None) };
    let count = first.places.len();
    let mut running = vec![Running::default(); count];
    for (n, map) in maps.iter().enumerate() {
        let corner = |v: &u32| (*v as usize) < count;
        let whole = map.deviations.len() == count && map.facets.iter().flatten().all(corner);
        if map.places != first.places || map.facets != first.facets || !whole {
            return Err(n);
        }
        for (r, deviation) in running.iter_mut().zip(&map.deviations) {
            deviation.iter().for_each(|d| r.add(*d));
        }
    }
    let all = maps.len() as u64;
    let number = |f: &dyn Fn(u64) -> bool| running.iter().filter(|r| f(r.count)).count() as u64;
    let mean: Vec<Option<f64>> = running.iter().map(|r| (r.count > 0).then_some(r.mean)).collect();
    let spread = |r: &Running| (r.count > 1).then(|| (r.squares / (r.count - 1) as f64).sqrt());
    let std_dev: Vec<Option<f64>> = running.iter().map(spread).collect();
    let complete = |values: &[Option<f64>]| -> Vec<(usize, f64)> {
        let of = |(n, v): (usize, &Option<f64>)| v.filter(|_| running[n].count == all).map(|v| (n, v));
        values.iter().enumerate().filter_map(of).collect()
    };
    // Gray facets hide their corners.
    let whole = |f: &&[u32; 3]| f.iter().all(|v| running[*v as usize].count == all);
    let mut seen = vec![false; count];
    first.facets.iter().filter(whole).flatten().for_each(|v| seen[*v as usize] = true);
    let means = quantity(&complete(&mean), (first, &seen), |p95| Scale::for_deviations(p95, tolerance));
    let std_devs = quantity(&complete(&std_dev), (first, &seen), |p95| Scale {
        lower: 0.0,
        ..Scale::for_deviations(p95, None)
    });
    Ok(Some(TrendMap {
        places: first.places.clone(),
        facets: first.facets.clone(),
        parts: running.iter().map(|r| r.count).collect(),
        complete: number(&|c| c == all),
        partial: number(&|c| c > 0 && c < all),
        without: number(&|c| c == 0),
        mean,
        std_dev,
        means,
        std_devs,
    }))
}

/// The surface that the places lie on.
pub fn mesh(map: &TrendMap) -> Mesh {
    Mesh { positions: map.places.clone(), faces: map.facets.clone() }
}

/// A quantity from values with the numbers of their places, which are `seen` where a facet is drawn in their colors.
fn quantity(
    values: &[(usize, f64)],
    (map, seen): (&PlaceMap, &[bool]),
    scale: impl Fn(f64) -> Scale,
) -> MapQuantity {
    let numbers: Vec<f64> = values.iter().map(|v| v.1).collect();
    let summary = Summary::of(&numbers);
    let size = |v: &(usize, f64)| v.1.abs();
    let colored = values.iter().filter(|v| seen[v.0]);
    let greatest = colored.reduce(|best, v| if size(v) > size(best) { v } else { best });
    MapQuantity {
        statistics: statistics(&summary.all, summary.quantile_error),
        histogram: counted(&summary.all, &numbers),
        greatest: greatest.map(|&(n, value)| MapPlace { index: n as u64, position: map.places[n], value }),
        scale: scale(summary.p95_abs.unwrap_or(0.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(deviations: Vec<Option<f64>>) -> PlaceMap {
        let places = (0..5).map(|k| [f64::from(k & 1), f64::from(k >> 1), 0.0]).collect();
        let facets = vec![[0, 1, 2], [1, 3, 2], [0, 4, 2], [0, 4, 1]];
        PlaceMap { places, facets, deviations, points: vec![1; 5], reach: 0.5 }
    }

    /// Direct sums, far from zero, with a place that one part lacks and one that all lack.
    #[test]
    fn mean_and_spread_are_those_of_the_values() {
        let value = |part: u32, place: u32| match (part, place) {
            (3, 1) | (_, 3) => None,
            _ => Some(1e6 + f64::from((part * 7 + place * 3) % 11) * 0.01),
        };
        let maps: Vec<PlaceMap> = (0..9).map(|part| map((0..5).map(|k| value(part, k)).collect())).collect();
        let found = super::map(&maps.iter().collect::<Vec<_>>(), None).unwrap().unwrap();
        assert_eq!((found.complete, found.partial, found.without), (3, 1, 1));
        assert_eq!(found.parts, [9, 8, 9, 0, 9]);
        for place in 0..3u32 {
            let there: Vec<f64> = (0..9).filter_map(|part| value(part, place)).map(|v| v - 1e6).collect();
            let n = there.len() as f64;
            let mean = there.iter().sum::<f64>() / n;
            let spread = (there.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
            assert!((found.mean[place as usize].unwrap() - 1e6 - mean).abs() < 1e-9);
            assert!((found.std_dev[place as usize].unwrap() - spread).abs() < 1e-9, "{place}");
        }
        assert_eq!((found.mean[3], found.std_dev[3]), (None, None));
        // What is drawn and counted is of the places that every part has.
        let drawn = found.drawn(&found.mean);
        assert_eq!(drawn.iter().map(|v| v.is_nan()).collect::<Vec<_>>(), [false, true, false, true, false]);
        assert_eq!(found.means.statistics.count, 3);
        let most = found.std_devs.greatest.unwrap();
        assert_eq!(Some(most.value), found.std_dev[most.index as usize]);
        assert_eq!((found.std_devs.scale.lower, found.means.scale.lower < 0.0), (0.0, true));
    }

    #[test]
    fn one_part_has_no_spread_and_other_places_are_refused() {
        // The greatest value of all stands where all facets are gray.
        let one = map(vec![Some(0.1), Some(-0.2), None, Some(0.9), Some(0.0)]);
        let found = super::map(&[&one], Some([-0.1, 0.1])).unwrap().unwrap();
        assert_eq!((found.mean[1], found.std_dev[1], found.std_devs.greatest), (Some(-0.2), None, None));
        assert_eq!(found.means.greatest.map(|g| (g.index, g.value)), Some((1, -0.2)));
        assert_eq!(found.means.scale.tolerance, Some([-0.1, 0.1]));
        let mut other = one.clone();
        other.places[2][0] += 1e-12;
        assert_eq!(super::map(&[&one, &one, &other], None).err(), Some(2));
        let mut other = one.clone();
        other.deviations.pop();
        assert_eq!(super::map(&[&other], None).err(), Some(0));
        assert!(super::map(&[], None).unwrap().is_none());
    }
}
