//! Deviations of one part at places that all parts share, and their mean and spread over many parts.

use super::{Histogram, Statistics};
use crate::scale::Scale;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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

impl TrendMap {
    /// Values to draw: NaN where not every part has one.
    pub fn drawn(&self, values: &[Option<f64>]) -> Vec<f64> {
        let most = self.parts.iter().copied().max().filter(|_| self.complete > 0);
        let whole = |n: usize| Some(self.parts[n]) == most;
        values.iter().enumerate().map(|(n, v)| v.filter(|_| whole(n)).unwrap_or(f64::NAN)).collect()
    }
}
