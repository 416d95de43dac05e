//! The samples of a picture: what is nearest at each.

/// Samples a pixel and side.
pub const FINE: u32 = 2;

pub struct Canvas {
    pub width: u32,
    pub height: u32,
    pub depth: Vec<f32>,
    pub color: Vec<[u8; 3]>,
    /// A mark behind the surface shows here.
    pub marked: Vec<bool>,
    /// An edge of the surface is drawn here.
    pub edged: Vec<bool>,
}

impl Canvas {
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

    pub fn put(&mut self, x: u32, y: u32, depth: f32, color: impl FnOnce() -> [u8; 3]) {
        let at = (y * self.width + x) as usize;
        if depth > self.depth[at] {
            self.depth[at] = depth;
            self.color[at] = color();
            self.edged[at] = false;
        }
    }

    /// Calls `put` with place, depth and barycentric coordinates for every sample that a triangle covers.
    pub fn each_sample(&mut self, at: &[[f64; 3]; 3], put: impl Fn(&mut Canvas, u32, u32, f64, [f64; 3])) {
        let [a, b, c] = at;
        let edge = |p: &[f64; 3], q: &[f64; 3], x: f64, y: f64| {
            (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
        };
        let area = edge(a, b, c[0], c[1]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let span = |k: usize, limit: u32| {
            let low = at.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min).floor().max(0.0) as u32;
            let high = at.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max).ceil().max(0.0) as u32;
            low..high.saturating_add(1).min(limit)
        };
        for y in span(1, self.height) {
            for x in span(0, self.width) {
                let (px, py) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                let w = [edge(b, c, px, py) / area, edge(c, a, px, py) / area, edge(a, b, px, py) / area];
                if w.iter().all(|v| *v >= 0.0) {
                    let depth = (0..3).map(|k| w[k] * at[k][2]).sum::<f64>();
                    put(self, x, y, depth, w);
                }
            }
        }
    }

    /// Calls `put` with place and squared distance for every sample within `radius` of a place.
    pub fn disc(&mut self, [cx, cy]: [f64; 2], radius: f64, put: impl Fn(&mut Canvas, u32, u32, f64)) {
        let span = |c: f64, limit: u32| {
            let from = (c - radius).ceil().max(0.0) as u32;
            from..((c + radius).floor().max(-1.0) + 1.0).min(f64::from(limit)) as u32
        };
        let (columns, rows) = (span(cx, self.width), span(cy, self.height));
        for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
            let (dx, dy) = (f64::from(x) - cx, f64::from(y) - cy);
            let square = dx * dx + dy * dy;
            if square <= radius * radius {
                put(self, x, y, square);
            }
        }
    }

    /// One pixel from `FINE`² samples; opacity is the share covered.
    pub fn reduced(&self) -> Vec<[u8; 4]> {
        let (w, h) = (self.width / FINE, self.height / FINE);
        let samples = |x: u32, y: u32| {
            let all = (0..FINE * FINE).map(move |s| (FINE * y + s / FINE) * self.width + FINE * x + s % FINE);
            all.map(|i| i as usize).filter(|i| self.depth[*i] > f32::NEG_INFINITY)
        };
        let pixel = |x: u32, y: u32| {
            let n = samples(x, y).count() as u32;
            let mean = |k: usize| {
                (samples(x, y).map(|i| u32::from(self.color[i][k])).sum::<u32>() + n / 2) / n.max(1)
            };
            [mean(0) as u8, mean(1) as u8, mean(2) as u8, (255 * n / (FINE * FINE)) as u8]
        };
        (0..h).flat_map(|y| (0..w).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
    }
}
