//! Noise that neighbors of a row share, as of profiles that were filtered.
//!
//! Local fits of a few points take shared noise for form. Windows of many points of a line or an arc show it: about these the residuals
//! change sides many times, and neighboring ones are alike. A form that lines and arcs do not follow changes sides a few times in a window,
//! or by turns.

use crate::model::chain::SegmentKind;
use crate::model::flat::distance;
use crate::model::prior::KnownNoise;
use crate::search::parts::{Part, Sums};

/// Points of the narrowest window, and of the widest one at most.
const WINDOW_POINTS: [usize; 2] = [24, 768];
/// A row has at least so many windows of points.
const MIN_WINDOWS_PER_ROW: usize = 4;
/// At least a quarter of all windows lies on one line or arc as a rule.
const CLEAN_WINDOWS_DIVISOR: usize = 4;
/// Clean are also windows whose squares are no more than so many times as large: the rest holds joins.
const CLEAN_SQUARES_RATIO: f64 = 4.0;
/// Points that tell as much as an independent one: fewer are taken for one.
const MIN_POINTS_PER_INDEPENDENT: f64 = 1.6;
/// No window holds fewer groups of such points.
const MIN_GROUPS_PER_WINDOW: f64 = 8.0;
/// A form changes sides of a line or arc through a window fewer times. A cubic does so three times, a curve of the
/// fourth degree four times.
const MIN_SIDE_CHANGES: f64 = 7.0;
/// Two neighbors of filtered points have the same noise, nearly. Independent ones about a form that lines and arcs do not follow
/// have a part of it in common.
const MIN_CORRELATION_OF_HALVES: f64 = 0.6;
/// Noise that is alike by turns is a form.
const MIN_CORRELATION_AT_ANY_LAG: f64 = -0.4;
/// Noise of more than this share of the distance between points may be form everywhere alike.
const MAX_SHARED_NOISE_SPACINGS: f64 = 0.1;

/// Noise that neighbors share, and how many points tell as much as an independent one. `None` where neighbors share none, or form is not
/// told from it. Cost: the number of points times the width of the windows.
pub(super) fn shared_noise(points: &[[f64; 2]]) -> Option<(KnownNoise, f64)> {
    let way: f64 = points.windows(2).map(|w| distance(w[0], w[1])).sum();
    let spacing = way / points.len() as f64;
    let sums = Sums::new(points, &vec![1.0; points.len()]);
    let [mut width, widest] = WINDOW_POINTS;
    while width <= widest && MIN_WINDOWS_PER_ROW * width <= points.len() {
        let found = within(points, &sums, width)?;
        if found.alike * MIN_GROUPS_PER_WINDOW <= width as f64 {
            let is_noise = found.changes >= MIN_SIDE_CHANGES
                && found.same >= MIN_CORRELATION_OF_HALVES
                && found.least > MIN_CORRELATION_AT_ANY_LAG
                && found.deviation <= MAX_SHARED_NOISE_SPACINGS * spacing;
            return (is_noise && found.alike >= MIN_POINTS_PER_INDEPENDENT).then(|| {
                let degrees = found.windows * (width as f64 / found.alike - 3.0).max(1.0);
                (KnownNoise { deviation: found.deviation, degrees }, found.alike)
            });
        }
        width *= 2;
    }
    None
}

/// Statistics of the clean windows of one width.
struct WindowStatistics {
    deviation: f64,
    alike: f64,
    /// How often residuals change sides in a window.
    changes: f64,
    /// The correlation of neighbors where they move together.
    same: f64,
    /// The least correlation.
    least: f64,
    /// Windows that do not overlap.
    windows: f64,
}

fn within(points: &[[f64; 2]], sums: &Sums, width: usize) -> Option<WindowStatistics> {
    let stride = width / 4;
    let mut all: Vec<(f64, usize)> = (0..=points.len() - width)
        .step_by(stride)
        .map(|from| {
            let (line, arc) = sums.fit(from, from + width);
            (arc.map_or(line, |(arc, ..)| arc.min(line)), from)
        })
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let most = CLEAN_SQUARES_RATIO * all[all.len() / CLEAN_WINDOWS_DIVISOR].0;
    all.retain(|(sum, _)| *sum <= most);
    let lags = width / 2;
    let (mut together, mut changes) = (vec![0.0; lags], 0.0);
    for (_, from) in &all {
        let off = residuals(points, sums, *from, *from + width);
        for (lag, sum) in together.iter_mut().enumerate() {
            *sum += off.iter().zip(&off[lag..]).map(|(a, b)| a * b).sum::<f64>();
        }
        changes += off.windows(2).filter(|w| (w[0] < 0.0) != (w[1] < 0.0)).count() as f64;
    }
    let count = all.len() as f64;
    let variance = together[0] / (count * (width as f64 - 3.0));
    if variance.is_nan() || variance <= 0.0 {
        return None;
    }
    let share = |c: &f64| c / together[0];
    // A fit takes a part of the errors that neighbors share with it.
    let alike = together.chunks_exact(2).map(|pair| share(&pair[0]) + share(&pair[1]));
    let alike = 2.0 * alike.take_while(|pair| *pair > 0.0).sum::<f64>() - 1.0;
    let kept = 1.0 - 3.0 * alike / width as f64;
    Some(WindowStatistics {
        deviation: (variance / kept.max(0.5)).sqrt(),
        alike: (alike / kept.max(0.5)).max(1.0),
        changes: changes / count,
        same: 2.0 * share(&together[1]) - share(&together[2]),
        least: together.iter().map(share).fold(f64::INFINITY, f64::min),
        windows: count * stride as f64 / width as f64,
    })
}

