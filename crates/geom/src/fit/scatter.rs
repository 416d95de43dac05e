//! Mean and principal directions of points.

use super::sample::mean;
use crate::num::dense;
use crate::space::{Point, Vector, cross, minus, plus, times};

/// Mean of points and the eigenvectors of their scatter.
#[derive(Clone, Copy, Debug)]
pub struct Scatter {
    /// Mean of the points.
    pub mean: Point,
    /// Variances, ascending.
    pub variance: [f64; 3],
    /// Unit directions in the order of the variances, a right-handed frame.
    pub axes: [Vector; 3],
}

impl Scatter {
    /// The scatter of points in space.
    pub fn of(points: &[Point]) -> Scatter {
        let mean = mean(points);
        let mut matrix = [[0.0; 3]; 3];
        for &p in points {
            let q = minus(p, mean);
            for i in 0..3 {
                matrix[i] = plus(matrix[i], times(q[i] / points.len() as f64, q));
            }
        }
        let (variance, axes) = dense::eigen(matrix);
        Scatter { mean, variance, axes: [axes[0], axes[1], cross(axes[0], axes[1])] }
    }
    /// The scatter of points of the plane z = 0: the first direction is that of z.
    pub(super) fn flat(points: &[Point]) -> Scatter {
        let points: Vec<Point> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
        let all = Scatter::of(&points);
        // On a straight line both other variances are zero, and either may come first.
        let mut within = all.axes.iter().filter(|a| a[2].abs() < 0.5).map(|a| [a[0], a[1], 0.0]);
        let u = within.next().unwrap_or([1.0, 0.0, 0.0]);
        let v = within.next().unwrap_or([-u[1], u[0], 0.0]);
        Scatter { axes: [[0.0, 0.0, 1.0], u, v], ..all }
    }
}
