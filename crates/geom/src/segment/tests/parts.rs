//! Parts whose faces are known: a ring of sections, each a chain of corners, neighbors joined by two facets.

use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::shape::Shape;
use crate::space::{Point, Vector, cross, minus, norm, plus, times, unit};
use std::f64::consts::TAU;

/// A mesh, and for each facet the face that it was made of.
#[derive(Clone)]
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

/// A sleeve as a CAD system writes it. It has no corners but those of its four edges, and those of the steps of a fillet at the
/// bore's mouth. Where the bore is the larger one it is the outside, and the fillet at its end.
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

/// A bar of 100 mm whose section is a rectangle with corners of the given radius, of so many chords each. The faces are two
/// ends, four sides (those of no width left out), and four corners.
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
    prism(&section, LONG, faces)
}

/// A bar of 100 mm whose section is an ellipse of so many chords, between two planes.
pub(in crate::segment) fn elliptic(chords: usize) -> Part {
    let turn = |k: usize| (TAU * k as f64 / chords as f64).sin_cos();
    let section: Vec<([f64; 2], usize)> =
        (0..chords).map(turn).map(|(sin, cos)| ([20.0 * cos, 8.0 * sin], 2)).collect();
    let plane = |z| Shape::Plane { point: [0.0, 0.0, z], normal: AXIS };
    prism(&section, 100.0, vec![plane(0.0), plane(100.0)])
}

/// A round solid of two circles of corners, its ends without a corner inside.
pub(in crate::segment) fn round([below, above]: [f64; 2], long: f64, chords: usize) -> Part {
    let section: Vec<([f64; 2], usize)> = (0..chords)
        .map(|k| (TAU * k as f64 / chords as f64).sin_cos())
        .map(|(sin, cos)| ([below * cos, below * sin], 2))
        .collect();
    let plane = |z| Shape::Plane { point: [0.0, 0.0, z], normal: AXIS };
    let side = if below == above {
        Shape::Cylinder { point: [0.0; 3], direction: AXIS, radius: below }
    } else {
        let apex = [0.0, 0.0, long * below / (below - above)];
        let half_angle = ((below - above) / long).atan();
        Shape::Cone { apex, direction: [0.0, 0.0, -1.0], half_angle, point: [0.0; 3], radius: below }
    };
    let mut part = prism(&section, long, vec![plane(0.0), plane(long), side]);
    let upper = part.mesh.positions.iter_mut().filter(|p| p[2] > 0.0);
    upper.for_each(|p| (p[0], p[1]) = (p[0] * above / below, p[1] * above / below));
    part
}

/// A section, of corners and the faces that begin there, drawn along z between the first two faces.
fn prism(section: &[([f64; 2], usize)], long: f64, faces: Vec<Shape>) -> Part {
    let count = section.len();
    let positions: Vec<Point> =
        [0.0, long].into_iter().flat_map(|z| section.iter().map(move |&([x, y], _)| [x, y, z])).collect();
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

/// A box of the given half sides, before all its edges were rounded by so many chords: no edge is left. The faces are spheres, cylinders
/// and planes from below to above, then the planes below and above.
pub(in crate::segment) fn pebble(half: [f64; 3], radius: f64, chords: usize) -> Part {
    // Steps of an angle and the corner of the box that they are about; each corner ends where the next begins.
    let turns = |corners: usize, from: f64| -> Vec<(f64, usize)> {
        let at = move |c: usize, k: usize| (from + 90.0 * (c as f64 + k as f64 / chords as f64)).to_radians();
        (0..corners).flat_map(|c| (0..=chords).map(move |k| (at(c, k), c))).collect()
    };
    let (rows, columns) = (turns(2, -90.0), turns(4, 0.0));
    let middle = |row: usize, column: usize| -> Point {
        let sign = |positive: bool| if positive { 1.0 } else { -1.0 };
        let signs = [sign([0, 3].contains(&column)), sign(column < 2), sign(row == 1)];
        std::array::from_fn(|k| signs[k] * (half[k] - radius))
    };
    let positions: Vec<Point> = (rows.iter())
        .flat_map(|row| columns.iter().map(move |column| (row, column)))
        .map(|(&(up, row), &(turn, column))| {
            let way = [up.cos() * turn.cos(), up.cos() * turn.sin(), up.sin()];
            plus(middle(row, column), times(radius, way))
        })
        .collect();
    let (mut faces, mut triangles, mut labels) = (vec![], vec![], vec![]);
    let mut known: Vec<[usize; 4]> = vec![];
    for row in 0..rows.len() - 1 {
        for column in 0..columns.len() {
            let next = (column + 1) % columns.len();
            let of = [rows[row].1, rows[row + 1].1, columns[column].1, columns[next].1];
            let face = known.iter().position(|k| *k == of).unwrap_or_else(|| {
                known.push(of);
                let [one, other] = [middle(of[0], of[2]), middle(of[1], of[3])];
                let along = unit(minus(other, one)).map_or(AXIS, |u| u.0);
                let turn = columns[column].0;
                faces.push(match (of[0] == of[1], of[2] == of[3]) {
                    (true, true) => Shape::Sphere { center: one, radius },
                    (false, false) => {
                        let normal = [turn.cos().round(), turn.sin().round(), 0.0];
                        Shape::Plane { point: plus(one, times(radius, normal)), normal }
                    }
                    _ => Shape::Cylinder { point: one, direction: along, radius },
                });
                known.len() - 1
            });
            let at = |row: usize, column: usize| (row * columns.len() + column) as u32;
            let [a, b, c, d] = [at(row, column), at(row, next), at(row + 1, next), at(row + 1, column)];
            triangles.extend([[a, b, c], [a, c, d]]);
            labels.extend([face; 2]);
        }
    }
    for (row, z) in [(0, -half[2]), (rows.len() - 1, half[2])] {
        let [a, b, c, d] = [0, 1, 2, 3].map(|c| (row * columns.len() + c * (chords + 1)) as u32);
        triangles.extend(if row == 0 { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] });
        labels.extend([faces.len(); 2]);
        faces.push(Shape::Plane { point: [0.0, 0.0, z], normal: AXIS });
    }
    // Around the poles all points of a corner are one.
    let first =
        |v: u32| positions.iter().position(|p| norm(minus(*p, positions[v as usize])) < 1e-9).unwrap() as u32;
    let (triangles, labels) = (triangles.into_iter().map(|t: [u32; 3]| t.map(first)).zip(labels))
        .filter(|([a, b, c], _)| a != b && b != c && c != a)
        .unzip();
    Part { mesh: Mesh { positions, faces: triangles }, labels, faces }
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
