//! Facets that keep within a distance of a surface.

use super::{Patches, Surface};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, norm};
use crate::spline::value::Value;

/// A surface as a mesh.
#[derive(Clone, Debug)]
pub struct Tessellation {
    /// Vertices lie on the surface; facets look the way of its normal.
    pub mesh: Mesh,
    /// Parameters of each vertex.
    pub parameters: Vec<[f64; 2]>,
}

impl Surface<Point> {
    /// Facets within `tolerance` of the surface, in rows and columns; `None` if that takes more than `most` facets.
    ///
    /// A facet over steps `h` and `k` of the parameters keeps within `(h² M₁ + 2hk M₂ + k² M₃) / 8` of the surface, with the
    /// greatest second derivatives `M`. (Filip, Magedson and Markot, Surface algorithms using bounds on derivatives, Computer
    /// Aided Geometric Design 3, 1986.) They are bounded by the control points of the derivatives, span by span.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn tessellate(
        &self,
        tolerance: f64,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Option<Tessellation>, Cancelled> {
        let Some([us, vs]) = self.grid(tolerance, most) else { return Ok(None) };
        let patches = Patches::new(self);
        let row = |u: &f64| -> Result<Vec<Point>, Cancelled> {
            if progress.cancelled() {
                Err(Cancelled)
            } else {
                Ok(vs.iter().map(|v| patches.at(*u, *v)).collect())
            }
        };
        let rows: Result<Vec<Vec<Point>>, Cancelled> = us.par_iter().map(row).collect();
        let positions = rows?.concat();
        let n = vs.len() as u32;
        let mut faces = Vec::with_capacity(2 * (us.len() - 1) * (vs.len() - 1));
        for i in 0..us.len() as u32 - 1 {
            for j in 0..n - 1 {
                let a = i * n + j;
                faces.extend([[a, a + n, a + n + 1], [a, a + n + 1, a + 1]]);
            }
        }
        let parameters = us.iter().flat_map(|u| vs.iter().map(|v| [*u, *v])).collect();
        Ok(Some(Tessellation { mesh: Mesh { positions, faces }, parameters }))
    }

    /// Parameters of the rows and columns of facets within `tolerance`; `None` if they make more than `most`.
    pub fn grid(&self, tolerance: f64, most: usize) -> Option<[Vec<f64>; 2]> {
        let bounds = self.second_derivatives();
        let [us, vs] = [self.lines(0, &bounds, tolerance)?, self.lines(1, &bounds, tolerance)?];
        let facets = (us.len() - 1).saturating_mul(vs.len() - 1).saturating_mul(2);
        let is_too_many = facets > most || us.len().saturating_mul(vs.len()) > u32::MAX as usize;
        (!is_too_many).then_some([us, vs])
    }

    /// Bounds of the second derivatives `uu`, `uv`, `vv` over each span: by `u` spans and by `v` spans.
    fn second_derivatives(&self) -> [Vec<[f64; 3]>; 2] {
        let mut out = [0, 1].map(|k| vec![[0.0f64; 3]; self.knots()[k].distinct().len() - 1]);
        for (which, orders) in [[2, 0], [1, 1], [0, 2]].into_iter().enumerate() {
            let Some((points, counts)) = self.derivative_points(orders) else { continue };
            for (k, rows) in out.iter_mut().enumerate() {
                let knots = &self.knots()[k];
                let p = knots.degree();
                for (span, w) in knots.distinct().windows(2).enumerate() {
                    // Functions of the lowered degree that act there.
                    let last = knots.span(0.5 * (w[0] + w[1])) - orders[k];
                    let acting = last - (p - orders[k])..=last;
                    let inside =
                        |i: &usize| acting.contains(&if k == 0 { i / counts[1] } else { i % counts[1] });
                    rows[span][which] =
                        (0..points.len()).filter(inside).map(|i| norm(points[i])).fold(0.0, f64::max);
                }
            }
        }
        out
    }

    /// Control points of a derivative and their number in both directions; `None` where it is 0 everywhere.
    fn derivative_points(&self, orders: [usize; 2]) -> Option<(Vec<Point>, [usize; 2])> {
        let mut counts = self.counts();
        let mut points = self.points().to_vec();
        for k in 0..2 {
            for order in 0..orders[k] {
                let (p, u) = (
                    self.knots()[k].degree().checked_sub(order).filter(|p| *p > 0)?,
                    self.knots()[k].values(),
                );
                let mut fewer = counts;
                fewer[k] = fewer[k].checked_sub(1).filter(|n| *n > 0)?;
                let step = if k == 0 { counts[1] } else { 1 };
                points = (0..fewer[0] * fewer[1])
                    .map(|n| {
                        let (i, j) = (n / fewer[1], n % fewer[1]);
                        let at = i * counts[1] + j;
                        let knot = [i, j][k] + order;
                        let width = u[knot + p + 1] - u[knot + 1];
                        let factor = if width > 0.0 { p as f64 / width } else { 0.0 };
                        points[at + step].minus(points[at]).times(factor)
                    })
                    .collect();
                counts = fewer;
            }
        }
        Some((points, counts))
    }

    /// Parameters of the lines across a direction; `None` where there would be too many.
    fn lines(&self, k: usize, bounds: &[Vec<[f64; 3]>; 2], tolerance: f64) -> Option<Vec<f64>> {
        let all = self.knots()[k].distinct();
        let mut lines = vec![];
        let ratio = self.mixed_share(bounds);
        for (w, [uu, uv, vv]) in all.windows(2).zip(&bounds[k]) {
            let length = w[1] - w[0];
            // Each direction has half of the tolerance; 2hk M₂ is no more than (r h² + k² / r) M₂.
            let bend = if k == 0 { uu + ratio * uv } else { vv + uv / ratio };
            let steps = (length * (bend / (4.0 * tolerance)).sqrt()).ceil().max(1.0);
            if steps.is_nan() || steps >= 1e6 {
                return None;
            }
            let steps = steps as usize;
            lines.extend((0..steps).map(|i| w[0] + length * i as f64 / steps as f64));
        }
        lines.push(all[all.len() - 1]);
        Some(lines)
    }

    /// How the mixed derivative is shared out: by the ratio of steps that the others ask for. A surface with straight lines in
    /// a direction has it by the ratio of the domain's sides.
    fn mixed_share(&self, bounds: &[Vec<[f64; 3]>; 2]) -> f64 {
        let most = |which: usize| bounds[0].iter().map(|b| b[which]).fold(0.0, f64::max);
        let [(u0, u1), (v0, v1)] = self.domain();
        let ratio = (most(0) / most(2)).sqrt();
        if ratio > 0.0 && ratio.is_finite() { ratio } else { (v1 - v0) / (u1 - u0) }
    }
}
