//! The picture that is stored in the report: for readers without WebGL, and for print.
//!
//! A plain software rasteriser. Like the script's, it colours each pixel from the value interpolated there.

mod camera;
mod direction;
mod edges;
mod overlay;
mod png;

pub use direction::{flagged, others};

use super::documents::Pick;
use super::{Geometry, ReportInput, ViewObject, ViewRole};
use crate::scale::palette::Rgb;
use crate::scale::{NO_VALUE, Scale};
use crate::spacing::spacing;
use camera::Camera;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, Vector, cross, dot, minus, plus, unit};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 900;
/// Samples a pixel and side.
const FINE: u32 = 2;
/// Least brightness of a surface seen edge-on.
const DARKEST: f64 = 0.72;
/// How much darker than its middle a point is at its rim, which tells points apart.
const RIM: f64 = 0.2;
/// Room for the flags on the left and on the right, where there are any.
const FLAGS: u32 = 170;
/// The same for the frames of characteristics.
const FRAMES: u32 = 250;
/// Cosine of the angle (15 degrees) between a facet and the mean around one of its corners from which on the corner lies on
/// a crease: the facet then keeps its own normal throughout.
const CREASE: f64 = 0.965_925_826_289_068_3;

/// So many times more points than vertices make a reference far coarser than the points.
const FAR_COARSER: usize = 4;
/// Fewer points than these hardly look like the part.
const FEW: usize = 2000;

/// Numbers of the objects that the first view shows: the measured mesh with its map; of a cloud the points, if there are enough
/// of them and the reference is far coarser, else the reference that carries the map of the first comparison, else the points
/// over the plain reference. Of other things, all but what was there before a repair.
pub fn first_view(objects: &[ViewObject]) -> Vec<usize> {
    let mapped = |role| {
        let fits = |o: &&ViewObject| o.role == role && o.mesh().is_some() && o.field(0).is_some();
        objects.iter().find(fits)
    };
    let points = objects.iter().filter(|o| o.role == ViewRole::Measured).filter_map(|o| o.points());
    let points = points.map(<[Point]>::len).sum::<usize>();
    let reference = mapped(ViewRole::Reference);
    let coarse = reference.is_some_and(|r| {
        points >= FEW.max(FAR_COARSER * r.gathered.map_or(r.places().len(), |g| g.vertices))
    });
    let measured = mapped(ViewRole::Measured).is_some() || coarse;
    let shown = |o: &ViewObject| match o.role {
        ViewRole::Measured => measured || reference.is_none(),
        ViewRole::Reference => !measured && (o.comparison.unwrap_or(0) == 0),
        ViewRole::Before | ViewRole::Deviation => false,
        _ => true,
    };
    (0..).zip(objects).filter(|(_, o)| shown(o)).map(|(n, _)| n).collect()
}

/// The objects that the first view shows.
fn shown_objects<'a>(objects: &'a [ViewObject<'a>]) -> Vec<&'a ViewObject<'a>> {
    first_view(objects).into_iter().map(|n| &objects[n]).collect()
}

/// Whether objects show values of the first map.
fn mapped(shown: &[&ViewObject]) -> bool {
    shown.iter().any(|o| o.field(0).is_some())
}

/// How the report is looked at first: the direction, and where the picks lie in the stored picture.
pub struct FirstView {
    /// From the part to the eye, of length 1.
    pub toward: Vector,
    /// The picks that it was chosen for, most important first, and whether each is hidden.
    pub places: Vec<(usize, bool)>,
    /// For each pick, whether it lies so far off that it is not on the part.
    pub off: Vec<bool>,
    /// For each pick with a flag in this view, whether it is hidden.
    pub hidden: Vec<bool>,
    /// For each pick, where its leader ends.
    pub ends: Vec<Point>,
    /// Whether it shows values as colors, and so flags.
    pub mapped: bool,
    camera: Camera,
}

impl FirstView {
    /// Of a report with these picks.
    pub fn of(input: &ReportInput, picks: &[Pick]) -> FirstView {
        let direction::Direction { toward, places, off, hidden, ends } = direction::direction(input, picks);
        let shown = shown_objects(input.objects);
        let mapped = mapped(&shown);
        let finite = |p: &&Point| p.iter().all(|x| x.is_finite());
        let flagged = |n: &usize| flagged(&picks[*n], mapped);
        let beside = (0..picks.len()).filter(|n| off[*n] && flagged(n)).map(|n| &picks[n].position);
        let all = shown.iter().flat_map(|o| o.places()).chain(beside).filter(finite);
        let margin = match (0..picks.len()).any(|n| flagged(&n)) {
            true if mapped => FLAGS,
            true => FRAMES,
            false => 0,
        };
        let camera =
            Camera::first_view(all, input.options.up, toward, [WIDTH, HEIGHT, margin].map(|n| FINE * n));
        FirstView { toward, places, off, hidden, ends, mapped, camera }
    }

