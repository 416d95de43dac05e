//! Triangles laid into the plane one by one.

use trueness_geom::space::{Point, minus, norm};

/// Least height of a triangle over its longest side, as a share of that: a flatter one is taken as if it were that high.
const MIN_HEIGHT_RATIO: f64 = 1e-3;

/// Length of a longest side at least: the square of it is still a number.
const MIN_LONGEST_SIDE: f64 = 1e-100;

/// A triangle in a plane of its own, against the clock.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle(pub [[f64; 2]; 3]);

impl Triangle {
    /// With the sides that its corners in space have.
    pub(super) fn of(corners: [Point; 3]) -> Triangle {
        // Opposite of each corner.
        let side = |k: usize| norm(minus(corners[(k + 1) % 3], corners[(k + 2) % 3]));
        let sides = [side(0), side(1), side(2)];
        let top = (0..3).fold(0, |m, k| if sides[k] > sides[m] { k } else { m });
        let (base, left, right) =
            (sides[top].max(MIN_LONGEST_SIDE), sides[(top + 2) % 3], sides[(top + 1) % 3]);
        // The foot of the height, from the corner after the top.
        let along = (0.5 * (base + (left - right) * (left + right) / base)).clamp(0.0, base);
        let height = (left * left - along * along).max(0.0).sqrt().max(MIN_HEIGHT_RATIO * base);
        let mut own = [[0.0; 2]; 3];
        own[(top + 1) % 3] = [0.0, 0.0];
        own[(top + 2) % 3] = [base, 0.0];
        own[top] = [along, height];
        Triangle(own)
    }

    /// From one corner to another.
    pub(super) fn edge(&self, from: usize, to: usize) -> [f64; 2] {
        [0, 1].map(|d| self.0[to][d] - self.0[from][d])
    }

    /// Twice the area.
    pub(super) fn doubled_area(&self) -> f64 {
        cross(self.edge(0, 1), self.edge(0, 2))
    }

    /// Cotangent of the angle at a corner.
    pub(super) fn cotangent(&self, k: usize) -> f64 {
        dot(self.edge(k, (k + 1) % 3), self.edge(k, (k + 2) % 3)) / self.doubled_area()
    }

    /// Tangent of half the angle at a corner.
    pub(super) fn half_tangent(&self, k: usize) -> f64 {
        let (a, b) = (self.edge(k, (k + 1) % 3), self.edge(k, (k + 2) % 3));
        self.doubled_area() / (length(a) * length(b) + dot(a, b))
    }

    /// Least and greatest factor by which lengths grow as the triangle is laid on these corners. The least one is
    /// negative where it is turned over.
    pub(super) fn stretch(&self, onto: [[f64; 2]; 3]) -> [f64; 2] {
        let image = Triangle(onto);
        let (a, b) = (self.edge(0, 1), self.edge(0, 2));
        let (c, d) = (image.edge(0, 1), image.edge(0, 2));
        let doubled = self.doubled_area();
        // The matrix that takes a to c and b to d, column by column.
        let column = |k: usize| {
            [0, 1]
                .map(|r| if k == 0 { c[r] * b[1] - d[r] * a[1] } else { d[r] * a[0] - c[r] * b[0] } / doubled)
        };
        let (x, y) = (column(0), column(1));
        // As a turn with growth and a mirrored one: their sizes added and subtracted.
        let turn = 0.5 * libm::hypot(x[0] + y[1], x[1] - y[0]);
        let mirror = 0.5 * libm::hypot(x[0] - y[1], x[1] + y[0]);
        [turn - mirror, turn + mirror]
    }
}

pub(super) fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn length(a: [f64; 2]) -> f64 {
    libm::hypot(a[0], a[1])
}
