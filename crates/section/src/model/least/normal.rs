//! The normal equations of a chain: the effect of each unknown on all that follows, and the conditions that must hold.

use super::super::chain::{Chain, SegmentKind};
use super::super::result::Uncertainty;
use super::work::{Held, TRIAL_CONDITION_WEIGHT, Variable, Work};

impl Work {
    /// Motion of all that follows by each unknown of each piece: shift of the origin and turn about it.
    fn move_ends(&mut self, chain: &Chain) {
        self.motions.resize_with(chain.pieces.len(), Vec::new);
        for (g, piece) in chain.pieces.iter().enumerate() {
            let (pose, end) = (&self.layout.poses[g], &self.layout.poses[g + 1]);
            let about = |shift: [f64; 2], turn: f64| {
                let shift = pose.out(shift);
                [shift[0] + turn * end.at[1], shift[1] - turn * end.at[0], turn]
            };
            let motions = &mut self.motions[g];
            motions.clear();
            match piece.kind {
                SegmentKind::Line => motions.push(about([1.0, 0.0], 0.0)),
                SegmentKind::Arc => {
                    let turn = piece.length * piece.coefficients[0];
                    let (sin, cos) = libm::sincos(turn);
                    motions.push(about([cos, sin], piece.coefficients[0]));
                    let square = piece.length * piece.length;
                    let shift = if turn.abs() < 1e-3 {
                        [-turn / 3.0, 0.5 - turn * turn / 8.0]
                    } else {
                        [(turn * cos - sin) / (turn * turn), (turn * sin - (1.0 - cos)) / (turn * turn)]
                    };
                    motions.push(about([square * shift[0], square * shift[1]], piece.length));
                }
                SegmentKind::Spline => {
                    let table = &self.layout.tables[g];
                    let turns = std::iter::once(table.turn / piece.length).chain(table.end_turns());
                    motions.extend(table.end_motions().iter().zip(turns).map(|(m, t)| about(*m, t)));
                }
            }
        }
    }

    fn list(&mut self, chain: &Chain) {
        let last = chain.pieces.len() - 1;
        self.variables.clear();
        if !chain.ends.start {
            self.variables.push(Variable::Left);
            self.variables.push(Variable::Turn);
        }
        if chain.closed {
            self.variables.push(Variable::Forward);
        }
        for (piece, p) in chain.pieces.iter().enumerate() {
            if chain.closed || piece < last || chain.ends.end.is_some() {
                let after = (!chain.closed && piece < last).then_some(piece + 1);
                self.variables.push(Variable::Join { before: piece, after });
            }
            self.variables
                .extend((0..p.coefficients.len()).map(|index| Variable::Coefficient { piece, index }));
        }
    }

    /// Effect of a variable on the row of products of piece `g`: (index, factor) pairs of its own, and a motion of all.
    fn effect(&self, chain: &Chain, variable: Variable, g: usize) -> ([f64; 3], Option<(usize, f64)>) {
        let start = &self.layout.poses[0];
        let mut motion = [0.0; 3];
        let mut own = None;
        let mut add = |piece: usize, index: usize, factor: f64| {
            if piece < g {
                let m = self.motions[piece][index];
                (0..3).for_each(|k| motion[k] += factor * m[k]);
            } else if piece == g {
                // The length of a line or arc moves nothing of its own.
                match (chain.pieces[g].kind, index) {
                    (SegmentKind::Spline, index) => own = Some((3 + index, factor)),
                    (SegmentKind::Arc, 1) => own = Some((3, factor)),
                    _ => {}
                }
            }
        };
        match variable {
            Variable::Left => motion = [start.normal()[0], start.normal()[1], 0.0],
            Variable::Forward => motion = [start.along[0], start.along[1], 0.0],
            Variable::Turn => motion = [start.at[1], -start.at[0], 1.0],
            Variable::Join { before, after } => {
                add(before, 0, 1.0);
                if let Some(after) = after {
                    add(after, 0, -1.0);
                }
            }
            Variable::Coefficient { piece, index } => add(piece, 1 + index, 1.0),
        }
        (motion, own)
    }

    /// Standard deviations of a line's direction, or of an arc's center and radius; `deviation` is that of a number which the
    /// unknowns move so.
    pub(super) fn uncertainty(
        &self,
        chain: &Chain,
        g: usize,
        deviation: &dyn Fn(Vec<f64>) -> f64,
    ) -> Option<Uncertainty> {
        let of = |f: &dyn Fn([f64; 3], Option<(usize, f64)>) -> f64| -> f64 {
            let each = self.variables.iter().map(|v| self.effect(chain, *v, g));
            deviation(each.map(|(motion, own)| f(motion, own)).collect())
        };
        match chain.pieces[g].kind {
            SegmentKind::Line => Some(Uncertainty::Line { angle: of(&|m, _| m[2]) }),
            SegmentKind::Arc => {
                // The center moves with the piece as a rigid body, and along the normal of its start with the radius.
                let curvature = chain.pieces[g].coefficients[0];
                let (pose, radius) = (&self.layout.poses[g], 1.0 / curvature);
                let normal = pose.normal();
                let center = [0, 1].map(|k| pose.at[k] + radius * normal[k]);
                let stretch = |own: Option<(usize, f64)>| own.map_or(0.0, |(_, x)| -radius * radius * x);
                Some(Uncertainty::Arc {
                    center: [
                        of(&|m, own| m[0] - m[2] * center[1] + stretch(own) * normal[0]),
                        of(&|m, own| m[1] + m[2] * center[0] + stretch(own) * normal[1]),
                    ],
                    radius: of(&|_, own| stretch(own)),
                })
            }
            SegmentKind::Spline => None,
        }
    }

