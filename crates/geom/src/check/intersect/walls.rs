//! Planes along the rim of a facet, and its own plane. A facet of a hub that lies beyond one of them does not meet it.
//!
//! In a plane, two fans on both sides of a line see each other's facets long and thin, and boxes and directions exclude only half.
//! But all corners of most of them lie beyond a side of the facet.

use crate::num::rounding::PRODUCT_SUM_ROUNDING;
use crate::space::{Aabb, Point, Vector, cross, dot, minus, times, unit};

/// Planes with a facet on one side, as far as a place lies on the other side of them.
pub(super) struct Walls {
    walls: [Wall; 5],
}

/// The places `p` with `dot(across, p) <= highest` hold the facet.
#[derive(Clone, Copy)]
struct Wall {
    /// The normal, of length 1, or zero where it parts nothing.
    across: Vector,
    highest: f64,
}

impl Walls {
    /// The walls of a triangle that have `center` beyond them.
    pub fn of(corners: [Point; 3], center: Point) -> Walls {
        let [a, b, c] = corners;
        let sides = [minus(b, a), minus(c, b), minus(a, c)];
        let longest = sides.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
        let sides = sides.map(|side| times(1.0 / longest, side));
        let normal = unit(cross(sides[0], sides[1])).map_or([0.0; 3], |(normal, _)| normal);
        let outward = sides.map(|side| unit(cross(side, normal)).map_or([0.0; 3], |(out, _)| out));
        let [x, y, z] = outward;
        let wall = |across: Vector| {
            let highest = corners
                .iter()
                .map(|p| dot(across, *p) + product_rounding(&across, p))
                .fold(f64::NEG_INFINITY, f64::max);
            // True for what is no number.
            let parts = dot(across, center) - product_rounding(&across, &center) > highest;
            if parts { Wall { across, highest } } else { Wall { across: [0.0; 3], highest: 0.0 } }
        };
        Walls { walls: [normal, times(-1.0, normal), x, y, z].map(wall) }
    }

    /// Whether the triangle meets no triangle with the center as one corner and the other two in this box.
    pub fn separate(&self, others: &Aabb) -> bool {
        let nearest = |n: &Vector| -> Point {
            std::array::from_fn(|k| if n[k] < 0.0 { others.max[k] } else { others.min[k] })
        };
        self.walls.iter().any(|wall| {
            let p = nearest(&wall.across);
            dot(wall.across, p) - product_rounding(&wall.across, &p) > wall.highest
        })
    }
}

/// More than rounding may change the product of the two.
fn product_rounding(across: &Vector, p: &Point) -> f64 {
    PRODUCT_SUM_ROUNDING * (0..3).map(|k| (across[k] * p[k]).abs()).sum::<f64>()
}
