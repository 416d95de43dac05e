//! Uncertainties under noise that neighbors share.

use super::*;
use crate::curvature;
use trueness_geom::noise;

/// The uncertainty is the scatter that noise causes, averaged so many times over a place and those beside it. How far neighbors share it is
/// found on a larger sheet.
#[test]
fn shared_noise_scatters_as_the_uncertainty_says() {
    const SIDE: usize = 17;
    const SHEET: usize = 121;
    const STEP: f64 = 0.03 * R;
    let random = &mut Random::new(12);
    let mesh = patch(sphere, [0.4, 0.3], 0.03, &mut Random::new(1));
    for (rounds, reach) in [(0, 30), (1, 30), (2, 30), (3, 30), (2, 60)] {
        let reach = Reach::Count(reach);
        let (mut sum, mut square, mut told, mut white, runs) = (0.0, 0.0, 0.0, 0.0, 300);
        let errors = |side: usize, random: &mut Random| {
            let all = (0..side * side).map(|_| normal(random)).collect();
            (0..rounds).fold(all, |all: Vec<f64>, _| averaged(&all, side))
        };
        let of_sheet = errors(SHEET, random);
        let place = |i: usize| [STEP * (i % SHEET) as f64, STEP * (i / SHEET) as f64, 0.002 * of_sheet[i]];
        let positions = (0..SHEET * SHEET).map(place).collect();
        let sheet = Mesh { positions, faces: grid(SHEET as u32 - 1, SHEET as u32, false) };
        let found = noise::mesh(&sheet, 0, &Silent).ok();
        for _ in 0..runs {
            let errors = errors(SIDE, random);
            let mut noisy = mesh.clone();
            for (p, error) in noisy.positions.iter_mut().zip(&errors) {
                *p = times(1.0 + 0.002 * error / R, *p);
            }
            let jet = |noise| {
                let options = Options { degree: 3, reach, noise, ..Options::default() };
                curvature::mesh(&noisy, &options, &Silent).unwrap().places[MIDDLE].unwrap()
            };
            let jet_found = jet(found);
            let error = jet_found.bend.mean + 1.0 / R;
            sum += error;
            square += error.powi(2);
            told += jet_found.uncertainty.powi(2);
            white += jet(None).uncertainty.powi(2);
        }
        // Form that the jet does not follow is no noise.
        let ratio = |told: f64| (told / (square - sum.powi(2) / f64::from(runs))).sqrt();
        println!("{rounds} {reach:?}: {:.2}, independent {:.2}", ratio(told), ratio(white));
        assert!((ratio(told) - 1.0).abs() < 0.15, "{rounds} {reach:?}: {}", ratio(told));
    }
}

/// Means over each place of a grid and those beside it.
fn averaged(of: &[f64], side: usize) -> Vec<f64> {
    let mean = |i: usize| {
        let (row, column) = (i / side, i % side);
        let near = |k: usize| k.saturating_sub(1)..(k + 2).min(side);
        let all = near(row).flat_map(|r| near(column).map(move |c| of[r * side + c]));
        let (count, sum) = all.fold((0.0, 0.0), |(n, sum), x| (n + 1.0, sum + x));
        sum / count
    };
    (0..of.len()).map(mean).collect()
}
