//! The samples of a picture: what is nearest at each.

use std::ops::Range;
use trueness_geom::parallel::prelude::*;
use trueness_geom::parallel::{Loop, Source};

/// Samples a pixel and side.
pub const SAMPLES_PER_PIXEL: u32 = 2;
/// Rows of samples that one task draws.
const ROWS_PER_TASK: u32 = 128;
/// Columns up to which all samples around a triangle are looked at.
const MAX_COLUMNS_SCANNED: usize = 4;

pub struct Canvas {
    pub width: u32,
    pub height: u32,
    pub depth: Vec<f32>,
    pub color: Vec<[u8; 3]>,
    /// A mark behind the surface shows here.
    marked: Vec<bool>,
    /// An edge of the surface is drawn here.
    edged: Vec<bool>,
}

/// Some rows of a canvas, to be drawn on. What lies above or below them is passed over.
pub struct Band<'a> {
    pub width: u32,
    /// The first row.
    top: u32,
    /// The row after the last.
    bottom: u32,
    pub depth: &'a mut [f32],
    pub color: &'a mut [[u8; 3]],
    pub marked: &'a mut [bool],
    pub edged: &'a mut [bool],
}

impl Canvas {
    /// Nothing drawn yet.
    pub fn new(width: u32, height: u32) -> Canvas {
        let n = (width * height) as usize;
        Canvas {
            width,
            height,
            depth: vec![f32::NEG_INFINITY; n],
            color: vec![[0; 3]; n],
            marked: vec![false; n],
            edged: vec![false; n],
        }
    }

    /// All rows.
    pub fn whole(&mut self) -> Band<'_> {
        Band {
            width: self.width,
            top: 0,
            bottom: self.height,
            depth: &mut self.depth,
            color: &mut self.color,
            marked: &mut self.marked,
            edged: &mut self.edged,
        }
    }

    /// The rows in pieces that can be drawn on at the same time.
    pub fn bands(&mut self) -> Loop<impl Source<Item = Band<'_>>> {
        let (width, height) = (self.width, self.height);
        let size = (width * ROWS_PER_TASK).max(1) as usize;
        let depth = self.depth.par_chunks_mut(size).zip(self.color.par_chunks_mut(size));
        let marks = self.marked.par_chunks_mut(size).zip(self.edged.par_chunks_mut(size));
        depth.zip(marks).enumerate().map(move |(n, ((depth, color), (marked, edged)))| {
            let top = n as u32 * ROWS_PER_TASK;
            Band { width, top, bottom: (top + ROWS_PER_TASK).min(height), depth, color, marked, edged }
        })
    }

    /// One pixel from `SAMPLES_PER_PIXEL`² samples; opacity is the share covered.
    pub fn reduced(&self) -> Vec<[u8; 4]> {
        let (w, h) = (self.width / SAMPLES_PER_PIXEL, self.height / SAMPLES_PER_PIXEL);
        let samples = |x: u32, y: u32| {
            let all = (0..SAMPLES_PER_PIXEL * SAMPLES_PER_PIXEL).map(move |s| {
                (SAMPLES_PER_PIXEL * y + s / SAMPLES_PER_PIXEL) * self.width
                    + SAMPLES_PER_PIXEL * x
                    + s % SAMPLES_PER_PIXEL
            });
            all.map(|i| i as usize).filter(|i| self.depth[*i] > f32::NEG_INFINITY)
        };
        let pixel = |x: u32, y: u32| {
            let n = samples(x, y).count() as u32;
            let mean = |k: usize| {
                (samples(x, y).map(|i| u32::from(self.color[i][k])).sum::<u32>() + n / 2) / n.max(1)
            };
            [
                mean(0) as u8,
                mean(1) as u8,
                mean(2) as u8,
                (255 * n / (SAMPLES_PER_PIXEL * SAMPLES_PER_PIXEL)) as u8,
            ]
        };
        (0..w * h).into_par_iter().map(|i| pixel(i % w, i / w)).collect()
    }
}

