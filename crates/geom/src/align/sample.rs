//! The measured data as weighted points: every point stands for its share of the measured surface.
//!
//! Where a pose is looked for, a vertex of a mesh stands for a third of the area of its facets. A scan that is dense in one
//! place and thin in another is then not drawn towards the dense place. A large facet is represented by places spread over it
//! instead of its corners. In a mesh of few facets the surface lies between the vertices. A point of a cloud stands for itself.
//!
//! The pose itself is that of the surface: every facet is represented by its middle, or the middles of equal parts of it. The
//! corners make twice the variation within a facet of the square of a linear function, the middle makes none.

use crate::mesh::Mesh;
use crate::num::dense::eigen;
use crate::num::random::Random;
use crate::parallel::prelude::*;
use crate::scan::Scan;
use crate::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};
use crate::spatial::neighbors::PointTree;

/// The measured data that are brought to the reference, millimeters, in a frame of their own.
#[derive(Clone, Copy, Debug)]
pub enum Measured<'a> {
    /// A mesh with outward facets. Its surface is aligned: the middles of its facets, or of equal parts of large ones, each with
    /// their area as its weight.
    Mesh(&'a Mesh),
    /// Points, each of the same weight.
    Points {
        /// Places, millimeters.
        points: &'a [Point],
        /// Outward unit normals, as many; without them any side of the reference will do.
        normals: Option<&'a [Vector]>,
    },
}

impl<'a> From<&'a Scan> for Measured<'a> {
    fn from(scan: &'a Scan) -> Measured<'a> {
        match scan {
            Scan::Mesh(mesh) => Measured::Mesh(mesh),
            Scan::Cloud(points) => Measured::Points { points, normals: None },
        }
    }
}

impl Measured<'_> {
    /// All points, in their order.
    pub fn points(&self) -> &[Point] {
        match self {
            Measured::Mesh(mesh) => &mesh.positions,
            Measured::Points { points, .. } => points,
        }
    }
}

/// Weighted points with normals.
#[derive(Clone, Debug, Default)]
pub(super) struct Samples {
    pub points: Vec<Point>,
    /// As many unit normals, zero where there is none; nothing at all where none are known.
    pub normals: Vec<Vector>,
    /// Positive, of sum 1.
    pub weights: Vec<f64>,
    /// Whether the normals tell outside from inside.
    pub oriented: bool,
}

/// Neighbors that make the normal of a point of a cloud.
const NORMAL_NEIGHBORS: usize = 16;
/// Most points among which these neighbors are looked for.
const MAX_NEIGHBOR_POINTS: usize = 100_000;

impl Samples {
    /// All that is measured. Vertices that no facet uses are left out.
    pub fn all(measured: &Measured) -> Samples {
        Samples::of(measured, SAMPLED_FACET_SHARE)
    }

    /// The points that were measured: of a mesh its vertices alone, however large their facets. Decisions by the worst place
    /// look at these.
    pub fn vertices(measured: &Measured) -> Samples {
        Samples::of(measured, f64::INFINITY)
    }

    /// As [`Samples::all`]; facets beyond this share of the whole area are represented by places on them.
    fn of(measured: &Measured, large: f64) -> Samples {
        let mut samples = match measured {
            Measured::Mesh(mesh) => of_mesh(mesh, large),
            Measured::Points { points, normals } => Samples {
                points: points.to_vec(),
                normals: normals.map(<[Vector]>::to_vec).unwrap_or_default(),
                weights: vec![1.0; points.len()],
                oriented: normals.is_some(),
            },
        };
        let total: f64 = samples.weights.iter().sum();
        samples.weights.iter_mut().for_each(|w| *w /= total);
        samples
    }

    /// The surface of what is measured: places spread over all facets; of a cloud its points.
    pub fn of_surface(measured: &Measured) -> Samples {
        let Measured::Mesh(mesh) = measured else { return Samples::all(measured) };
        let mut samples = Samples { oriented: true, ..Samples::default() };
        samples.points.reserve(mesh.faces.len());
        samples.normals.reserve(mesh.faces.len());
        samples.weights.reserve(mesh.faces.len());
        let total: f64 = mesh.faces.iter().map(|f| norm(double_area(mesh, f))).sum();
        for face in &mesh.faces {
            let double = double_area(mesh, face);
            let parts = side_parts(double, total);
            samples.spread(mesh.places(face), double, parts);
        }
        samples.weights.iter_mut().for_each(|w| *w /= total);
        samples
    }

    /// The facet of each sample of [`Samples::of_surface`].
    pub fn facets(mesh: &Mesh) -> Vec<u32> {
        let total: f64 = mesh.faces.iter().map(|f| norm(double_area(mesh, f))).sum();
        let mut facets = vec![];
        for (number, face) in mesh.faces.iter().enumerate() {
            let double = double_area(mesh, face);
            if unit(double).is_some() {
                let rows = side_parts(double, total).ceil() as usize;
                facets.extend(std::iter::repeat_n(number as u32, rows * rows));
            }
        }
        facets
    }

    fn push(&mut self, point: Point, normal: Vector, weight: f64) {
        self.points.push(point);
        self.normals.push(normal);
        self.weights.push(weight);
    }

