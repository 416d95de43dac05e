//! A mesh laid within a circle: each vertex is a mean of its neighbors.
//!
//! With weights above 0 and the rim on a convex line no facet turns over, whatever the mesh. (Tutte, How to draw a
//! graph, Proceedings of the London Mathematical Society 13, 1963). A flat mesh keeps its shape with the weights of
//! Floater, Mean value coordinates, Computer Aided Geometric Design 20, 2003. Holes are closed by a fan of facets
//! around their middle.

use super::disc::Disc;
use super::triangle::{Triangle, length};
use std::f64::consts::TAU;
use trueness_geom::num::multigrid::Multigrid;
use trueness_geom::num::sparse::Sparse;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, minus, norm, plus, times};

/// Residual that the solver may leave in the equations.
const MEAN_VALUE_ACCURACY: f64 = 1e-13;

/// Length of an edge of the rim at least, as a share of their mean.
const MIN_RIM_EDGE_SHARE: f64 = 1e-6;

/// Places of the vertices within the circle around the origin that has the area of the mesh, the rim on it by its length.
pub(super) fn within_circle(
    positions: &[Point],
    disc: &Disc,
    area: f64,
    progress: &dyn Progress,
) -> Result<Vec<[f64; 2]>, Cancelled> {
    let (mut corners, mut faces) = (positions.to_vec(), disc.faces.clone());
    for hole in &disc.rims[1..] {
        let middle = corners.len() as u32;
        let sum = hole.iter().fold([0.0; 3], |sum, v| plus(sum, positions[*v as usize]));
        corners.push(times(1.0 / hole.len() as f64, sum));
        faces.extend(hole.iter().zip(hole.iter().cycle().skip(1)).map(|(a, b)| [*b, *a, middle]));
    }
    let mut places = vec![[0.0; 2]; corners.len()];
    let rim = &disc.rims[0];
    let radius = (area / std::f64::consts::PI).sqrt();
    let lengths: Vec<f64> = rim
        .iter()
        .zip(rim.iter().cycle().skip(1))
        .map(|(a, b)| norm(minus(positions[*a as usize], positions[*b as usize])))
        .collect();
    // Vertices at one place have a place each.
    let least = MIN_RIM_EDGE_SHARE * lengths.iter().sum::<f64>() / lengths.len() as f64 + f64::MIN_POSITIVE;
    let lengths: Vec<f64> = lengths.into_iter().map(|length| length.max(least)).collect();
    let around: f64 = lengths.iter().sum();
    let (mut is_rim, mut run) = (vec![false; corners.len()], 0.0);
    for (v, length) in rim.iter().zip(&lengths) {
        let angle = TAU * run / around;
        places[*v as usize] = [radius * libm::cos(angle), radius * libm::sin(angle)];
        is_rim[*v as usize] = true;
        run += length;
    }
    // Numbers of the unknowns.
    let mut number = vec![u32::MAX; corners.len()];
    let inner: Vec<usize> = (0..corners.len()).filter(|v| !is_rim[*v]).collect();
    (0..).zip(&inner).for_each(|(n, v)| number[*v] = n);
    let (mut entries, mut right) = (vec![], [vec![0.0; inner.len()], vec![0.0; inner.len()]]);
    for face in &faces {
        let triangle = Triangle::of(face.map(|v| corners[v as usize]));
        for k in (0..3).filter(|k| !is_rim[face[*k] as usize]) {
            let row = number[face[k] as usize];
            for other in [(k + 1) % 3, (k + 2) % 3] {
                let weight = triangle.half_tangent(k) / length(triangle.edge(k, other));
                let v = face[other] as usize;
                entries.push((row, row, weight));
                if is_rim[v] {
                    (0..2).for_each(|d| right[d][row as usize] += weight * places[v][d]);
                } else {
                    entries.push((row, number[v], -weight));
                }
            }
        }
    }
    if !inner.is_empty() {
        let solver = Multigrid::new(Sparse::new(inner.len(), inner.len(), &entries));
        for (d, right) in right.iter().enumerate() {
            let mut x = vec![0.0; inner.len()];
            solver.solve(right, &mut x, MEAN_VALUE_ACCURACY, progress)?;
            inner.iter().zip(x).for_each(|(v, x)| places[*v][d] = x);
        }
    }
    places.truncate(positions.len());
    Ok(places)
}
