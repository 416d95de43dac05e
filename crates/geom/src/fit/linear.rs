//! The linear program of a minimax step: lower the greatest of linear functions within a box.
//!
//! Minimize t over (x, t) with slopeᵢ·x + levelᵢ ≤ t for all i and |x_k| ≤ reach. Solved by exchange, which is the dual simplex
//! method. As many constraints as unknowns are held with equality. The one violated most comes in, the one whose multiplier
//! would turn negative first goes out. The box gives a first set that needs no search. E. Ya. Remez, 1934; E. W. Cheney,
//! Introduction to Approximation Theory (1966), chapter 2.

/// Points up to which all are in the working set of an exchange from the first.
pub(crate) const MAX_POINTS_ALL_WORKING: usize = 2000;
/// Most points that join the working set in one round, on each side.
pub(crate) const MAX_JOINING_POINTS: usize = 24;
/// A step, or a fall of the greatest distance, that rounding of the distances hides at unit size.
pub(crate) const HIDDEN_FALL: f64 = 2e-16;

/// Most unknowns, t among them.
const MAX_PROGRAM_UNKNOWNS: usize = 8;

/// One function: its value at x = 0 and its slope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Function<const P: usize> {
    pub level: f64,
    pub slope: [f64; P],
}

/// The lowest point of the program.
#[derive(Clone, Debug)]
pub(crate) struct Lowest<const P: usize> {
    pub x: [f64; P],
    /// The greatest function there.
    pub value: f64,
    /// Functions that hold it there, with their multipliers: positive, and summing to 1.
    pub holding: Vec<(usize, f64)>,
    /// Sum of the multipliers of the sides of the box.
    pub boxed: f64,
}

/// A constraint held with equality.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Held {
    Function(usize),
    /// x_k ≥ −reach, or −x_k ≥ −reach.
    Side(usize, bool),
}

type Square = [[f64; MAX_PROGRAM_UNKNOWNS]; MAX_PROGRAM_UNKNOWNS];

/// Solves the program for at least one function; `None` if the numbers are not finite.
pub(crate) fn lowest<const P: usize>(functions: &[Function<P>], reach: f64) -> Option<Lowest<P>> {
    let n = P + 1;
    let first = (0..functions.len()).max_by(|&i, &j| functions[i].level.total_cmp(&functions[j].level))?;
    let mut held = [Held::Function(first); MAX_PROGRAM_UNKNOWNS];
    for k in 0..P {
        held[k] = Held::Side(k, functions[first].slope[k] < 0.0);
    }
    // Constraint as normal·(x, t) ≥ level.
    let normal = |c: Held| -> ([f64; MAX_PROGRAM_UNKNOWNS], f64) {
        let mut a = [0.0; MAX_PROGRAM_UNKNOWNS];
        match c {
            Held::Function(i) => {
                for k in 0..P {
                    a[k] = -functions[i].slope[k];
                }
                a[P] = 1.0;
                (a, functions[i].level)
            }
            Held::Side(k, upper) => {
                a[k] = if upper { -1.0 } else { 1.0 };
                (a, -reach)
            }
        }
    };
    let mut y = [0.0; MAX_PROGRAM_UNKNOWNS];
    let mut inverse = [[0.0; MAX_PROGRAM_UNKNOWNS]; MAX_PROGRAM_UNKNOWNS];
    for round in 0..400 {
        let mut matrix = [[0.0; MAX_PROGRAM_UNKNOWNS]; MAX_PROGRAM_UNKNOWNS];
        let mut level = [0.0; MAX_PROGRAM_UNKNOWNS];
        for (b, &c) in held[..n].iter().enumerate() {
            (matrix[b], level[b]) = normal(c);
        }
        inverse = inverted(matrix, n)?;
        y = [0.0; MAX_PROGRAM_UNKNOWNS];
        for i in 0..n {
            y[i] = (0..n).map(|b| inverse[i][b] * level[b]).sum();
        }
        // Choosing the worst is fast; choosing the first ends every circle.
        let Some(enters) = violated(functions, &y, reach, round > 150) else { break };
        let (a, _) = normal(enters);
        let alpha: [f64; MAX_PROGRAM_UNKNOWNS] =
            std::array::from_fn(|b| if b < n { (0..n).map(|k| a[k] * inverse[k][b]).sum() } else { 0.0 });
        let greatest = alpha[..n].iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let leaves = (0..n)
            .filter(|&b| alpha[b] > 1e-11 * greatest)
            .map(|b| (inverse[P][b].max(0.0) / alpha[b], b))
            .min_by(|x, y| x.0.total_cmp(&y.0).then(alpha[y.1].total_cmp(&alpha[x.1])))?;
        held[leaves.1] = enters;
    }
    let mut answer =
        Lowest { x: std::array::from_fn(|k| y[k]), value: y[P], holding: Vec::with_capacity(n), boxed: 0.0 };
    for (b, &c) in held[..n].iter().enumerate() {
        let multiplier = inverse[P][b].max(0.0);
        match c {
            Held::Function(i) if multiplier > 0.0 => answer.holding.push((i, multiplier)),
            Held::Side(..) => answer.boxed += multiplier,
            Held::Function(_) => {}
        }
    }
    Some(answer)
}

