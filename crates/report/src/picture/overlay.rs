//! Marks in the stored picture: over the part, and paler or not at all where it is in front of them.

use super::super::marks::Mark;
use super::camera::Camera;
use super::canvas::{Band, Canvas, SAMPLES_PER_PIXEL};
use trueness_document::scale::palette::Rgb;

/// Half the width of a line and radius of a dot, in samples.
const LINE_HALF_WIDTH: f64 = 1.6 * SAMPLES_PER_PIXEL as f64;
const DOT_RADIUS: f64 = 4.0 * SAMPLES_PER_PIXEL as f64;
/// Opacity of what the part hides.
const HIDDEN_OPACITY: f64 = 0.4;

/// Draws a mark in its color. `through`: it is seen where the part is in front of it.
pub fn draw(canvas: &mut Canvas, mark: &Mark, color: Rgb, camera: &Camera, through: bool) {
    // What lies in the surface is in front of it.
    let lift = 1e-3 * f64::from(canvas.width);
    for t in &mark.triangles {
        canvas.whole().each_sample(&t.map(|p| camera.project(&p)), |canvas, x, y, depth, _| {
            canvas.blend(x, y, depth + lift, color, through);
        });
    }
    for [a, b] in &mark.segments {
        let (a, b) = (camera.project(a), camera.project(b));
        let steps = (libm::hypot(b[0] - a[0], b[1] - a[1]) / LINE_HALF_WIDTH).ceil().clamp(1.0, 1e5);
        for i in 0..=steps as u32 {
            let t = f64::from(i) / steps;
            let [x, y, z] = [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
            canvas.whole().disc([x, y], LINE_HALF_WIDTH, |canvas, x, y, _| {
                canvas.blend(x, y, z + lift, color, through)
            });
        }
    }
    for p in &mark.points {
        let [x, y, z] = camera.project(p);
        canvas
            .whole()
            .disc([x, y], DOT_RADIUS, |canvas, x, y, _| canvas.blend(x, y, z + lift, color, through));
    }
}

impl Band<'_> {
    /// The color itself where nothing is in front; where something is, nothing, or a mixture, but only once.
    fn blend(&mut self, x: u32, y: u32, depth: f64, color: Rgb, through: bool) {
        let at = self.at(x, y);
        if depth as f32 >= self.depth[at] {
            self.depth[at] = depth as f32;
            self.color[at] = color;
        } else if through && !self.marked[at] {
            self.marked[at] = true;
            let mixed = |k: usize| {
                f64::from(self.color[at][k]) * (1.0 - HIDDEN_OPACITY) + f64::from(color[k]) * HIDDEN_OPACITY
            };
            self.color[at] = [0, 1, 2].map(|k| mixed(k).round() as u8);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::up::Up;
    use super::*;
    use trueness_geom::space::Point;

    /// A line behind a triangle and beside it.
    fn drawn(through: bool) -> (Canvas, Camera) {
        let [a, b, c] = [[0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [0.0, 4.0, 5.0]];
        let line = Mark { segments: vec![[[-3.0, 1.0, 0.0], [3.0, 1.0, 0.0]]], ..Mark::default() };
        let around = [[-4.0, -4.0, 0.0], [4.0, 4.0, 5.0]];
        let camera = Camera::first_view(around.iter(), Up::Z, [0.0, 0.0, 1.0], [400, 400, 0]);
        let mut canvas = Canvas::new(400, 400);
        canvas.whole().each_sample(&[a, b, c].map(|p| camera.project(&p)), |canvas, x, y, depth, _| {
            canvas.put(x, y, depth as f32, || [200; 3]);
        });
        draw(&mut canvas, &line, [255, 0, 0], &camera, through);
        (canvas, camera)
    }

    #[test]
    fn what_is_no_defect_is_hidden_by_the_part() {
        for through in [false, true] {
            let (canvas, camera) = drawn(through);
            let at = |p: Point| {
                let [x, y, _] = camera.project(&p);
                canvas.color[y.round() as usize * 400 + x.round() as usize]
            };
            assert_eq!(at([-2.0, 1.0, 0.0]), [255, 0, 0], "beside the triangle");
            assert_eq!(at([1.0, 1.0, 0.0]) == [200; 3], !through, "behind it");
        }
    }
}
