//! A row given the other way round is the same row.

use super::*;

/// Rows of every kind: open and closed, with corners, points that repeat, outliers and gaps, free curves, noise from none to much.
fn rows() -> Vec<Vec<[f64; 2]>> {
    let mut all = vec![bends(120, 0.01, 1), bends(150, 0.0, 0), stadium(400, 0.02, 2), stadium(220, 0.0, 0)];
    let mut odd = bends(160, 0.005, 5);
    odd.insert(40, odd[39]);
    odd.insert(40, odd[39]);
    odd[90][0] += 0.8;
    odd.drain(120..130);
    all.push(odd);
    let mut meets = stadium(300, 0.01, 8);
    meets.extend([meets[0], meets[0]]);
    meets.insert(0, meets[0]);
    meets[150][1] += 1.5;
    all.push(meets);
    let random = &mut Random::new(11);
    let mut noisy = |p: [f64; 2], noise: f64| p.map(|x| x + noise * normal(random));
    let wave = |i: u32| {
        [
            0.1 * f64::from(i),
            libm::sin(0.03 * f64::from(i)) + if i < 60 { 0.0 } else { 0.02 * f64::from(i - 60) },
        ]
    };
    all.push((0..200).map(|i| noisy(wave(i), 0.01)).collect());
    all.push((0..90).map(|i| noisy([0.05 * f64::from(i % 45), f64::from(i / 45)], 0.05)).collect());
    let square = |i: u32| match i / 30 {
        0 => [f64::from(i), 0.0],
        1 => [30.0, f64::from(i - 30)],
        2 => [90.0 - f64::from(i), 30.0],
        _ => [0.0, 120.0 - f64::from(i)],
    };
    all.push((0..120).map(|i| noisy(square(i), 0.02)).collect());
    all.push((0..120).map(square).collect());
    all
}

#[test]
fn a_row_the_other_way_round_is_measured_as_the_same_row() {
    for (number, points) in rows().iter().enumerate() {
        let back: Vec<[f64; 2]> = points.iter().rev().copied().collect();
        let (one, two) = (found(points), found(&back));
        let n = points.len();
        assert_eq!((one.closed, one.noise, one.spacing), (two.closed, two.noise, two.spacing), "{number}");
        let (m, whole) = (one.segments.len(), one.segments.iter().map(|s| s.length).sum::<f64>());
        // Each closed contour begins with the segment of its own first point.
        let last = one.labels[n - 1] as usize;
        let of = |k: usize| if one.closed { (last + m - k) % m } else { m - 1 - k };
        for k in 0..m {
            // Turned round twice, angles and knots are rounded twice.
            let (a, b) = (&one.segments[of(k)], &two.segments[k]);
            assert!(a.clone().reversed() == *b || *a == b.clone().reversed(), "{number} {k} {a:?} {b:?}");
            if let Some(join) = two.joins.get(k) {
                let before = &one.joins[(of(k) + m - 1) % m];
                assert_eq!(
                    (join.point, join.uncertainty),
                    (before.point, before.uncertainty),
                    "{number} {k}"
                );
                assert_eq!(join.interval, [before.interval[1], before.interval[0]], "{number} {k}");
                assert_eq!((join.turn, join.continuity), (0.0 - before.turn, before.continuity));
            }
        }
        let mut unreliable: Vec<usize> = (0..m).filter(|k| one.unreliable.contains(&of(*k))).collect();
        unreliable.sort_unstable();
        assert_eq!(unreliable, two.unreliable, "{number}");
        for i in 0..n {
            assert_eq!(one.labels[i] as usize, of(two.labels[n - 1 - i] as usize), "{number} {i}");
            assert_eq!(one.residuals[i], 0.0 - two.residuals[n - 1 - i], "{number} {i}");
        }
        for (contour, points) in [(&one, points), (&two, &back)] {
            lists_are_those_of_the_row(contour, points, number);
            feet_are_where_stations_tell(contour, points, whole, number);
        }
    }
}

/// Repeated points repeat the one before, or the first; gaps are after the point told, outliers passed over; these are far off.
fn lists_are_those_of_the_row(contour: &Contour, points: &[[f64; 2]], number: usize) {
    let at_start = |i: usize| contour.closed && points[i..].iter().all(|p| *p == points[0]);
    let repeats = |i: &usize| *i > 0 && (points[*i] == points[*i - 1] || at_start(*i));
    let wanted: Vec<usize> = (0..points.len()).filter(repeats).collect();
    assert_eq!(contour.repeated, wanted, "{number}");
    let mut steps: Vec<f64> = points.windows(2).map(|w| far(w[0], w[1])).filter(|d| *d > 0.0).collect();
    steps.sort_by(f64::total_cmp);
    // Neither scatter across nor an outlier leaves a gap.
    let counts = |i: &usize| !contour.outliers.contains(i) && !contour.repeated.contains(i);
    let counted: Vec<usize> = (0..points.len()).filter(counts).collect();
    let wide = |w: &&[usize]| far(points[w[0]], points[w[1]]) > 5.0 * steps[steps.len() / 2];
    let gaps: Vec<usize> = counted.windows(2).filter(wide).map(|w| w[0]).collect();
    assert_eq!(contour.gaps, gaps, "{number}");
    let wanted: &[f64] = match number {
        4 => &[1.0],
        5 => &[1.0],
        _ => &[],
    };
    assert_eq!(contour.outliers.len(), wanted.len(), "{number} {:?}", contour.outliers);
    for i in &contour.outliers {
        let (label, p) = (contour.labels[*i] as usize, points[*i]);
        assert!(contour.segments[label].nearest(p).distance.abs() > 0.5, "{number} {i}");
    }
}

/// The distance and the length along the contour of each point are those of its foot.
fn feet_are_where_stations_tell(contour: &Contour, points: &[[f64; 2]], whole: f64, number: usize) {
    for (i, p) in points.iter().enumerate() {
        if contour.outliers.contains(&i) || contour.unreliable.contains(&(contour.labels[i] as usize)) {
            continue;
        }
        let label = contour.labels[i] as usize;
        let share = contour.segments[label].nearest(*p).share;
        // Points beside a join may have their foot beyond it.
        if share <= 0.0 || share >= 1.0 {
            continue;
        }
        let before: f64 = contour.segments[..label].iter().map(|s| s.length).sum();
        let (along, off) = contour.segments[label].foot(*p);
        let near = 0.05 * contour.spacing + 2.0 * contour.noise;
        let gap = (before + along - contour.stations[i]).abs();
        let gap = if contour.closed { gap.min(whole - gap) } else { gap };
        assert!(gap < near.max(0.2 * contour.spacing), "{number} {i} {gap} {near}");
        assert!((off - contour.residuals[i]).abs() < near, "{number} {i} {off} {}", contour.residuals[i]);
    }
}
