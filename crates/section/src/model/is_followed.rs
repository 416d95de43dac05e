//! Whether a chain runs along its points.

use super::chain::{SegmentKind, arc_end};
use super::least::{Row, State, Work};

/// Between the feet of neighboring points a chain is at most this many times as long as they are apart. An arc that
/// turns by a half circle there is π/2 times as long.
const MAX_DETOUR_RATIO: f64 = 2.0;

impl Work {
    /// Whether the chain runs from each point to the next without a loop between them.
    ///
    /// Distances of points see nothing of a loop between two of them. Both ends are places of the chain, so noise does not
    /// make them farther apart than the chain is long. Feet nearer than half the `spacing` along the chain are not looked at.
    pub(crate) fn is_followed(&mut self, row: &Row, state: &mut State, spacing: f64) -> bool {
        let stations = self.stations(row, state);
        let count = row.points.len();
        let starts = state.chain.stations();
        let mut last: Option<(f64, [f64; 2])> = None;
        for (g, piece) in state.chain.pieces.iter().enumerate() {
            let pose = &self.layout.poses[g];
            for i in (state.breaks[g]..state.breaks[g + 1]).map(|i| i % count) {
                if row.weights[i] == 0.0 {
                    continue;
                }
                let own = stations[i] - starts[g];
                let foot = pose.place(match piece.kind {
                    SegmentKind::Spline => self.layout.tables[g].place(state.feet[i]).at,
                    _ => arc_end(own, own * piece.curvature(0.0)),
                });
                if let Some((before, at)) = last {
                    let along = stations[i] - before;
                    let apart = libm::hypot(foot[0] - at[0], foot[1] - at[1]);
                    if along > 0.5 * spacing && along > MAX_DETOUR_RATIO * apart {
                        return false;
                    }
                }
                last = Some((stations[i], foot));
            }
        }
        true
    }
}
