//! Chords that keep near to a curve, and descents to a near place.

use super::bezier::off_chord;
use super::conic::Conic;
use super::kinds::Span;
use super::part::{Foot, Part, Shape};
use std::f64::consts::FRAC_PI_2;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm};

/// Halvings of a piece at most.
const SAMPLE_DEPTH: u32 = 24;
/// Steps of Newton's method at most.
const DESCENT_STEPS: usize = 60;

impl Span {
    /// Parameters from the start of the span to its end, both included, whose chords are nowhere farther than `tolerance` from the curve, and
    /// along none of which its direction turns by more than `angle` radians. Corners are among them.
    pub fn sample(&self, tolerance: f64, angle: f64) -> Vec<f64> {
        let feet = self.feet();
        let mut all = vec![];
        for part in &feet.parts {
            all.push(part.range[0]);
            part.sample(tolerance, angle, &mut all);
        }
        all.extend(feet.parts.last().map(|part| part.range[1]));
        if feet.is_reversed {
            all.reverse();
        }
        all
    }

    /// How far the curve between two shares of the way may be from the chord between them, each with the next.
    pub fn chords_off(&self, shares: &[f64]) -> f64 {
        let feet = self.feet();
        let [from, to] = self.range;
        let parameters: Vec<f64> = shares.iter().map(|s| from + s * (to - from)).collect();
        let off = |w: &[f64]| {
            let kept = [w[0].min(w[1]), w[0].max(w[1])];
            let first = feet.parts.partition_point(|part| part.range[1] <= kept[0]);
            let inner = feet.parts[first..].iter().take_while(|part| part.range[0] < kept[1]);
            let parts: Vec<Part> =
                inner.map(|p| p.within([kept[0].max(p.range[0]), kept[1].min(p.range[1])])).collect();
            let [Some(start), Some(end)] =
                [parts.first().map(|p| p.at(p.own[0])), parts.last().map(|p| p.at(p.own[1]))]
            else {
                return 0.0;
            };
            let ends_off = parts.windows(2).map(|w| off_chord(&w[0].at(w[0].own[1]), &start, &end));
            parts.iter().map(Part::chord_off).fold(0.0, f64::max) + ends_off.fold(0.0, f64::max)
        };
        parameters.windows(2).map(off).fold(0.0, f64::max)
    }

    /// The place that a descent from the parameter `start` comes to: nearer than where it starts, and the nearest one around. Newton's
    /// method on the squared distance within the range; steps that lead farther are shortened.
    pub fn nearest_from(&self, p: Point, start: f64) -> Foot {
        let [low, high] = [self.range[0].min(self.range[1]), self.range[0].max(self.range[1])];
        let mut t = start.clamp(low, high);
        let mut own = self.curve.derivatives(t);
        let mut away = minus(own[0], p);
        for _ in 0..DESCENT_STEPS {
            let [_, first, second] = own;
            let slope = dot(away, first);
            let gauss = dot(first, first);
            let bend = gauss + dot(away, second);
            let mut step = -slope / if bend > 0.0 { bend } else { gauss };
            let mut next = None;
            while (step * norm(first)).abs() > f64::EPSILON * (norm(own[0]) + norm(away)) {
                let tried = (t + step).clamp(low, high);
                let new = self.curve.derivatives(tried);
                let to = minus(new[0], p);
                if tried != t && dot(to, to) < dot(away, away) {
                    next = Some((tried, new, to));
                    break;
                }
                step *= 0.25;
            }
            let Some((tried, new, to)) = next else { break };
            (t, own, away) = (tried, new, to);
        }
        Foot { parameter: t, place: own[0], distance: norm(away) }
    }
}

impl Part {
    /// How far it may be from the chord between its ends.
    fn chord_off(&self) -> f64 {
        match &self.shape {
            Shape::Line { .. } => 0.0,
            Shape::Conic(conic) => {
                let [low, high] = [self.own[0].min(self.own[1]), self.own[0].max(self.own[1])];
                0.125 * (high - low) * (high - low) * conic.bend([low, high])
            }
            Shape::Bezier(bezier) => bezier.bend()[0],
        }
    }

    /// Adds parameters within the piece.
    fn sample(&self, tolerance: f64, angle: f64, all: &mut Vec<f64>) {
        match &self.shape {
            Shape::Line { .. } => {}
            Shape::Conic(conic) => {
                let steps = conic_steps(conic, self.own, tolerance, angle);
                all.extend((1..steps).map(|i| {
                    let share = i as f64 / steps as f64;
                    self.range[0] + share * (self.range[1] - self.range[0])
                }));
            }
            Shape::Bezier(whole) => {
                let mut open = vec![(0.0, 1.0, whole.clone(), SAMPLE_DEPTH)];
                let mut inner = vec![];
                while let Some((from, to, bezier, depth)) = open.pop() {
                    let [off, turn] = bezier.bend();
                    if depth == 0 || off <= tolerance && turn <= angle {
                        inner.push(from);
                        continue;
                    }
                    let middle = 0.5 * (from + to);
                    open.push((middle, to, bezier.part(0.5, 1.0), depth - 1));
                    open.push((from, middle, bezier.part(0.0, 0.5), depth - 1));
                }
                let first = all.len();
                all.extend(inner.into_iter().skip(1).map(|t| self.parameter(t)));
                if self.own[0] > self.own[1] {
                    all[first..].reverse();
                }
            }
        }
    }
}

/// Equal steps of the parameter: by the second derivative where it bends most, so that a chord is within `h² M / 8`.
fn conic_steps(conic: &Conic, own: [f64; 2], tolerance: f64, angle: f64) -> usize {
    let [low, high] = [own[0].min(own[1]), own[0].max(own[1])];
    let most = conic.bend([low, high]);
    let by_chord = ((high - low) * (most / (8.0 * tolerance)).sqrt()).ceil();
    let limit = f64::from(1u32 << SAMPLE_DEPTH);
    let mut steps = if by_chord.is_finite() { by_chord.clamp(1.0, limit) } else { 1.0 };
    if conic.is_periodic() {
        steps = steps.max(((high - low) / FRAC_PI_2).ceil());
    }
    let turn = |a: Vector, b: Vector| libm::atan2(norm(cross(a, b)), dot(a, b));
    loop {
        let at = |i: f64| conic.direction(low + (high - low) * i / steps);
        let turns = (0..steps as usize).map(|i| turn(at(i as f64), at((i + 1) as f64)));
        let greatest = turns.fold(0.0, f64::max);
        if greatest <= angle * (1.0 + 1e-9) || steps >= limit || angle.is_nan() || angle <= 0.0 {
            return steps as usize;
        }
        steps = (steps * (greatest / angle).clamp(1.1, 8.0)).ceil();
    }
}