    /// Adds the middles of the equal parts of a facet, each side being cut into at least `parts`. The sum over them is exact
    /// for functions that are linear on the facet.
    fn spread(&mut self, [a, b, c]: [Point; 3], double: Vector, parts: f64) {
        let Some((normal, size)) = unit(double) else { return };
        let n = parts.ceil();
        let (u, v) = (minus(b, a), minus(c, a));
        let weight = size / (n * n);
        let rows = n as u32;
        for i in 0..rows {
            for j in 0..rows - i {
                let mut add = |third: f64| {
                    let (s, t) = ((f64::from(i) + third) / n, (f64::from(j) + third) / n);
                    self.push(plus(a, plus(times(s, u), times(t, v))), normal, weight);
                };
                add(1.0 / 3.0);
                if i + j + 1 < rows {
                    add(2.0 / 3.0);
                }
            }
        }
    }

    /// About `count` of them, spread evenly by weight and equal in weight; all where there are no more. They are taken in
    /// random order.
    pub fn thinned(&self, count: usize, seed: u64) -> Samples {
        let random = &mut Random::new(seed);
        let mut chosen: Vec<usize> = Vec::with_capacity(count);
        if self.points.len() <= count {
            chosen.extend(0..self.points.len());
        } else {
            // The places i + 1/2 of a ruler of `count` marks, laid along the weights one after the other.
            let (mut sum, mut next) = (0.0, 0.5 / count as f64);
            for (i, w) in self.weights.iter().enumerate() {
                sum += w;
                if next <= sum {
                    chosen.push(i);
                    next = ((sum * count as f64 - 0.5).floor() + 1.5) / count as f64;
                }
            }
        }
        shuffle(&mut chosen, random);
        let whole = self.points.len() <= count;
        let weights: Vec<f64> =
            chosen.iter().map(|&i| if whole { self.weights[i] } else { 1.0 / chosen.len() as f64 }).collect();
        Samples { weights, ..self.those(&chosen) }
    }

    /// The ones of these numbers, in this order, with the weights that they have.
    pub fn those(&self, chosen: &[usize]) -> Samples {
        let normals = match self.normals.is_empty() {
            true => vec![],
            false => chosen.iter().map(|&i| self.normals[i]).collect(),
        };
        Samples {
            points: chosen.iter().map(|&i| self.points[i]).collect(),
            normals,
            weights: chosen.iter().map(|&i| self.weights[i]).collect(),
            oriented: self.oriented,
        }
    }

    /// The first `count` of them, of equal weight as they are: of thinned ones these are any.
    pub fn first(&self, count: usize) -> Samples {
        let count = count.min(self.points.len());
        let total: f64 = self.weights[..count].iter().sum();
        Samples {
            points: self.points[..count].to_vec(),
            normals: self.normals[..count.min(self.normals.len())].to_vec(),
            weights: self.weights[..count].iter().map(|w| w / total).collect(),
            oriented: self.oriented,
        }
    }

    /// About `count` of them, as [`Samples::thinned`], with normals: where there are none, by local planes, without sides. A
    /// part of a dense cloud makes the planes: its nearest neighbors scatter more than they lie apart.
    pub fn oriented_subset(&self, count: usize, seed: u64) -> Samples {
        let mut oriented_subset = self.thinned(count, seed);
        if oriented_subset.normals.is_empty() {
            let part = (self.points.len() > MAX_NEIGHBOR_POINTS)
                .then(|| self.thinned(MAX_NEIGHBOR_POINTS, seed).points);
            let among = part.as_ref().unwrap_or(&self.points);
            let tree = PointTree::new(among);
            oriented_subset.normals =
                oriented_subset.points.par_iter().map(|p| local_normal(p, among, &tree)).collect();
        }
        oriented_subset
    }

    /// The same with every normal turned round.
    pub fn turned(&self) -> Samples {
        Samples { normals: self.normals.iter().map(|n| times(-1.0, *n)).collect(), ..self.clone() }
    }

    /// Their mirror image: x reversed. Outward normals stay outward.
    pub fn mirrored(&self) -> Samples {
        let image = |all: &[Vector]| all.iter().map(|[x, y, z]| [-x, *y, *z]).collect();
        Samples { points: image(&self.points), normals: image(&self.normals), ..self.clone() }
    }

    /// The same `factor` times as large.
    pub fn scaled(&self, factor: f64) -> Samples {
        Samples { points: self.points.iter().map(|p| times(factor, *p)).collect(), ..self.clone() }
    }

    /// Weighted mean and second moments about it.
    pub fn moments(&self) -> Moments {
        Moments::of(self.points.iter().copied().zip(self.weights.iter().copied()))
    }
}

/// Where points lie and how they spread.
pub(super) struct Moments {
    pub mean: Point,
    /// Variances along the principal axes, least first.
    pub variances: [f64; 3],
    /// The principal axes, a right-handed frame.
    pub axes: [Vector; 3],
}

