//! Parts whose faces are known: a ring of sections, each a chain of corners, neighbors joined by two facets.

use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::shape::Shape;
use crate::space::{Point, Vector, cross, minus, norm, plus, times, unit};
use std::f64::consts::TAU;

/// A mesh, and for each facet the face that it was made of.
pub(in crate::segment) struct Part {
    pub mesh: Mesh,
    pub labels: Vec<usize>,
    pub faces: Vec<Shape>,
}

/// One stretch of a section: its corners but for the last, and its face.
type Stretch = (Vec<[f64; 2]>, usize);

fn straight(from: [f64; 2], to: [f64; 2], steps: usize, face: usize) -> Stretch {
    let at = |k: usize| {
        let t = k as f64 / steps as f64;
        [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])]
    };
    ((0..steps).map(at).collect(), face)
}

fn arc(center: [f64; 2], radius: f64, degrees: [f64; 2], steps: usize, face: usize) -> Stretch {
    let at = |k: usize| {
        let a = (degrees[0] + (degrees[1] - degrees[0]) * k as f64 / steps as f64).to_radians();
        [center[0] + radius * a.cos(), center[1] + radius * a.sin()]
    };
    ((0..steps).map(at).collect(), face)
}

const AXIS: Vector = [0.0, 0.0, 1.0];

/// A turned part: flange, cylinder, fillet, cone, ball. `turn` is the part of the full turn that is there.
pub(in crate::segment) fn turned(turn: f64, steps: usize) -> Part {
    let half_angle = 50f64.to_radians();
    let (sin, cos) = half_angle.sin_cos();
    // The cone leaves the fillet in the direction of its tangent.
    let foot = [10.0 - 4.0 * (1.0 - cos), 24.0 + 4.0 * sin];
    let top = [foot[0] - 7.0 * sin, foot[1] + 7.0 * cos];
    // A ball larger than the end of the cone, with its center on the axis.
    let radius = top[0] * 1.25;
    let center = top[1] + (radius * radius - top[0] * top[0]).sqrt();
    let start = ((top[1] - center) / radius).asin().to_degrees();
    let stretches = vec![
        straight([3.0, 0.0], [18.0, 0.0], 12, 0),
        straight([18.0, 0.0], [18.0, 6.0], 6, 1),
        straight([18.0, 6.0], [10.0, 6.0], 8, 2),
        straight([10.0, 6.0], [10.0, 24.0], 16, 3),
        arc([6.0, 24.0], 4.0, [0.0, 50.0], 10, 4),
        straight(foot, top, 10, 5),
        arc([0.0, center], radius, [start, 70.0], 20, 6),
    ];
    let tip = [radius * 70f64.to_radians().cos(), center + radius * 70f64.to_radians().sin()];
    let apex = [0.0, 0.0, foot[1] + foot[0] * cos / sin];
    let point = [0.0; 3];
    let faces = vec![
        Shape::Plane { point, normal: AXIS },
        Shape::Cylinder { point, direction: AXIS, radius: 18.0 },
        Shape::Plane { point: [0.0, 0.0, 6.0], normal: AXIS },
        Shape::Cylinder { point, direction: AXIS, radius: 10.0 },
        Shape::Torus { center: [0.0, 0.0, 24.0], direction: AXIS, major_radius: 6.0, minor_radius: 4.0 },
        Shape::Cone { apex, direction: [0.0, 0.0, -1.0], half_angle, point, radius: apex[2] * sin / cos },
        Shape::Sphere { center: [0.0, 0.0, center], radius },
    ];
    let around = |section: [f64; 2], k: usize| {
        let a = TAU * turn * k as f64 / steps as f64;
        [section[0] * a.cos(), section[0] * a.sin(), section[1]]
    };
    swept(&stretches, tip, steps, turn == 1.0, faces, |_, face| face, around)
}