    /// The normal equations of all unknowns, and the conditions that must hold exactly, if they must.
    pub(super) fn assemble(&mut self, chain: &Chain, held: Option<&Held>) {
        self.move_ends(chain);
        self.list(chain);
        let k = self.variables.len();
        self.matrix.clear();
        self.matrix.resize(k * k, 0.0);
        self.right.clear();
        self.right.resize(k, 0.0);
        self.add_where_they_act(chain);
        self.add_beyond(chain);
        self.scale.clear();
        self.scale.extend((0..k).map(|v| self.matrix[v * k + v]));
        self.conditions = self.conditions_of(chain, held);
        self.missing = self.off(chain, held);
        for (row, off) in self.conditions.iter().zip(&self.missing) {
            for v in 0..k {
                self.right[v] += TRIAL_CONDITION_WEIGHT * row[v] * off;
                for u in 0..=v {
                    self.matrix[v * k + u] += TRIAL_CONDITION_WEIGHT * row[v] * row[u];
                }
            }
        }
        if !self.exact {
            self.conditions.clear();
            self.missing.clear();
        }
    }

    /// Adds to the normal equations the products of each piece's points, for the unknowns that act within it and for
    /// those with all others.
    fn add_where_they_act(&mut self, chain: &Chain) {
        let k = self.variables.len();
        let mut product = vec![];
        let mut effects = Vec::with_capacity(k);
        for g in 0..chain.pieces.len() {
            effects.clear();
            // Unknowns of later pieces do nothing here.
            effects.extend((0..k).map(|v| self.effect(chain, self.variables[v], g)).enumerate());
            effects.retain(|(_, (m, own))| own.is_some() || *m != [0.0; 3]);
            let block = &self.blocks[g];
            let n = block.size;
            let entry = |i: usize, j: usize| block.products[i.max(j) * n + i.min(j)];
            let value = |list: &[f64], (m, own): &([f64; 3], Option<(usize, f64)>)| {
                let own = own.map_or(0.0, |(index, factor)| factor * list[index]);
                own + m[0] * list[0] + m[1] * list[1] + m[2] * list[2]
            };
            let acts = |v: usize| self.variables[v].last().is_some_and(|last| last >= g);
            for (v, (motion, own)) in effects.iter().filter(|(v, _)| acts(*v)) {
                product.clear();
                product.extend((0..n).map(|i| {
                    let own = own.map_or(0.0, |(index, factor)| factor * entry(i, index));
                    own + motion[0] * entry(i, 0) + motion[1] * entry(i, 1) + motion[2] * entry(i, 2)
                }));
                self.right[*v] += value(&block.right, &(*motion, *own));
                // A pair that both act here is seen from the later one.
                for (u, effect) in effects.iter().filter(|(u, _)| u <= v || !acts(*u)) {
                    self.matrix[(*v).max(*u) * k + (*v).min(*u)] += value(&product, effect);
                }
            }
        }
    }

    /// Adds the products of the points beyond the pieces in which unknowns act. There each moves all as a rigid body,
    /// always the same, so that sums over all points that follow serve for every pair. So the time grows with the
    /// square of the number of unknowns, not with the cube.
    fn add_beyond(&mut self, chain: &Chain) {
        let (k, n) = (self.variables.len(), chain.pieces.len());
        // Sums over the points from each piece on: the products of the three motions, lower triangle, and with the
        // distances.
        let mut sums = vec![[0.0; 9]; n + 1];
        for g in (0..n).rev() {
            let (block, size) = (&self.blocks[g], self.blocks[g].size);
            let own = |i: usize, j: usize| block.products[i * size + j];
            let r = &block.right;
            let all = [own(0, 0), own(1, 0), own(1, 1), own(2, 0), own(2, 1), own(2, 2), r[0], r[1], r[2]];
            sums[g] = std::array::from_fn(|i| sums[g + 1][i] + all[i]);
        }
        let far: Vec<([f64; 3], usize)> = (self.variables.iter())
            .map(|v| (self.effect(chain, *v, n).0, v.last().map_or(0, |last| last + 1)))
            .collect();
        for (v, (m, from)) in far.iter().enumerate() {
            let s = &sums[(*from).min(n)];
            self.right[v] += m[0] * s[6] + m[1] * s[7] + m[2] * s[8];
            for (u, (o, other)) in far[..=v].iter().enumerate() {
                let s = &sums[(*from).max(*other).min(n)];
                let product = [
                    m[0] * s[0] + m[1] * s[1] + m[2] * s[3],
                    m[0] * s[1] + m[1] * s[2] + m[2] * s[4],
                    m[0] * s[3] + m[1] * s[4] + m[2] * s[5],
                ];
                self.matrix[v * k + u] += product[0] * o[0] + product[1] * o[1] + product[2] * o[2];
            }
        }
    }

