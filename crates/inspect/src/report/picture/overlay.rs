//! Marks in the stored picture: over everything, paler where the part is in front of them.

use super::super::marks::Mark;
use super::{Camera, Canvas, FINE};
use crate::scale::palette::Rgb;

/// Half the width of a line and radius of a dot, in samples.
const LINE: f64 = 1.6 * FINE as f64;
const DOT: f64 = 4.0 * FINE as f64;
/// Opacity of what the part hides.
const BEHIND: f64 = 0.4;

/// Draws a mark in its colour.
pub fn draw(canvas: &mut Canvas, mark: &Mark, color: Rgb, camera: &Camera) {
    // What lies in the surface is in front of it.
    let lift = 1e-3 * f64::from(canvas.width);
    for t in &mark.triangles {
        canvas.each_sample(&t.map(|p| camera.project(&p)), |canvas, x, y, depth, _| {
            canvas.blend(x, y, depth + lift, color);
        });
    }
    for [a, b] in &mark.segments {
        let (a, b) = (camera.project(a), camera.project(b));
        let steps = ((b[0] - a[0]).hypot(b[1] - a[1]) / LINE).ceil().clamp(1.0, 1e5);
        for i in 0..=steps as u32 {
            let t = f64::from(i) / steps;
            let [x, y, z] = [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
            canvas.disc([x, y], LINE, |canvas, x, y| canvas.blend(x, y, z + lift, color));
        }
    }
    for p in &mark.points {
        let [x, y, z] = camera.project(p);
        canvas.disc([x, y], DOT, |canvas, x, y| canvas.blend(x, y, z + lift, color));
    }
}

impl Canvas {
    /// The colour itself where nothing is in front; a mixture where something is, but only once.
    fn blend(&mut self, x: u32, y: u32, depth: f64, color: Rgb) {
        let at = (y * self.width + x) as usize;
        if depth as f32 >= self.depth[at] {
            self.depth[at] = depth as f32;
            self.color[at] = color;
        } else if !self.marked[at] {
            self.marked[at] = true;
            let mixed =
                |k: usize| f64::from(self.color[at][k]) * (1.0 - BEHIND) + f64::from(color[k]) * BEHIND;
            self.color[at] = [0, 1, 2].map(|k| mixed(k).round() as u8);
        }
    }
}