impl Moments {
    /// The moments of weighted points.
    pub fn of(points: impl Iterator<Item = (Point, f64)> + Clone) -> Moments {
        let (mut mean, mut total) = ([0.0; 3], 0.0);
        for (p, w) in points.clone() {
            mean = plus(mean, times(w, p));
            total += w;
        }
        mean = times(1.0 / total, mean);
        let mut spread = [[0.0; 3]; 3];
        for (p, w) in points {
            let q = minus(p, mean);
            for i in 0..3 {
                for j in 0..3 {
                    spread[i][j] += w / total * q[i] * q[j];
                }
            }
        }
        let (variances, mut axes) = eigen(spread);
        axes[2] = cross(axes[0], axes[1]);
        Moments { mean, variances, axes }
    }

    /// Root mean square distance from the mean.
    pub fn radius(&self) -> f64 {
        self.variances.iter().sum::<f64>().max(0.0).sqrt()
    }
}

/// The direction in which the nearest neighbors spread least; zero where they lie on a line.
fn local_normal(p: &Point, among: &[Point], tree: &PointTree) -> Vector {
    let near = tree.k_nearest(p, NORMAL_NEIGHBORS, None);
    let moments = Moments::of(near.iter().map(|n| (among[n.1 as usize], 1.0)));
    if moments.variances[1] > 1e-6 * moments.variances[2] { moments.axes[0] } else { [0.0; 3] }
}

/// Share of the whole area above which a facet is represented by places on it.
const SAMPLED_FACET_SHARE: f64 = 1.0 / 1000.0;
/// Largest share of the whole area that each of these places stands for.
const FACET_PART_SHARE: f64 = 1.0 / 4000.0;
/// No place of the surface stands for more than this share of the area.
const MAX_PLACE_SHARE: f64 = 1.0 / 50_000.0;

/// Parts into which the sides of a facet are cut where the whole surface is represented.
fn side_parts(double: Vector, total: f64) -> f64 {
    (norm(double) / (MAX_PLACE_SHARE * total)).sqrt()
}

fn of_mesh(mesh: &Mesh, large: f64) -> Samples {
    let mut normals = vec![[0.0; 3]; mesh.positions.len()];
    let mut areas = vec![0.0; mesh.positions.len()];
    let mut samples = Samples { oriented: true, ..Samples::default() };
    let total: f64 = mesh.faces.iter().map(|f| norm(double_area(mesh, f))).sum();
    for face in &mesh.faces {
        let double = double_area(mesh, face);
        let size = norm(double);
        if size > large * total {
            let parts = (size / (FACET_PART_SHARE * total)).sqrt();
            samples.spread(mesh.places(face), double, parts);
            continue;
        }
        for &v in face {
            normals[v as usize] = plus(normals[v as usize], double);
            areas[v as usize] += size / 3.0;
        }
    }
    for ((p, n), a) in mesh.positions.iter().zip(normals).zip(areas) {
        if a > 0.0 {
            samples.push(*p, unit(n).map_or([0.0; 3], |n| n.0), a);
        }
    }
    samples
}

fn double_area(mesh: &Mesh, face: &[u32; 3]) -> Vector {
    let [a, b, c] = mesh.places(face);
    cross(minus(b, a), minus(c, a))
}

/// `count` places on a mesh, spread by area, with the normals of their facets, of equal weight and in random order.
pub(super) fn on_surface(mesh: &Mesh, count: usize, seed: u64) -> Samples {
    let random = &mut Random::new(seed);
    let areas: Vec<f64> = mesh.faces.iter().map(|f| norm(double_area(mesh, f))).collect();
    let total: f64 = areas.iter().sum();
    let (mut sum, mut next) = (0.0, random.unit());
    let mut found: Vec<(Point, Vector)> = Vec::with_capacity(count);
    for (face, area) in mesh.faces.iter().zip(&areas) {
        sum += area / total * count as f64;
        while next <= sum && found.len() < count {
            let [a, b, c] = mesh.places(face);
            let (root, t) = (random.unit().sqrt(), random.unit());
            let p = plus(plus(times(1.0 - root, a), times(root * (1.0 - t), b)), times(root * t, c));
            if let Some((n, _)) = unit(double_area(mesh, face)) {
                found.push((p, n));
            }
            next += 1.0;
        }
    }
    shuffle(&mut found, random);
    let weights = vec![1.0 / found.len() as f64; found.len()];
    let (points, normals) = found.into_iter().unzip();
    Samples { points, normals, weights, oriented: true }
}

/// The area of a mesh.
pub(super) fn area(mesh: &Mesh) -> f64 {
    mesh.faces.iter().map(|f| 0.5 * norm(double_area(mesh, f))).sum()
}

/// Fisher and Yates.
fn shuffle<T>(items: &mut [T], random: &mut Random) {
    for i in (1..items.len()).rev() {
        items.swap(i, random.below(i as u64 + 1) as usize);
    }
}

/// Whether two normals agree within the angle of this cosine; a zero normal agrees with all.
#[inline(always)]
pub(super) fn agree(a: Vector, b: Vector, oriented: bool, cosine: f64) -> bool {
    let c = dot(a, b);
    a == [0.0; 3] || (if oriented { c } else { c.abs() }) >= cosine
}
