//! Points in nearly the right order put right where a short stretch run through the other way is shorter.
//!
//! Around a corner the way through cells cuts across it, and points of both sides come mixed. (Croes, A method for solving
//! traveling-salesman problems, Operations Research 6, 1958; within a few points.)

use crate::model::flat::distance;

/// Stretches of up to so many points are turned round.
const MAX_TURNED_POINTS: usize = 8;
/// So many times over; on a closed contour every second time with the ends in the middle.
const UNTANGLING_PASSES: usize = 4;
/// Where the way from point to point is so many times as long as the contour, points scatter farther across it than they lie apart.
/// The shortest way is not along it there.
const MAX_WAY_RATIO: f64 = 1.3;

/// Puts the numbers of points that follow each other along a contour of about the length `way` into the order of the shorter way.
pub(super) fn untangle(points: &[[f64; 2]], numbers: &mut [usize], closed: bool, way: f64) {
    let n = numbers.len();
    let at = |i: usize| points[i];
    let whole: f64 = numbers.windows(2).map(|w| distance(at(w[0]), at(w[1]))).sum();
    if n < MAX_TURNED_POINTS || whole > MAX_WAY_RATIO * way {
        return;
    }
    for pass in 0..UNTANGLING_PASSES {
        let mut changed = false;
        for i in 1..n - 1 {
            for j in i + 1..(i + MAX_TURNED_POINTS).min(n - 1) {
                let [a, b, c, d] = [i - 1, i, j, j + 1].map(|k| at(numbers[k]));
                let (now, turned) = (distance(a, b) + distance(c, d), distance(a, c) + distance(b, d));
                if turned < now * (1.0 - 1e-9) {
                    numbers[i..=j].reverse();
                    changed = true;
                }
            }
        }
        if closed && pass % 2 == 0 {
            numbers.rotate_left(n / 2);
        } else if closed {
            numbers.rotate_right(n / 2);
        } else if !changed {
            return;
        }
    }
}