    /// Width and height of the picture in pixels.
    pub const SIZE: [u32; 2] = [WIDTH, HEIGHT];

    /// Where a place lies in the picture, pixels from the top left.
    pub fn pixel(&self, place: &Point) -> [f64; 2] {
        let [x, y, _] = self.camera.project(place);
        [x, y].map(|x| x / f64::from(FINE))
    }
}

/// Places drawn between two questions whether to go on.
const TASK: usize = 1 << 13;

/// The first view of a report as a PNG on a transparent ground. `progress` hears of the places of all objects.
pub fn png(input: &ReportInput, view: &FirstView, progress: &dyn Progress) -> Result<Vec<u8>, Cancelled> {
    let (objects, camera) = (input.objects, &view.camera);
    let scale = input.result.subject().scale();
    let mut canvas = Canvas::new(FINE * WIDTH, FINE * HEIGHT);
    for object in shown_objects(objects) {
        let paint = Paint {
            base: object.color(),
            values: object.field(0).map(|f| f.values).zip(scale.map(Colors::of)),
        };
        match object.geometry {
            // Translucent things are there as their outlines, which are marks.
            Geometry::Mesh(_) if object.role == ViewRole::Element => {}
            Geometry::Mesh(mesh) => canvas.mesh(mesh, &paint, camera, progress)?,
            Geometry::Points(points) => canvas.points(points, &paint, camera, progress)?,
        }
    }
    progress.advance(objects.iter().map(|o| o.places().len() as u64).sum());
    // The first marks lie over the others.
    for marks in input.marks.iter().filter(|m| m.shown()).rev() {
        let all: Vec<_> = marks.colored().collect();
        for (mark, color) in all.into_iter().rev() {
            overlay::draw(&mut canvas, mark, color, camera, marks.role.shows_through());
        }
    }
    Ok(png::encode(WIDTH, HEIGHT, &canvas.reduced()))
}

/// What an object is coloured by: its values where it has some, else its own colour.
struct Paint<'a> {
    base: Rgb,
    values: Option<(&'a [f64], Colors<'a>)>,
}

struct Canvas {
    width: u32,
    height: u32,
    depth: Vec<f32>,
    color: Vec<[u8; 3]>,
    /// A mark behind the surface shows here.
    marked: Vec<bool>,
    /// An edge of the surface is drawn here.
    edged: Vec<bool>,
}

impl Canvas {
    fn new(width: u32, height: u32) -> Canvas {
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

    fn put(&mut self, x: u32, y: u32, depth: f32, color: impl FnOnce() -> [u8; 3]) {
        let at = (y * self.width + x) as usize;
        if depth > self.depth[at] {
            self.depth[at] = depth;
            self.color[at] = color();
            self.edged[at] = false;
        }
    }

    /// Triangles with a missing or non-finite corner are passed over; one without all three values is drawn as no value.
    fn mesh(
        &mut self,
        mesh: &Mesh,
        paint: &Paint,
        camera: &Camera,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        let normals = smooth_normals(mesh);
        for (n, face) in mesh.faces.iter().enumerate() {
            if n % TASK == 0 && progress.cancelled() {
                return Err(Cancelled);
            }
            let corner =
                |k: usize| mesh.positions.get(face[k] as usize).filter(|p| p.iter().all(|x| x.is_finite()));
            let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) else { continue };
            let Some((facet, _)) = unit(cross(minus(*b, *a), minus(*c, *a))) else { continue };
            let at = [a, b, c].map(|p| camera.project(p));
            // A facet on a crease is as flat in the picture as it is.
            let smooth = face.map(|v| normals[v as usize]);
            let smooth = smooth.map(|n| n.filter(|n| dot(*n, facet) > 0.0));
            let smooth = if smooth.iter().all(Option::is_some) { smooth } else { [None; 3] };
            let light = smooth.map(|n| dot(n.unwrap_or(facet), camera.toward).abs());
            let value = paint.values.as_ref().map(|(v, table)| (face.map(|i| v[i as usize]), table));
            self.each_sample(&at, |canvas, x, y, depth, w| {
                let mix = |x: &[f64; 3]| (0..3).map(|k| w[k] * x[k]).sum::<f64>();
                canvas.put(x, y, depth as f32, || {
                    let base = value.map_or(paint.base, |(v, table)| table.color(mix(&v)));
                    shade(base, mix(&light))
                });
            });
        }
        edges::draw(self, mesh, &normals, camera);
        Ok(())
    }