    /// Quantities that must vanish, with a minus sign.
    pub(super) fn off(&self, chain: &Chain, held: Option<&Held>) -> Vec<f64> {
        let mut all = vec![];
        if chain.closed {
            let (start, end) = (self.layout.poses[0], self.layout.poses[chain.pieces.len()]);
            let turn = end.heading - start.heading;
            let whole = std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
            all.extend([start.at[0] - end.at[0], start.at[1] - end.at[1], size(chain) * (whole - turn)]);
        }
        if let Some(to) = chain.ends.end {
            let end = self.layout.poses[chain.pieces.len()];
            let turn = size(chain) * (to.heading - end.heading);
            all.extend([to.at[0] - end.at[0], to.at[1] - end.at[1], turn]);
        }
        all.extend(bends(chain).map(|(before, after, scale)| {
            scale
                * (before.map_or(0.0, |(g, i)| chain.pieces[g].coefficients[i])
                    - after.map_or(0.0, |(g, i)| chain.pieces[g].coefficients[i]))
        }));
        if let Some(held) = held {
            let at = self.layout.poses[held.join].at;
            all.push(held.value - at[0] * held.along[0] - at[1] * held.along[1]);
        }
        all
    }

    /// How each unknown changes it.
    pub(super) fn conditions_of(&self, chain: &Chain, held: Option<&Held>) -> Vec<Vec<f64>> {
        let mut all = vec![];
        let of = |g: usize, f: &dyn Fn([f64; 3]) -> f64| -> Vec<f64> {
            self.variables.iter().map(|v| f(self.effect(chain, *v, g).0)).collect()
        };
        let moved = |m: [f64; 3], at: [f64; 2]| [m[0] - m[2] * at[1], m[1] + m[2] * at[0]];
        if chain.closed {
            let end = self.layout.poses[chain.pieces.len()];
            let pose = |v: &Variable| matches!(v, Variable::Left | Variable::Turn | Variable::Forward);
            let free = |mut row: Vec<f64>| {
                // The start moves with the end.
                row.iter_mut().zip(&self.variables).filter(|(_, v)| pose(v)).for_each(|(x, _)| *x = 0.0);
                row
            };
            for k in 0..2 {
                all.push(free(of(chain.pieces.len(), &|m| moved(m, end.at)[k])));
            }
            all.push(free(of(chain.pieces.len(), &|m| size(chain) * m[2])));
        }
        if chain.ends.end.is_some() {
            let n = chain.pieces.len();
            let end = self.layout.poses[n];
            all.extend((0..2).map(|k| of(n, &|m| moved(m, end.at)[k])));
            all.push(of(n, &|m| size(chain) * m[2]));
        }
        for (before, after, scale) in bends(chain) {
            let is = |v: &Variable, end: Option<(usize, usize)>| {
                f64::from(end.is_some_and(|(piece, index)| *v == Variable::Coefficient { piece, index }))
            };
            all.push(self.variables.iter().map(|v| scale * (is(v, after) - is(v, before))).collect());
        }
        if let Some(held) = held {
            let at = self.layout.poses[held.join].at;
            all.push(of(held.join, &|m| {
                let d = moved(m, at);
                d[0] * held.along[0] + d[1] * held.along[1]
            }));
        }
        all
    }
}

/// A length that makes a turn as long as the shift that it causes.
fn size(chain: &Chain) -> f64 {
    chain.pieces.iter().map(|p| p.length).sum::<f64>() / 8.0
}

/// Piece and coefficient that is the curvature at an end of a piece; `None` on a line.
pub(super) fn end_coefficient(chain: &Chain, piece: usize, at_end: bool) -> Option<(usize, usize)> {
    let last = chain.pieces[piece].coefficients.len().checked_sub(1)?;
    Some((piece, if at_end { last } else { 0 }))
}

/// Coefficients before and after a join, and a scale.
type Bend = (Option<(usize, usize)>, Option<(usize, usize)>, f64);

/// The joins of free pieces at which the curvature must not jump: coefficients on either side, and the factor that
/// makes their difference a length.
fn bends(chain: &Chain) -> impl Iterator<Item = Bend> + '_ {
    let n = chain.pieces.len();
    let first = usize::from(!chain.closed);
    let joins = if chain.even { first..n } else { 0..0 };
    let scale = size(chain) * size(chain);
    joins.filter_map(move |after| {
        let before = (after + n - 1) % n;
        let free = [before, after].iter().any(|g| chain.pieces[*g].kind == SegmentKind::Spline);
        free.then(|| (end_coefficient(chain, before, true), end_coefficient(chain, after, false), scale))
    })
}
