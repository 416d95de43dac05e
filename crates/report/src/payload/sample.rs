//! How finely objects can be packed for the room there is, told from a part of each that is packed as the whole will be.
//!
//! How many bytes a place takes depends on how evenly the places lie and on the noise of the values. So no constant is near for all. The
//! part is some of the cells of a coarse grid: within them places lie as densely as in the whole.

use super::super::no_value::NoValue;
use super::super::{Geometry, ReportError, ViewField, ViewObject};
use super::mesh;
use super::packed::{LEVEL_BYTES, MAX_DRAWN_POINTS, Purpose, Quality, coarse_grid_is_fine, pack_object};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point};

/// Places of an object up to which it is packed whole.
const MAX_PLACES_WHOLE: usize = 50_000;
/// Cells along each side of the box.
const CELLS_PER_SIDE: usize = 4;
/// One of so many cells is taken.
const CELLS_PER_SAMPLE: usize = 13;
/// So many times its share a part takes, as it has rims.
const RIM_FACTOR: f64 = 1.065;
/// Of what would just fit, so that it does.
const SAMPLED_ROOM_SHARE: f64 = 0.97;
/// So many times the room, by what is usual, and it is certain that all fits, or that it does not.
const CERTAIN_ROOM_SHARES: [f64; 2] = [0.6, 1.4];

/// The quality in which `objects` fit into `budget` bytes of base64, but for a few percent.
pub fn quality(
    all: Quality,
    objects: &[ViewObject],
    purpose: &Purpose,
    budget: usize,
) -> Result<Quality, ReportError> {
    let usual = |bits| objects.iter().map(|o| usual_bytes(o, bits)).sum::<f64>() / budget.max(1) as f64;
    if usual(16) <= CERTAIN_ROOM_SHARES[0] {
        return Ok(all);
    }
    let samples: Vec<Sample> = objects.par_iter().map(Sample::of).collect();
    let room = SAMPLED_ROOM_SHARE * budget as f64;
    let packed = |quality: Quality| -> Result<Vec<f64>, ReportError> {
        let bytes = |(object, sample): (&ViewObject, &Sample)| {
            let packed =
                pack_object(&sample.object(object), (0, true), purpose, quality.times(sample.share))?;
            let rims = if sample.share < 1.0 { RIM_FACTOR } else { 1.0 };
            Ok(packed.part.len() as f64 / (rims * sample.share))
        };
        objects.par_iter().zip(&samples).map(bytes).collect()
    };
    // Bytes of all objects in a share of the quality in which they have so many each.
    let total = |bytes: &[f64], quality: Quality, share: f64| -> f64 {
        let of = |(object, bytes): (&ViewObject, &f64)| {
            let (had, _) = kept(object, quality);
            let (has, levels) = kept(object, quality.times(share).at_most(all));
            bytes * has as f64 / had.max(1) as f64 + levels as f64
        };
        objects.iter().zip(bytes).map(of).sum()
    };
    if usual(16) <= CERTAIN_ROOM_SHARES[1] && total(&packed(all)?, all, 1.0) <= room {
        return Ok(all);
    }
    let bits = if objects.iter().all(coarse_grid_is_fine) { 14 } else { 16 };
    let quality = Quality { bits, ..all.times((1.0 / usual(bits)).min(1.0)) };
    let bytes = packed(quality)?;
    // The largest share that fits: the bytes rise with it.
    let (mut low, mut high) = (0.0, 2.0 * usual(bits).max(1.0));
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        *(if total(&bytes, quality, middle) <= room { &mut low } else { &mut high }) = middle;
    }
    Ok(quality.times(low).at_most(all))
}

/// Points or triangles of an object that are kept, and bytes of its coarser levels.
fn kept(object: &ViewObject, quality: Quality) -> (usize, usize) {
    match object.geometry {
        Geometry::Points(points) => (points.len().min(quality.points), 0),
        Geometry::Mesh(mesh) => {
            let triangles = mesh.faces.len().min(quality.triangles);
            (triangles, mesh::level_sizes(triangles).sum::<usize>() * LEVEL_BYTES)
        }
    }
}

/// Bytes of base64 that an object usually takes; measured on scans of figures. A wrong guess costs time only.
fn usual_bytes(object: &ViewObject, bits: u32) -> f64 {
    const FIELD_BYTES: f64 = 2.6;
    const TRIANGLE_BYTES: f64 = 1.1;
    let place = if bits == 16 { 6.0 } else { 5.0 } + FIELD_BYTES * object.fields.len() as f64;
    match object.geometry {
        Geometry::Points(points) => points.len().min(MAX_DRAWN_POINTS) as f64 * place,
        Geometry::Mesh(mesh) => {
            let triangles = mesh.faces.len();
            let levels = mesh::level_sizes(triangles).sum::<usize>() * LEVEL_BYTES;
            triangles as f64 * (TRIANGLE_BYTES + 0.5 * place) + levels as f64
        }
    }
}

/// A part of an object.
struct Sample {
    places: Own,
    values: Vec<Vec<f64>>,
    reasons: Vec<Vec<NoValue>>,
    /// How much of the whole it is, of points or of facets.
    share: f64,
}

/// Places of its own.
enum Own {
    Points(Vec<Point>),
    Mesh(Mesh),
}