/// A block of 40 × 40 × 12 with a bore of radius 8 through its middle.
pub(in crate::segment) fn bored(steps: usize) -> Part {
    // Across: 0 on the bore, 1 on the outside.
    let stretches = vec![
        straight([0.0, 0.0], [0.0, 12.0], 10, 0),
        straight([0.0, 12.0], [1.0, 12.0], 12, 1),
        straight([1.0, 12.0], [1.0, 0.0], 10, 3),
        straight([1.0, 0.0], [0.0, 0.0], 12, 2),
    ];
    let around = |[across, z]: [f64; 2], k: usize| {
        // Corners of the block are met where the number of steps is a multiple of 8.
        let a = TAU * (k as f64 / steps as f64);
        let (sin, cos) = a.sin_cos();
        let outside = 20.0 / sin.abs().max(cos.abs());
        let rho = 8.0 + across * (outside - 8.0);
        [rho * cos, rho * sin, z]
    };
    let face = |k: usize, face: usize| if face == 3 { 3 + (8 * k / steps).div_ceil(2) % 4 } else { face };
    let point = [0.0; 3];
    let plane = |point, normal| Shape::Plane { point, normal };
    let faces = vec![
        Shape::Cylinder { point, direction: AXIS, radius: 8.0 },
        plane([0.0, 0.0, 12.0], AXIS),
        plane(point, AXIS),
        plane([20.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        plane([0.0, 20.0, 0.0], [0.0, 1.0, 0.0]),
        plane([-20.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        plane([0.0, -20.0, 0.0], [0.0, 1.0, 0.0]),
    ];
    swept(&stretches, [0.0, 0.0], steps, true, faces, face, around)
}

/// A sleeve as a CAD system writes it: no corners but those of its four edges, and of the steps of a fillet at the bore's mouth. Where
/// the bore is the larger one it is the outside, and the fillet at its end.
pub(in crate::segment) fn sleeve(
    [bore, outside, length]: [f64; 3],
    fillet: Option<(f64, usize)>,
    steps: usize,
) -> Part {
    let point = [0.0; 3];
    let mut faces = vec![
        Shape::Cylinder { point, direction: AXIS, radius: bore },
        Shape::Plane { point, normal: AXIS },
        Shape::Cylinder { point, direction: AXIS, radius: outside },
        Shape::Plane { point: [0.0, 0.0, length], normal: AXIS },
    ];
    let mut stretches =
        vec![straight([bore, 0.0], [outside, 0.0], 1, 1), straight([outside, 0.0], [outside, length], 1, 2)];
    let top = length - fillet.map_or(0.0, |f| f.0);
    if let Some((radius, corners)) = fillet {
        let inwards = if bore < outside { 1.0 } else { -1.0 };
        let middle = bore + inwards * radius;
        stretches.push(straight([outside, length], [middle, length], 1, 3));
        stretches.push(arc([middle, top], radius, [90.0, 90.0 + inwards * 90.0], corners, 4));
        let center = [0.0, 0.0, top];
        let (major_radius, minor_radius) = (middle, radius);
        faces.push(Shape::Torus { center, direction: AXIS, major_radius, minor_radius });
    } else {
        stretches.push(straight([outside, length], [bore, length], 1, 3));
    }
    stretches.push(straight([bore, top], [bore, 0.0], 1, 0));
    let around = |[rho, z]: [f64; 2], k: usize| {
        let (sin, cos) = (TAU * k as f64 / steps as f64).sin_cos();
        [rho * cos, rho * sin, z]
    };
    swept(&stretches, [bore, 0.0], steps, true, faces, |_, face| face, around)
}

/// A bar of 100 mm whose section is a rectangle with corners of the given radius, of so many chords each; the faces are two ends, four
/// sides, those of no width left out, and four corners.
pub(in crate::segment) fn bar([width, height]: [f64; 2], radius: f64, chords: usize) -> Part {
    const LONG: f64 = 100.0;
    let [x, y] = [0.5 * width - radius, 0.5 * height - radius];
    let middles = [[x, y], [-x, y], [-x, -y], [x, -y]];
    let mut faces: Vec<Shape> =
        [0.0, LONG].map(|z| Shape::Plane { point: [0.0, 0.0, z], normal: AXIS }).to_vec();
    let mut section: Vec<([f64; 2], usize)> = vec![];
    for (quarter, middle) in middles.into_iter().enumerate() {
        let from = 90.0 * quarter as f64;
        let (corners, face) = arc(middle, radius, [from, from + 90.0], chords, faces.len());
        section.extend(corners.into_iter().map(|c| (c, face)));
        faces.push(Shape::Cylinder { point: [middle[0], middle[1], 0.0], direction: AXIS, radius });
        let (sin, cos) = (from + 90.0).to_radians().sin_cos();
        let (next, end) = (middles[(quarter + 1) % 4], [middle[0] + radius * cos, middle[1] + radius * sin]);
        if norm(minus([next[0], next[1], 0.0], [middle[0], middle[1], 0.0])) > 0.0 {
            section.push((end, faces.len()));
            faces.push(Shape::Plane { point: [end[0], end[1], 0.0], normal: [cos, sin, 0.0] });
        }
    }
    let count = section.len();
    let positions: Vec<Point> =
        [0.0, LONG].into_iter().flat_map(|z| section.iter().map(move |&([x, y], _)| [x, y, z])).collect();
    let (mut triangles, mut labels) = (Vec::new(), Vec::new());
    for (k, &(_, face)) in section.iter().enumerate() {
        let [a, b] = [k, (k + 1) % count];
        triangles.extend([[a, b, b + count], [a, b + count, a + count]]);
        labels.extend([face; 2]);
    }
    for k in 1..count - 1 {
        triangles.extend([[0, k + 1, k], [count, count + k, count + k + 1]]);
        labels.extend([0, 1]);
    }
    let faces_of = triangles.into_iter().map(|t: [usize; 3]| t.map(|v| v as u32)).collect();
    Part { mesh: Mesh { positions, faces: faces_of }, labels, faces }
}

/// Sections joined to a surface. `end` is the last corner; a section that comes back to where it began is closed.
fn swept(
    stretches: &[Stretch],
    end: [f64; 2],
    steps: usize,
    closed: bool,
    faces: Vec<Shape>,
    face: impl Fn(usize, usize) -> usize,
    around: impl Fn([f64; 2], usize) -> Point,
) -> Part {
    let mut section: Vec<([f64; 2], usize)> =
        stretches.iter().flat_map(|(corners, face)| corners.iter().map(|&c| (c, *face))).collect();
    let ring = section[0].0 == end;
    let rows = section.len();
    if !ring {
        section.push((end, 0));
    }
    let width = section.len();
    let columns = if closed { steps } else { steps + 1 };
    let positions: Vec<Point> = (0..columns)
        .flat_map(|k| section.iter().map(move |&(c, _)| (c, k)))
        .map(|(c, k)| around(c, k))
        .collect();
    let (mut triangles, mut labels) = (Vec::new(), Vec::new());
    for k in 0..steps {
        for (row, corner) in section.iter().enumerate().take(rows) {
            let at = |k: usize, row: usize| ((k % columns) * width + row % width) as u32;
            let [a, b, c, d] = [at(k, row), at(k + 1, row), at(k + 1, row + 1), at(k, row + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
            labels.extend([face(k, corner.1); 2]);
        }
    }
    Part { mesh: Mesh { positions, faces: triangles }, labels, faces }
}

impl Part {
    /// The same part with noise of the given standard deviation in each coordinate.
    pub(in crate::segment) fn noisy(mut self, sigma: f64, seed: u64) -> Part {
        let mut random = Random::new(seed);
        for p in &mut self.mesh.positions {
            for x in p {
                // Twelve uniform numbers less six: near enough to a normal one.
                *x += sigma * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
            }
        }
        self
    }
    /// The same part with its coordinates in single precision.
    pub(in crate::segment) fn single(mut self) -> Part {
        self.mesh.positions.iter_mut().flatten().for_each(|x| *x = f64::from(*x as f32));
        self
    }
    /// The same part elsewhere, and leaning.
    pub(in crate::segment) fn moved(mut self) -> Part {
        let (w, _) = unit([0.3, -0.5, 0.8]).unwrap();
        let (u, _) = unit(cross([1.0, 0.0, 0.0], w)).unwrap();
        let axes = [u, cross(w, u), w];
        let turn = |v: Vector| (0..3).fold([0.0; 3], |sum, k| plus(sum, times(v[k], axes[k])));
        let place = |p: Point| plus([130.0, -70.0, 55.0], turn(p));
        for p in &mut self.mesh.positions {
            *p = place(*p);
        }
        for shape in &mut self.faces {
            *shape = match *shape {
                Shape::Plane { point, normal } => Shape::Plane { point: place(point), normal: turn(normal) },
                Shape::Sphere { center, radius } => Shape::Sphere { center: place(center), radius },
                Shape::Cylinder { point, direction, radius } => {
                    Shape::Cylinder { point: place(point), direction: turn(direction), radius }
                }
                Shape::Cone { apex, direction, half_angle, point, radius } => Shape::Cone {
                    apex: place(apex),
                    direction: turn(direction),
                    half_angle,
                    point: place(point),
                    radius,
                },
                Shape::Torus { center, direction, major_radius, minor_radius } => Shape::Torus {
                    center: place(center),
                    direction: turn(direction),
                    major_radius,
                    minor_radius,
                },
                other => other,
            };
        }
        self
    }
}
