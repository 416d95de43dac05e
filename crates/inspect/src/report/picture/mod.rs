//! The picture that is stored in the report: for readers without WebGL, and for print.
//!
//! A plain software rasteriser. Like the script's, it colours each pixel from the value interpolated there.

mod camera;
mod png;

use super::{Geometry, Up, ViewObject};
use crate::results::Role;
use crate::scale::{NO_VALUE, Scale};
use camera::Camera;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Point, Vector, cross, dot, minus, plus, unit};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 900;
/// Samples a pixel and side.
const FINE: u32 = 2;
/// Blue-grey of a reference that carries no map.
const REFERENCE: [u8; 3] = [0x8f, 0xa3, 0xbf];
/// Least brightness of a surface seen edge-on.
const DARKEST: f64 = 0.72;
/// Cosine of the angle beyond which a facet keeps its own normal.
const SHARP: f64 = 0.866;

/// Which objects the first view shows, and whether with the map: the measured mesh, else the reference that carries the map
/// of the first comparison, else the measured points over the plain reference.
pub fn first_view<'a, 'b>(objects: &'b [ViewObject<'a>]) -> Vec<(&'b ViewObject<'a>, bool)> {
    let mapped = |o: &&ViewObject| o.field(0).is_some();
    let mesh = |o: &&ViewObject| o.mesh().is_some();
    let measured = objects.iter().filter(|o| o.role == Role::Measured);
    if let Some(o) = measured.clone().filter(mesh).find(mapped) {
        return vec![(o, true)];
    }
    let references = objects.iter().filter(|o| o.role == Role::Reference);
    if let Some(o) = references.clone().filter(mesh).find(mapped) {
        return vec![(o, true)];
    }
    let plain = references.filter(|o| o.comparison.unwrap_or(0) == 0).map(|o| (o, false));
    plain.chain(measured.map(|o| (o, true))).collect()
}

/// The first view as a PNG on a transparent ground.
pub fn png(objects: &[ViewObject], scale: &Scale, up: Up) -> Vec<u8> {
    let shown = first_view(objects);
    let finite = |p: &&Point| p.iter().all(|x| x.is_finite());
    let places = shown.iter().flat_map(|(o, _)| o.places()).filter(finite);
    let camera = Camera::isometric(places, up, FINE * WIDTH, FINE * HEIGHT);
    let mut canvas = Canvas::new(FINE * WIDTH, FINE * HEIGHT);
    for (object, mapped) in shown {
        let values = object.field(0).filter(|_| mapped).map(|f| f.values);
        match object.geometry {
            Geometry::Mesh(mesh) => canvas.mesh(mesh, values, scale, &camera),
            Geometry::Points(points) => canvas.points(points, values, scale, &camera),
        }
    }
    png::encode(WIDTH, HEIGHT, &canvas.reduced())
}

struct Canvas {
    width: u32,
    height: u32,
    depth: Vec<f32>,
    color: Vec<[u8; 3]>,
}

impl Canvas {
    fn new(width: u32, height: u32) -> Canvas {
        let n = (width * height) as usize;
        Canvas { width, height, depth: vec![f32::NEG_INFINITY; n], color: vec![[0; 3]; n] }
    }

    fn put(&mut self, x: u32, y: u32, depth: f32, color: impl FnOnce() -> [u8; 3]) {
        let at = (y * self.width + x) as usize;
        if depth > self.depth[at] {
            self.depth[at] = depth;
            self.color[at] = color();
        }
    }

    /// Triangles with a missing or non-finite corner are passed over; one without all three values is drawn as no value.
    fn mesh(&mut self, mesh: &Mesh, values: Option<&[f64]>, scale: &Scale, camera: &Camera) {
        let normals = smooth_normals(mesh);
        let table = Colors::of(scale);
        for face in &mesh.faces {
            let corner =
                |k: usize| mesh.positions.get(face[k] as usize).filter(|p| p.iter().all(|x| x.is_finite()));
            let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) else { continue };
            let Some((facet, _)) = unit(cross(minus(*b, *a), minus(*c, *a))) else { continue };
            let at = [a, b, c].map(|p| camera.project(p));
            let light = face.map(|v| {
                let n = normals[v as usize];
                dot(if dot(n, facet) < SHARP { facet } else { n }, camera.toward).abs()
            });
            let value = values.map(|v| face.map(|i| v[i as usize]));
            self.triangle(&at, |w| {
                let mix = |x: &[f64; 3]| (0..3).map(|k| w[k] * x[k]).sum::<f64>();
                let base = value.map_or(REFERENCE, |v| table.color(mix(&v)));
                shade(base, mix(&light))
            });
        }
    }

    /// Calls `color` with barycentric coordinates for every covered sample that is nearest so far.
    fn triangle(&mut self, at: &[[f64; 3]; 3], color: impl Fn([f64; 3]) -> [u8; 3]) {
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
                    self.put(x, y, depth as f32, || color(w));
                }
            }
        }
    }

    /// Small squares.
    fn points(&mut self, points: &[Point], values: Option<&[f64]>, scale: &Scale, camera: &Camera) {
        let table = Colors::of(scale);
        for (i, p) in points.iter().enumerate() {
            let [x, y, z] = camera.project(p);
            if !(x.is_finite() && y.is_finite()) {
                continue;
            }
            let color = values.map_or(REFERENCE, |v| table.color(v[i]));
            for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                let (x, y) = (x as i64 + dx, y as i64 + dy);
                if (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y) {
                    self.put(x as u32, y as u32, z as f32, || color);
                }
            }
        }
    }

    /// One pixel from `FINE`² samples; opacity is the share covered.
    fn reduced(&self) -> Vec<[u8; 4]> {
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

/// A scale looked up once, not once a pixel.
struct Colors<'a> {
    scale: &'a Scale,
    limits: Vec<f64>,
    colors: Vec<[u8; 3]>,
}

impl Colors<'_> {
    fn of(scale: &Scale) -> Colors<'_> {
        Colors { scale, limits: scale.limits(), colors: scale.colors() }
    }

    fn color(&self, value: f64) -> [u8; 3] {
        if value.is_nan() {
            return NO_VALUE;
        }
        match self.scale.mode {
            crate::scale::Mode::Continuous => self.scale.color(value),
            _ => self.colors[crate::scale::slot(&self.limits, value)],
        }
    }
}

/// Area-weighted; zero where the facets around cancel out.
fn smooth_normals(mesh: &Mesh) -> Vec<Vector> {
    let mut sums = vec![[0.0; 3]; mesh.positions.len()];
    for face in &mesh.faces {
        let corner = |k: usize| mesh.positions.get(face[k] as usize).copied();
        let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) else { continue };
        let n = cross(minus(b, a), minus(c, a));
        face.iter().for_each(|v| sums[*v as usize] = plus(sums[*v as usize], n));
    }
    sums.into_iter().map(|n| unit(n).map_or([0.0; 3], |(n, _)| n)).collect()
}

/// Diffuse light from the eye.
fn shade(color: [u8; 3], cosine: f64) -> [u8; 3] {
    let factor = DARKEST + (1.0 - DARKEST) * cosine.clamp(0.0, 1.0);
    color.map(|c| (f64::from(c) * factor).round() as u8)
}