impl Band<'_> {
    /// Number of a sample in the lists of this band.
    pub fn at(&self, x: u32, y: u32) -> usize {
        ((y - self.top) * self.width + x) as usize
    }

    /// Whether places of these rows lie in the band.
    pub fn meets(&self, [low, high]: [f64; 2]) -> bool {
        high >= f64::from(self.top) - 1.0 && low <= f64::from(self.bottom) + 1.0
    }

    /// Draws a sample where nothing is in front.
    pub fn put(&mut self, x: u32, y: u32, depth: f32, color: impl FnOnce() -> [u8; 3]) {
        let at = self.at(x, y);
        if depth > self.depth[at] {
            self.depth[at] = depth;
            self.color[at] = color();
            self.edged[at] = false;
        }
    }

    /// Calls `put` with place, depth and barycentric coordinates for every sample that a triangle covers.
    pub fn each_sample(&mut self, at: &[[f64; 3]; 3], put: impl Fn(&mut Self, u32, u32, f64, [f64; 3])) {
        let [a, b, c] = at;
        let edge = |p: &[f64; 3], q: &[f64; 3], x: f64, y: f64| {
            (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
        };
        let area = edge(a, b, c[0], c[1]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let span = |k: usize, from: u32, to: u32| {
            let low = at.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min).floor().max(0.0) as u32;
            let high = at.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max).ceil().max(0.0) as u32;
            low.max(from)..high.saturating_add(1).min(to)
        };
        let (columns, share) = (span(0, 0, self.width), 1.0 / area);
        for y in span(1, self.top, self.bottom) {
            let py = f64::from(y) + 0.5;
            for x in row(at, area, py, columns.clone()) {
                let px = f64::from(x) + 0.5;
                // Most samples around a triangle are outside of it: one side after the other.
                let u = edge(b, c, px, py) * share;
                if u.is_nan() || u < 0.0 {
                    continue;
                }
                let v = edge(c, a, px, py) * share;
                let w = edge(a, b, px, py) * share;
                if v >= 0.0 && w >= 0.0 {
                    put(self, x, y, u * a[2] + v * b[2] + w * c[2], [u, v, w]);
                }
            }
        }
    }

    /// Calls `put` with place and squared distance for every sample within `radius` of a place.
    pub fn disc(&mut self, [cx, cy]: [f64; 2], radius: f64, put: impl Fn(&mut Self, u32, u32, f64)) {
        let span = |c: f64, first: u32, end: u32| {
            let from = (c - radius).ceil().max(0.0) as u32;
            from.max(first)..((c + radius).floor().max(-1.0) + 1.0).min(f64::from(end)) as u32
        };
        let (columns, rows) = (span(cx, 0, self.width), span(cy, self.top, self.bottom));
        for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
            let (dx, dy) = (f64::from(x) - cx, f64::from(y) - cy);
            let square = dx * dx + dy * dy;
            if square <= radius * radius {
                put(self, x, y, square);
            }
        }
    }
}

/// Those of `columns` that a triangle of this signed double `area` may cover at height `y`, and one more to either side: of the box around a
/// sliver hardly any sample is within.
fn row([a, b, c]: &[[f64; 3]; 3], area: f64, y: f64, columns: Range<u32>) -> Range<u32> {
    if columns.len() <= MAX_COLUMNS_SCANNED {
        return columns;
    }
    let (mut low, mut high) = (f64::from(columns.start), f64::from(columns.end));
    for (p, q) in [(b, c), (c, a), (a, b)] {
        let rise = q[1] - p[1];
        let x = p[0] + (q[0] - p[0]) * (y - p[1]) / rise;
        // Rounding of places far outside of the picture.
        let room = 1.5 + 1e-9 * x.abs();
        match rise * area {
            r if r < 0.0 && x.is_finite() => low = low.max(x - room),
            r if r > 0.0 && x.is_finite() => high = high.min(x + room),
            _ => {}
        }
    }
    low.floor() as u32..high.ceil() as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::num::random::Random;

    /// Slivers too: the samples drawn are those within, by a test of every sample of the picture.
    #[test]
    fn a_triangle_covers_the_samples_within_it() {
        let mut random = Random::new(1);
        let mut covered = 0;
        for n in 0..300 {
            let mut canvas = Canvas::new(70, 40);
            let mut corner = || [90.0 * random.unit() - 10.0, 60.0 * random.unit() - 10.0, 1.0];
            let mut at = [corner(), corner(), corner()];
            if n % 3 == 0 {
                at[2] = std::array::from_fn(|k| at[1][k] + [1.0, -1.2, 0.0][k]);
            }
            if n % 7 == 0 {
                at[1][1] = at[0][1];
            }
            canvas.bands().for_each(|mut band| {
                band.each_sample(&at, |band, x, y, _, _| band.put(x, y, 1.0, || [1; 3]));
            });
            let edge = |p: [f64; 3], q: [f64; 3], x: f64, y: f64| {
                (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
            };
            let [a, b, c] = at;
            let share = 1.0 / edge(a, b, c[0], c[1]);
            for (x, y) in (0..40).flat_map(|y| (0..70).map(move |x| (x, y))) {
                let (px, py) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                let within =
                    [(b, c), (c, a), (a, b)].iter().all(|(p, q)| edge(*p, *q, px, py) * share >= 0.0);
                let drawn = canvas.depth[(y * 70 + x) as usize] > f32::NEG_INFINITY;
                assert_eq!(drawn, within, "{n}: {x} {y} {at:?}");
                covered += u32::from(drawn);
            }
        }
        assert!(covered > 50_000, "{covered}");
    }
}