    /// Calls `put` with place, depth and barycentric coordinates for every sample that a triangle covers.
    fn each_sample(&mut self, at: &[[f64; 3]; 3], put: impl Fn(&mut Canvas, u32, u32, f64, [f64; 3])) {
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
    fn disc(&mut self, [cx, cy]: [f64; 2], radius: f64, put: impl Fn(&mut Canvas, u32, u32, f64)) {
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

    /// Round dots.
    fn points(
        &mut self,
        points: &[Point],
        paint: &Paint,
        camera: &Camera,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        // Large enough to close the surface that they lie on, as far as that is no more than a dot.
        let finite: Vec<Point> = points.iter().filter(|p| p.iter().all(|x| x.is_finite())).copied().collect();
        let radius = (camera.scale * spacing(&finite)).clamp(1.5, 16.0);
        for (i, p) in points.iter().enumerate() {
            if i % TASK == 0 && progress.cancelled() {
                return Err(Cancelled);
            }
            let [x, y, z] = camera.project(p);
            if !(x.is_finite() && y.is_finite()) {
                continue;
            }
            let values = paint.values.as_ref();
            let color = values.map_or(paint.base, |(v, table)| table.color(v[i]));
            let z = z + values.map_or(0.0, |(v, table)| table.forward(v[i], radius, camera.scale));
            // As cones: each sample belongs to the point whose middle is nearest, and none is lost under its neighbours.
            let tip = (z + radius) as f32;
            self.disc([x, y], radius, |canvas, px, py, square| {
                // Most points of a scan are behind others.
                if tip <= canvas.depth[(py * canvas.width + px) as usize] {
                    return;
                }
                let off = square.sqrt() / radius;
                let shade = 1.0 - RIM * off * off;
                canvas.put(px, py, (z + radius * (1.0 - off)) as f32, || {
                    color.map(|c| (f64::from(c) * shade + 0.5) as u8)
                });
            });
        }
        Ok(())
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

    /// How far a point of this value and `radius` comes forward, in samples: one out of tolerance lies over those within it
    /// that are up to a radius nearer, and where material is missing up to another one. `scale`: samples a millimetre.
    fn forward(&self, value: f64, radius: f64, scale: f64) -> f64 {
        match self.scale.tolerance {
            Some([lower, upper]) if value < lower || value > upper => {
                radius + (-value * scale).clamp(0.0, radius)
            }
            _ => 0.0,
        }
    }
}

/// Area-weighted; none on creases, and where the facets around cancel out.
fn smooth_normals(mesh: &Mesh) -> Vec<Option<Vector>> {
    let mut sums = vec![[0.0; 3]; mesh.positions.len()];
    let normal = |face: &[u32; 3]| {
        let corner =
            |k: usize| mesh.positions.get(face[k] as usize).filter(|p| p.iter().all(|x| x.is_finite()));
        let (a, b, c) = (corner(0)?, corner(1)?, corner(2)?);
        Some(cross(minus(*b, *a), minus(*c, *a)))
    };
    for face in &mesh.faces {
        let Some(n) = normal(face) else { continue };
        face.iter().for_each(|v| sums[*v as usize] = plus(sums[*v as usize], n));
    }
    let mut normals: Vec<Option<Vector>> = sums.into_iter().map(|n| unit(n).map(|(n, _)| n)).collect();
    let means = normals.clone();
    for face in &mesh.faces {
        let Some((n, _)) = normal(face).and_then(unit) else { continue };
        for v in face.map(|v| v as usize) {
            if means[v].is_some_and(|mean| dot(mean, n) < CREASE) {
                normals[v] = None;
            }
        }
    }
    normals
}

/// Diffuse light from the eye.
fn shade(color: [u8; 3], cosine: f64) -> [u8; 3] {
    let factor = DARKEST + (1.0 - DARKEST) * cosine.clamp(0.0, 1.0);
    color.map(|c| (f64::from(c) * factor + 0.5) as u8)
}
