//! Meshes and points drawn in the colors of their values.

use super::camera::Camera;
use super::canvas::{Band, Canvas};
use super::edges::{self, smooth_normals};
use trueness_document::scale::palette::Rgb;
use trueness_document::scale::{NO_VALUE, Scale};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, Vector, cross, dot, minus, unit};
use trueness_measure::spacing::spacing;

/// Least brightness of a surface seen edge-on.
const MIN_BRIGHTNESS: f64 = 0.72;
/// How much darker than its middle a point is at its rim, which tells points apart.
const RIM_DARKENING: f64 = 0.2;
/// Places prepared at a time, in parallel, before they are drawn in their order.
const PLACES_PER_TASK: usize = 1 << 15;
/// Places drawn between two questions whether to go on.
const PLACES_PER_QUESTION: usize = 16;

/// What an object is colored by: its values where it has some, else its own color.
pub struct Paint<'a> {
    pub base: Rgb,
    /// Lines along its edges, where they are known; else they are found between facets.
    pub edges: Option<&'a [Vec<Point>]>,
    pub values: Option<(&'a [f64], Colors<'a>)>,
}

impl Canvas {
    /// Triangles with a missing or non-finite corner are passed over; one without all three values is drawn as no value.
    pub fn mesh(
        &mut self,
        mesh: &Mesh,
        paint: &Paint,
        camera: &Camera,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        let normals = smooth_normals(mesh);
        let values = paint.values.as_ref();
        for faces in mesh.faces.chunks(PLACES_PER_TASK) {
            let seen: Vec<Facet> = faces
                .par_iter()
                .filter_map(|face| Facet::of(mesh, &normals, face, values.map(|(v, _)| *v), camera))
                .collect();
            self.bands().try_for_each(|mut band| {
                for (n, facet) in seen.iter().enumerate() {
                    if n % PLACES_PER_QUESTION == 0 && progress.cancelled() {
                        return Err(Cancelled);
                    }
                    if !band.meets(facet.rows) {
                        continue;
                    }
                    band.each_sample(&facet.at, |band, x, y, depth, w| {
                        let mix = |x: &[f64; 3]| (0..3).map(|k| w[k] * x[k]).sum::<f64>();
                        band.put(x, y, depth as f32, || {
                            let base =
                                values.map_or(paint.base, |(_, table)| table.color(mix(&facet.values)));
                            shade(base, mix(&facet.light))
                        });
                    });
                }
                Ok(())
            })?;
        }
        let edges = paint.edges.map_or_else(|| edges::sharp(mesh, &normals), edges::segments);
        edges::draw(self, mesh, &edges, camera);
        Ok(())
    }

    /// Round dots.
    pub fn points(
        &mut self,
        points: &[Point],
        paint: &Paint,
        camera: &Camera,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        // Large enough to close the surface that they lie on, as far as that is no more than a dot.
        let finite: Vec<Point> = points.iter().filter(|p| p.iter().all(|x| x.is_finite())).copied().collect();
        let radius = (camera.scale * spacing(&finite)).clamp(1.5, 16.0);
        let values = paint.values.as_ref();
        let dot = |(i, p): (usize, &Point)| {
            let [x, y, z] = camera.project(p);
            let z = z + values.map_or(0.0, |(v, table)| table.forward(v[i], radius, camera.scale));
            let color = values.map_or(paint.base, |(v, table)| table.color(v[i]));
            (x.is_finite() && y.is_finite()).then_some(([x, y, z], color))
        };
        for (n, part) in points.chunks(PLACES_PER_TASK).enumerate() {
            let dots: Vec<([f64; 3], Rgb)> =
                part.par_iter().enumerate().filter_map(|(i, p)| dot((n * PLACES_PER_TASK + i, p))).collect();
            self.bands().try_for_each(|mut band| {
                for (n, ([x, y, z], color)) in dots.iter().enumerate() {
                    if n % PLACES_PER_QUESTION == 0 && progress.cancelled() {
                        return Err(Cancelled);
                    }
                    if band.meets([y - radius, y + radius]) {
                        band.cone([*x, *y, *z], radius, *color);
                    }
                }
                Ok(())
            })?;
        }
        Ok(())
    }
}

