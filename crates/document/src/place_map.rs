//! Deviations of one part at places that all parts share, and their mean and spread over many parts.

use super::{Histogram, Statistics};
use crate::scale::Scale;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_geom::mesh::Mesh;
use trueness_geom::stats::statistics::Summary;

/// Mean deviations at places of the reference, which are the same for every part: its facets, parted at creases and cut by the reference's
/// own size alone.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PlaceMap {
    /// Where the places are, mm.
    pub places: Vec<[f64; 3]>,
    /// The surface between them: numbers of three places each, from 0, counter-clockwise seen from outside.
    pub facets: Vec<[u32; 3]>,
    /// Mean deviation of the points whose place on the reference is nearest to each place; where there are none, of the nearest place along
    /// the surface that has some; null where that is farther than `reach`.
    pub deviations: Vec<Option<f64>>,
    /// Number of points in each; 0 where it is another place's.
    pub points: Vec<u64>,
    /// How far a mean goes over to places without points, mm.
    pub reach: f64,
}

/// Mean and spread of the deviations over all parts, place by place.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct TrendMap {
    /// Where the places are, mm.
    pub places: Vec<[f64; 3]>,
    /// The surface between them, as in the results.
    pub facets: Vec<[u32; 3]>,
    /// Number of parts with a value at each place.
    pub parts: Vec<u64>,
    /// Mean of these; null where there is none.
    pub mean: Vec<Option<f64>>,
    /// Their standard deviation, divided by their number less 1; null where fewer than two parts have a value.
    pub std_dev: Vec<Option<f64>>,
    /// Places where every part has a value: what statistics and colors are of.
    pub complete: u64,
    /// Places where some parts have a value and some have none.
    pub partial: u64,
    /// Places where no part has a value.
    pub without: u64,
    /// Of the means, over the complete places, each counting once.
    pub means: MapQuantity,
    /// Of the standard deviations.
    pub std_devs: MapQuantity,
}

/// One of the two over the complete places.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct MapQuantity {
    /// Over the places.
    pub statistics: Statistics,
    /// Counts of the values.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub histogram: Option<Histogram>,
    /// Where the size is greatest, of the places with a facet whose corners all have a value in every part, as others are gray; absent where
    /// there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub greatest: Option<MapPlace>,
    /// Its colors.
    pub scale: Scale,
}

/// A place with its value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MapPlace {
    /// Its number, from 0.
    pub index: u64,
    /// Where it is, mm.
    pub position: [f64; 3],
    /// The value there.
    pub value: f64,
}

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

impl TrendMap {
    /// Of maps in the order of their parts; `tolerance` is that of the deviations, which the colors show. `None` of none.
    ///
    /// # Errors
    /// The number of a map whose places are not those of the first, or which has another number of values.
    pub fn of(maps: &[&PlaceMap], tolerance: Option<[f64; 2]>) -> Result<Option<TrendMap>, usize> {
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
        let means =
            MapQuantity::of(&complete(&mean), (first, &seen), |p95| Scale::for_deviations(p95, tolerance));
        let std_devs = MapQuantity::of(&complete(&std_dev), (first, &seen), |p95| Scale {
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
    pub fn mesh(&self) -> Mesh {
        Mesh { positions: self.places.clone(), faces: self.facets.clone() }
    }

    /// Values to draw: NaN where not every part has one.
    pub fn drawn(&self, values: &[Option<f64>]) -> Vec<f64> {
        let most = self.parts.iter().copied().max().filter(|_| self.complete > 0);
        let whole = |n: usize| Some(self.parts[n]) == most;
        values.iter().enumerate().map(|(n, v)| v.filter(|_| whole(n)).unwrap_or(f64::NAN)).collect()
    }
}

impl MapQuantity {
    /// Of values with the numbers of their places, which are `seen` where a facet is drawn in their colors.
    fn of(
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
            statistics: Statistics::of(&summary.all, summary.quantile_error),
            histogram: Histogram::counted(&summary.all, &numbers),
            greatest: greatest.map(|&(n, value)| MapPlace {
                index: n as u64,
                position: map.places[n],
                value,
            }),
            scale: scale(summary.p95_abs.unwrap_or(0.0)),
        }
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
        let found = TrendMap::of(&maps.iter().collect::<Vec<_>>(), None).unwrap().unwrap();
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
        let found = TrendMap::of(&[&one], Some([-0.1, 0.1])).unwrap().unwrap();
        assert_eq!((found.mean[1], found.std_dev[1], found.std_devs.greatest), (Some(-0.2), None, None));
        assert_eq!(found.means.greatest.map(|g| (g.index, g.value)), Some((1, -0.2)));
        assert_eq!(found.means.scale.tolerance, Some([-0.1, 0.1]));
        let mut other = one.clone();
        other.places[2][0] += 1e-12;
        assert_eq!(TrendMap::of(&[&one, &one, &other], None).err(), Some(2));
        let mut other = one.clone();
        other.deviations.pop();
        assert_eq!(TrendMap::of(&[&other], None).err(), Some(0));
        assert!(TrendMap::of(&[], None).unwrap().is_none());
    }
}