/// Distances of the points of a window from the line or arc through it.
fn residuals(points: &[[f64; 2]], sums: &Sums, from: usize, to: usize) -> Vec<f64> {
    let (line, arc) = sums.fit(from, to);
    match arc.filter(|(arc, ..)| *arc < line) {
        Some((_, center, radius)) => points[from..to]
            .iter()
            .map(|p| libm::hypot(p[0] - center[0], p[1] - center[1]) - radius)
            .collect(),
        None => {
            let Part { along, center, .. } = sums.part(points, SegmentKind::Line, from, to);
            points[from..to]
                .iter()
                .map(|p| along[0] * (p[1] - center[1]) - along[1] * (p[0] - center[0]))
                .collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::shared_noise;
    use crate::{Options, SegmentKind, contour};
    use trueness_geom::num::random::Random;

    fn normal(random: &mut Random) -> f64 {
        (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
    }

    /// Points around a rectangle with rounded corners, with noise of this deviation that is the mean of `over` neighbors.
    fn rounded(count: usize, over: usize, deviation: f64, random: &mut Random) -> Vec<[f64; 2]> {
        let [width, height, radius] = [30.0 + 30.0 * random.unit(), 20.0 + 20.0 * random.unit(), 5.0];
        let quarter = 0.5 * std::f64::consts::PI * radius;
        let sides = [width, height, width, height];
        let whole = 2.0 * (width + height) + 4.0 * quarter;
        let white: Vec<f64> = (0..count).map(|_| normal(random)).collect();
        (0..count)
            .map(|i| {
                let sum: f64 = (0..over).map(|k| white[(i + k) % count]).sum();
                let off = deviation * sum / (over as f64).sqrt();
                let (mut left, mut place, mut heading) = (whole * i as f64 / count as f64, [0.0, 0.0], 0.0);
                for side in sides {
                    let (s, c) = libm::sincos(heading);
                    let along = left.min(side);
                    place = [place[0] + along * c, place[1] + along * s];
                    left -= along;
                    if left <= 0.0 {
                        return [place[0] + off * s, place[1] - off * c];
                    }
                    let center = [place[0] - radius * s, place[1] + radius * c];
                    heading += left.min(quarter) / radius;
                    let (s, c) = libm::sincos(heading);
                    place = [center[0] + radius * s, center[1] - radius * c];
                    left -= quarter;
                    if left <= 0.0 {
                        return [place[0] + off * s, place[1] - off * c];
                    }
                }
                place
            })
            .collect()
    }

    /// Filtered noise is told with its deviation and how many points are alike; independent noise, and none, are not.
    #[test]
    fn shared_noise_is_told_from_independent_noise() {
        let random = &mut Random::new(4);
        let (mut found, mut right) = (0, 0);
        for _ in 0..40 {
            let count = 300 + random.below(500) as usize;
            assert_eq!(shared_noise(&rounded(count, 1, 0.005, random)), None);
            let points = rounded(count, 3, 0.005, random);
            if let Some((noise, alike)) = shared_noise(&points) {
                found += 1;
                assert!((noise.deviation / 0.005 - 1.0).abs() < 0.35, "{noise:?}");
                assert!((1.6..6.0).contains(&alike), "{alike}");
            }
            let contour = contour(&points, &Options::default(), &trueness_geom::progress::Silent).unwrap();
            let lines = contour.segments.iter().filter(|s| s.geometry.kind() == SegmentKind::Line).count();
            right += usize::from(contour.segments.len() == 8 && lines == 4);
        }
        println!("{found} of 40 told, {right} right");
        assert!(found >= 32 && right >= 34, "{found} {right}");
    }

    /// Curves that lines and arcs do not follow are no noise, with some or without.
    #[test]
    fn form_is_no_noise() {
        let random = &mut Random::new(5);
        for round in 0..200 {
            let count = 100 + random.below(900) as usize;
            let [bends, high] = [2.0 + 10.0 * random.unit(), 0.2 + 3.0 * random.unit()];
            let noise = [0.0, 0.001, 0.01][round % 3];
            let points: Vec<[f64; 2]> = (0..count)
                .map(|i| {
                    let x = 100.0 * i as f64 / count as f64;
                    let y = high * libm::sin(bends * x * 0.0628 + libm::sin(x * 0.09));
                    [x, y + noise * normal(random)]
                })
                .collect();
            assert_eq!(
                shared_noise(&points),
                None,
                "round {round}, {count}, {bends} bends of {high}, noise {noise}"
            );
        }
    }
}