impl Band<'_> {
    /// A point as a cone: each sample belongs to the point whose middle is nearest, and none is lost under its neighbors.
    fn cone(&mut self, [x, y, z]: [f64; 3], radius: f64, color: Rgb) {
        let tip = (z + radius) as f32;
        self.disc([x, y], radius, |band, px, py, square| {
            // Most points of a scan are behind others.
            if tip <= band.depth[band.at(px, py)] {
                return;
            }
            let off = square.sqrt() / radius;
            let shade = 1.0 - RIM_DARKENING * off * off;
            band.put(px, py, (z + radius * (1.0 - off)) as f32, || {
                color.map(|c| (f64::from(c) * shade + 0.5) as u8)
            });
        });
    }
}

/// A facet on its way into the picture.
struct Facet {
    /// Its corners in samples.
    at: [[f64; 3]; 3],
    /// The rows that it reaches over.
    rows: [f64; 2],
    /// Brightness at the corners.
    light: [f64; 3],
    /// Values at the corners, where there are any.
    values: [f64; 3],
}

impl Facet {
    /// None where a corner is missing or not finite, or the facet has no area.
    fn of(
        mesh: &Mesh,
        normals: &[Option<Vector>],
        face: &[u32; 3],
        values: Option<&[f64]>,
        camera: &Camera,
    ) -> Option<Facet> {
        let corner =
            |k: usize| mesh.positions.get(face[k] as usize).filter(|p| p.iter().all(|x| x.is_finite()));
        let (a, b, c) = (corner(0)?, corner(1)?, corner(2)?);
        let (facet, _) = unit(cross(minus(*b, *a), minus(*c, *a)))?;
        let at = [a, b, c].map(|p| camera.project(p));
        // A facet on a crease is as flat in the picture as it is.
        let smooth = face.map(|v| normals[v as usize]);
        let smooth = smooth.map(|n| n.filter(|n| dot(*n, facet) > 0.0));
        let smooth = if smooth.iter().all(Option::is_some) { smooth } else { [None; 3] };
        Some(Facet {
            at,
            rows: [at[0][1].min(at[1][1]).min(at[2][1]), at[0][1].max(at[1][1]).max(at[2][1])],
            light: smooth.map(|n| dot(n.unwrap_or(facet), camera.toward).abs()),
            values: values.map_or([0.0; 3], |v| face.map(|i| v[i as usize])),
        })
    }
}

/// A scale looked up once, not once a pixel.
pub struct Colors<'a> {
    scale: &'a Scale,
    limits: Vec<f64>,
    colors: Vec<[u8; 3]>,
}

impl Colors<'_> {
    pub fn of(scale: &Scale) -> Colors<'_> {
        Colors { scale, limits: scale.limits(), colors: scale.colors() }
    }

    fn color(&self, value: f64) -> [u8; 3] {
        if value.is_nan() {
            return NO_VALUE;
        }
        match self.scale.mode {
            trueness_document::scale::Mode::Continuous => self.scale.color(value),
            _ => self.colors[trueness_document::scale::slot(&self.limits, value)],
        }
    }

    /// How far a point of this value and `radius` comes forward, in samples: one out of tolerance lies over those within it
    /// that are up to a radius nearer, and where material is missing up to another one. `scale`: samples a millimeter.
    fn forward(&self, value: f64, radius: f64, scale: f64) -> f64 {
        match self.scale.tolerance {
            Some([lower, upper]) if value < lower || value > upper => {
                radius + (-value * scale).clamp(0.0, radius)
            }
            _ => 0.0,
        }
    }
}

/// Diffuse light from the eye.
fn shade(color: [u8; 3], cosine: f64) -> [u8; 3] {
    let factor = MIN_BRIGHTNESS + (1.0 - MIN_BRIGHTNESS) * cosine.clamp(0.0, 1.0);
    color.map(|c| (f64::from(c) * factor + 0.5) as u8)
}
