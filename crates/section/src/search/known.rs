//! Chains of lines, and of arcs tangent to them, that are known.

use super::parts::Part;
use super::rounds::Search;
use crate::model::chain::{Chain, Ends, Piece, SegmentKind};
use crate::model::criterion::Model;
use crate::model::flat::{angle, distance, dot, minus};
use crate::model::least::State;

impl Search<'_> {
    /// The model of parts that are known: lines and arcs tangent to them, by turns.
    pub fn known(&mut self, parts: &[Part], closed: bool) -> Model {
        let points = self.row.points;
        let (n, m) = (points.len(), parts.len());
        let circle =
            |p: &Part| [p.center[0] - p.along[1] / p.curvature, p.center[1] + p.along[0] / p.curvature];
        let join = |k: usize| {
            let (a, b) = (&parts[k], &parts[(k + 1) % m]);
            let (line, arc) = if a.kind == SegmentKind::Line { (a, b) } else { (b, a) };
            let s = dot(minus(circle(arc), line.center), line.along);
            [0, 1].map(|k| line.center[k] + s * line.along[k])
        };
        let start = |k: usize| if k > 0 || closed { join((k + m - 1) % m) } else { points[0] };
        let end = |k: usize| if k + 1 < m || closed { join(k) } else { points[n - 1] };
        let piece = |(k, part): (usize, &Part)| match part.kind {
            SegmentKind::Line => Piece::line(distance(start(k), end(k))),
            _ => {
                let center = circle(part);
                let turn = angle(minus(start(k), center), minus(end(k), center)) * part.curvature.signum();
                let turn = if turn < 0.0 { turn + std::f64::consts::TAU } else { turn };
                Piece::arc(turn / part.curvature.abs(), part.curvature)
            }
        };
        let pieces = parts.iter().enumerate().map(piece).collect();
        let heading = libm::atan2(parts[0].along[1], parts[0].along[0]);
        let chain = Chain { start: start(0), heading, pieces, closed, even: false, ends: Ends::default() };
        let shift = if closed { n } else { 0 };
        let breaks = parts.iter().map(|p| p.from + shift).chain([parts[0].from + n + shift]).collect();
        let model = Model { state: State { chain, breaks, feet: vec![0.5; n], sum: 0.0 }, cost: 0.0 };
        self.converge(&model)
    }
}