/// A constraint that `y` violates by more than rounding: the worst, or the first.
fn violated<const P: usize>(
    functions: &[Function<P>],
    y: &[f64; MAX_PROGRAM_UNKNOWNS],
    reach: f64,
    any: bool,
) -> Option<Held> {
    let mut worst = None;
    let mut most = 0.0;
    for k in 0..P {
        let beyond = y[k].abs() - reach;
        if beyond > 1e-12 * reach && beyond > most && !(any && worst.is_some()) {
            (worst, most) = (Some(Held::Side(k, y[k] > 0.0)), beyond);
        }
    }
    for (i, f) in functions.iter().enumerate() {
        let beyond = (0..P).fold(f.level, |value, k| value + f.slope[k] * y[k]) - y[P];
        if beyond > most && !(any && worst.is_some()) {
            let size = (0..P).fold(f.level.abs() + y[P].abs(), |size, k| size + (f.slope[k] * y[k]).abs());
            if beyond > 8.0 * f64::EPSILON * size {
                (worst, most) = (Some(Held::Function(i)), beyond);
            }
        }
    }
    worst
}

/// Inverse of the leading `n` rows and columns, by elimination with row exchange.
fn inverted(mut a: Square, n: usize) -> Option<Square> {
    let mut inverse = [[0.0; MAX_PROGRAM_UNKNOWNS]; MAX_PROGRAM_UNKNOWNS];
    for k in 0..n {
        inverse[k][k] = 1.0;
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        a.swap(k, pivot);
        inverse.swap(k, pivot);
        let one = 1.0 / a[k][k];
        if !one.is_finite() {
            return None;
        }
        for c in 0..MAX_PROGRAM_UNKNOWNS {
            a[k][c] *= one;
            inverse[k][c] *= one;
        }
        let (row, inverse_row) = (a[k], inverse[k]);
        for i in 0..n {
            let factor = a[i][k];
            if i != k && factor != 0.0 {
                for c in 0..MAX_PROGRAM_UNKNOWNS {
                    a[i][c] -= factor * row[c];
                    inverse[i][c] -= factor * inverse_row[c];
                }
            }
        }
    }
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn a_straight_line_through_three_points_is_tchebycheffs() {
        // |y − a − b·t| over (0, 0), (1, 1), (2, 0): a = 1/2, b = 0, greatest deviation 1/2.
        let mut functions = Vec::new();
        for (t, y) in [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)] {
            for side in [1.0, -1.0] {
                functions.push(Function { level: side * y, slope: [-side, -side * t] });
            }
        }
        let lowest = lowest(&functions, 10.0).unwrap();
        assert!((lowest.value - 0.5).abs() < 1e-15);
        assert!((lowest.x[0] - 0.5).abs() < 1e-15 && lowest.x[1].abs() < 1e-15);
        assert_eq!(lowest.holding.len(), 3);
        assert!(lowest.boxed < 1e-15);
    }

    /// No point of a random search is lower, and the multipliers prove why.
    #[test]
    fn multipliers_certify_the_lowest_point() {
        let mut random = Random::new(5);
        let mut next = move || random.unit() - 0.5;
        for _ in 0..50 {
            let functions: Vec<Function<5>> =
                (0..60).map(|_| Function { level: next(), slope: std::array::from_fn(|_| next()) }).collect();
            let found = lowest(&functions, 0.3).unwrap();
            let value = |x: [f64; 5]| {
                let at = |f: &Function<5>| f.level + (0..5).map(|k| f.slope[k] * x[k]).sum::<f64>();
                functions.iter().map(at).fold(f64::NEG_INFINITY, f64::max)
            };
            assert!((value(found.x) - found.value).abs() < 1e-14);
            assert!((found.holding.iter().map(|h| h.1).sum::<f64>() - 1.0).abs() < 1e-13);
            for _ in 0..200 {
                assert!(value(std::array::from_fn(|_| 0.6 * next())) >= found.value - 1e-14);
            }
        }
    }
}
