//! Closed lines of straight pieces and arcs in the plane, with the material on their left.

use std::f64::consts::{PI, TAU};

/// A piece of a profile.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    Line {
        from: [f64; 2],
        to: [f64; 2],
    },
    /// From one angle to another, downwards where the arc runs clockwise.
    Arc {
        center: [f64; 2],
        radius: f64,
        angles: [f64; 2],
    },
}

impl Piece {
    pub fn at(&self, share: f64) -> [f64; 2] {
        match self {
            Piece::Line { from, to } => [0, 1].map(|k| from[k] + share * (to[k] - from[k])),
            Piece::Arc { center, radius, angles: [a, b] } => {
                let t = a + share * (b - a);
                [center[0] + radius * t.cos(), center[1] + radius * t.sin()]
            }
        }
    }

    /// Distance of a place, and how often a ray from it to the right is crossed upward.
    fn seen(&self, p: [f64; 2]) -> (f64, i32) {
        match *self {
            Piece::Line { from, to } => {
                let way = [to[0] - from[0], to[1] - from[1]];
                let off = [p[0] - from[0], p[1] - from[1]];
                let share = ((off[0] * way[0] + off[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]))
                    .clamp(0.0, 1.0);
                let q = self.at(share);
                let left = way[0] * off[1] - way[1] * off[0] > 0.0;
                let turn = match (from[1] <= p[1], to[1] <= p[1]) {
                    (true, false) if left => 1,
                    (false, true) if !left => -1,
                    _ => 0,
                };
                ((p[0] - q[0]).hypot(p[1] - q[1]), turn)
            }
            Piece::Arc { center, radius, angles } => {
                // Monotone parts between the highest and the lowest places.
                let [low, high] = [angles[0].min(angles[1]), angles[0].max(angles[1])];
                let first = (low / PI - 0.5).ceil();
                let mut cuts = vec![low];
                cuts.extend(
                    (0..10).map(|i| PI * (first + f64::from(i) + 0.5)).filter(|t| *t > low && *t < high),
                );
                cuts.push(high);
                let off = [p[0] - center[0], p[1] - center[1]];
                let own = off[1].atan2(off[0]);
                let lifted = own + TAU * ((low - own) / TAU).ceil();
                let end = |t: f64| (off[0] - radius * t.cos()).hypot(off[1] - radius * t.sin());
                let mut distance = end(low).min(end(high));
                if lifted <= high {
                    distance = distance.min((off[0].hypot(off[1]) - radius).abs());
                }
                let mut turn = 0;
                for w in cuts.windows(2) {
                    let [y0, y1] =
                        [0, 1].map(|i| if i == 0 { radius * w[0].sin() } else { radius * w[1].sin() });
                    let crossed = match (y0 <= off[1], y1 <= off[1]) {
                        (true, false) => 1,
                        (false, true) => -1,
                        _ => continue,
                    };
                    let side = if (0.5 * (w[0] + w[1])).cos() > 0.0 { 1.0 } else { -1.0 };
                    if side * (radius * radius - off[1] * off[1]).max(0.0).sqrt() > off[0] {
                        turn += if angles[0] < angles[1] { crossed } else { -crossed };
                    }
                }
                (distance, turn)
            }
        }
    }
}

/// How far a place is from the border, and whether it is inside.
pub fn seen(chains: &[Vec<Piece>], p: [f64; 2]) -> (f64, bool) {
    let each = chains.iter().flatten().map(|piece| piece.seen(p));
    let (distance, turns) = each.fold((f64::INFINITY, 0), |(d, n), (e, m)| (d.min(e), n + m));
    (distance, turns > 0)
}

/// Straight pieces from corner to corner.
pub fn polygon(corners: &[[f64; 2]]) -> Vec<Piece> {
    let n = corners.len();
    (0..n).map(|i| Piece::Line { from: corners[i], to: corners[(i + 1) % n] }).collect()
}

pub fn arc(center: [f64; 2], radius: f64, angles: [f64; 2]) -> Piece {
    Piece::Arc { center, radius, angles }
}
