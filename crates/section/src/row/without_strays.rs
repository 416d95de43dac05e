//! Contours of rows with stray points: the row is searched without them, and they are put back as outliers.

use super::sheet::{nearest, starts};
use super::stray::Strays;
use crate::model::result::{Contour, Options};

/// A row, and the part of it that is searched.
pub(super) struct WithoutStrays {
    /// The points that are no strays, by their numbers.
    kept: Vec<usize>,
    strays: Strays,
}

impl WithoutStrays {
    /// Points known to be in order have no strays.
    pub fn of(points: &[[f64; 2]], options: &Options) -> WithoutStrays {
        let strays = if options.ordered { Strays::default() } else { Strays::of(points) };
        let kept = (0..points.len()).filter(|i| strays.out.binary_search(i).is_err()).collect();
        WithoutStrays { kept, strays }
    }

    /// The points that are searched.
    pub fn row(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        self.kept.iter().map(|i| points[*i]).collect()
    }

    /// Their numbers.
    pub fn numbers(&self) -> impl Iterator<Item = usize> {
        self.kept.iter().copied()
    }

    /// The contour found of them as that of the whole row.
    pub fn whole(self, found: Contour, points: &[[f64; 2]]) -> Contour {
        let WithoutStrays { kept, strays } = self;
        let mut all = Contour { doubtful: strays.doubtful, straight_on: strays.straight_on, ..found };
        if strays.out.is_empty() {
            return all;
        }
        let named = |list: Vec<usize>| list.into_iter().map(|i| kept[i]).collect::<Vec<usize>>();
        (all.repeated, all.gaps) = (named(all.repeated), named(all.gaps));
        all.outliers = named(all.outliers);
        all.outliers.extend(&strays.out);
        all.outliers.sort_unstable();
        let own = (all.labels, all.residuals, all.stations);
        all.labels = vec![0; points.len()];
        all.residuals = vec![0.0; points.len()];
        all.stations = vec![0.0; points.len()];
        for (k, &i) in kept.iter().enumerate() {
            (all.labels[i], all.residuals[i], all.stations[i]) = (own.0[k], own.1[k], own.2[k]);
        }
        let starts = starts(&all.segments);
        // A stray is as far off as it lies from the segments around its place in the row.
        for &i in &strays.out {
            let next = kept.partition_point(|k| *k < i);
            let around = [next.saturating_sub(1), next.min(kept.len() - 1)].map(|k| own.0[k]);
            (all.labels[i], all.stations[i], all.residuals[i]) =
                nearest(&all.segments, &starts, around.into_iter(), points[i]);
        }
        all
    }
}
