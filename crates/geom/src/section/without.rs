//! Contours of rows with stray points: the row is searched without them, and they are put back as outliers.

use super::result::{Contour, Options};
use super::stray::Strays;

/// A row, and what of it is searched.
pub(super) struct Searched {
    /// The points that are no strays, by their numbers.
    kept: Vec<usize>,
    strays: Strays,
}

impl Searched {
    /// Points known to be in order have no strays.
    pub fn of(points: &[[f64; 2]], options: &Options) -> Searched {
        let strays = if options.ordered { Strays::default() } else { Strays::of(points) };
        let kept = (0..points.len()).filter(|i| strays.out.binary_search(i).is_err()).collect();
        Searched { kept, strays }
    }

    /// The points that are searched.
    pub fn row(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        self.kept.iter().map(|i| points[*i]).collect()
    }

    /// The contour found of them as that of the whole row.
    pub fn whole(self, found: Contour, points: &[[f64; 2]]) -> Contour {
        let Searched { kept, strays } = self;
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
        let ends = all.segments.iter().scan(0.0, |sum, s| {
            *sum += s.length;
            Some(*sum - s.length)
        });
        let starts: Vec<f64> = ends.collect();
        for &i in &strays.out {
            let feet = all.segments.iter().map(|s| s.nearest(points[i])).enumerate();
            let nearest = feet.min_by(|a, b| a.1.distance.abs().total_cmp(&b.1.distance.abs()));
            let Some((k, foot)) = nearest else { continue };
            (all.labels[i], all.residuals[i]) = (k as u32, foot.distance);
            all.stations[i] = starts[k] + foot.share * all.segments[k].length;
        }
        all
    }
}