impl Sample {
    fn of(object: &ViewObject) -> Sample {
        let places = object.places();
        let taken = taken(places);
        let mut chosen: Vec<u32> = vec![];
        let (own, share) = match object.geometry {
            Geometry::Points(points) => {
                chosen.extend((0u32..).zip(points).filter(|(_, p)| taken(p)).map(|(i, _)| i));
                let own = chosen.iter().map(|i| points[*i as usize]).collect();
                (Own::Points(own), chosen.len() as f64 / points.len().max(1) as f64)
            }
            Geometry::Mesh(mesh) => {
                let mut numbers = vec![u32::MAX; places.len()];
                let within = |f: &&[u32; 3]| {
                    f.iter().all(|v| (*v as usize) < places.len()) && taken(&places[f[0] as usize])
                };
                let mut number = |v: u32| {
                    let number = &mut numbers[v as usize];
                    if *number == u32::MAX {
                        *number = chosen.len() as u32;
                        chosen.push(v);
                    }
                    *number
                };
                let faces: Vec<[u32; 3]> =
                    mesh.faces.iter().filter(within).map(|f| f.map(&mut number)).collect();
                let share = faces.len() as f64 / mesh.faces.len().max(1) as f64;
                let positions = chosen.iter().map(|v| places[*v as usize]).collect();
                (Own::Mesh(Mesh { positions, faces }), share)
            }
        };
        let at =
            |f: &ViewField| -> (Vec<f64>, Vec<NoValue>) { chosen.iter().map(|i| f.at(*i as usize)).unzip() };
        let (values, reasons) = object.fields.iter().map(at).unzip();
        // Of nothing nothing can be told; what is packed at all then counts as it is.
        Sample { places: own, values, reasons, share: if share > 0.0 { share } else { 1.0 } }
    }

    fn object<'a>(&'a self, whole: &ViewObject<'a>) -> ViewObject<'a> {
        let field = |(n, f): (usize, &ViewField)| ViewField {
            comparison: f.comparison,
            values: &self.values[n],
            reasons: &self.reasons[n],
        };
        ViewObject {
            role: whole.role,
            name: whole.name,
            color: whole.color,
            comparison: whole.comparison,
            geometry: match &self.places {
                Own::Points(points) => Geometry::Points(points),
                Own::Mesh(mesh) => Geometry::Mesh(mesh),
            },
            fields: whole.fields.iter().enumerate().map(field).collect(),
            keep: &[],
            gathered: whole.gathered,
            faces: None,
        }
    }
}

/// Whether a place lies in one of the cells that are taken.
fn taken(places: &[Point]) -> impl Fn(&Point) -> bool {
    let bounds = Aabb::of(places.iter().filter(|p| p.iter().all(|x| x.is_finite())));
    let cell = move |p: &Point| {
        let along = |k: usize| {
            let share = (p[k] - bounds.min[k]) / (bounds.max[k] - bounds.min[k]);
            ((share * CELLS_PER_SIDE as f64) as usize).min(CELLS_PER_SIDE - 1)
        };
        along(0) + CELLS_PER_SIDE * (along(1) + CELLS_PER_SIDE * along(2))
    };
    let mut used = [false; CELLS_PER_SIDE * CELLS_PER_SIDE * CELLS_PER_SIDE];
    places.iter().for_each(|p| used[cell(p)] = true);
    let every = if places.len() <= MAX_PLACES_WHOLE {
        1
    } else {
        CELLS_PER_SAMPLE.min(used.iter().filter(|u| **u).count().max(1))
    };
    let ranks: Vec<usize> =
        used.iter().scan(0, |rank, u| Some(std::mem::replace(rank, *rank + usize::from(*u)))).collect();
    move |p| ranks[cell(p)] % every == every / 2
}

#[cfg(test)]
mod tests {
    use super::super::super::ViewRole;
    use super::*;
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;

    /// Bytes of clouds and of surfaces with and without noise are told to within a tenth, so that nothing is packed twice.
    #[test]
    fn a_part_tells_what_the_whole_takes() {
        let mut random = Random::new(11);
        for noise in [0.0, 0.3] {
            const SIDE: u32 = 400;
            let mut positions: Vec<Point> = vec![];
            let mut values = vec![];
            for (i, j) in (0..=SIDE).flat_map(|i| (0..=SIDE).map(move |j| (f64::from(i), f64::from(j)))) {
                let mut off = || noise * (random.unit() - 0.5);
                positions.push([i + off(), j + off(), 9.0 * (0.05 * i).sin() * (0.04 * j).cos() + off()]);
                values.push(0.1 * (0.03 * i).sin() + 0.1 * off());
            }
            let at = |i: u32, j: u32| i * (SIDE + 1) + j;
            let squares = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j)));
            let faces = squares.flat_map(|(i, j)| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                [[a, b, c], [a, c, d]]
            });
            let mesh = Mesh { faces: faces.collect(), positions };
            let object = |geometry| ViewObject {
                role: ViewRole::Part,
                fields: vec![ViewField { comparison: 0, values: &values, reasons: &[] }],
                geometry,
                ..ViewObject::measured(&[])
            };
            for geometry in [Geometry::Mesh(&mesh), Geometry::Points(&mesh.positions)] {
                let objects = [object(geometry)];
                let purpose = Purpose { ranges: &[0.2], zone: None, progress: &Silent };
                for budget in [300_000, 700_000] {
                    let quality = quality(Quality::all(&objects), &objects, &purpose, budget).unwrap();
                    let packed = pack_object(&objects[0], (0, true), &purpose, quality).unwrap();
                    let share = packed.expected() as f64 / budget as f64;
                    let all = quality.points.max(quality.triangles) >= Quality::all(&objects).points;
                    assert!(share <= 1.0 && (all || share > 0.88), "{share} of {budget}, noise {noise}");
                }
            }
        }
    }
}
