//! The surface of a cloud: points, normals by local planes, neighbors by nearness.

use super::pieces::{PieceGraph, Pieces};
use crate::num::dense::eigen;
use crate::parallel::prelude::*;
use crate::space::{Point, Vector, cross, dot, minus, plus, times, unit};
use crate::spatial::lists::lists;
use crate::spatial::neighbors::{Neighbor, PointTree};
use std::f64::consts::TAU;

/// Neighbors that make a normal. The second count serves where so few lie along a line, as on a scanner's row.
const NORMAL_NEIGHBOR_COUNTS: [usize; 2] = [16, 64];
/// Mean square width over length of the neighborhood, below which it is a line.
const MIN_SPREAD_RATIO: f64 = 0.03;
/// Neighbors that a region grows to.
const GROWTH_NEIGHBORS: usize = 8;

/// The points of a finite cloud.
pub(super) fn surface(points: &[Point]) -> PieceGraph<'_> {
    let tree = PointTree::new(points);
    let found: Vec<(Vector, Vec<[u32; 2]>)> = (points.par_iter().enumerate())
        .map(|(i, p)| {
            let i = i as u32;
            let (normal, near) = normal_at(points, &tree, p, i);
            let around = growth_neighbors(points, p, normal, &near);
            (normal, around.into_iter().flat_map(|n| [[i, n], [n, i]]).collect())
        })
        .collect();
    let mut normals = Vec::with_capacity(points.len());
    let mut pairs = Vec::with_capacity(2 * GROWTH_NEIGHBORS * points.len());
    for (normal, near) in found {
        normals.push(normal);
        pairs.extend(near);
    }
    let (first, others) = lists(points.len(), pairs);
    PieceGraph {
        points,
        pieces: Pieces::Points,
        places: points.to_vec(),
        normals,
        weights: vec![1.0; points.len()],
        first,
        others,
        is_drawn: false,
    }
}

/// Normal at point `i`, which lies at `p`, and the neighbors that made it, nearest first.
fn normal_at(points: &[Point], tree: &PointTree, p: &Point, i: u32) -> (Vector, Vec<Neighbor>) {
    let places =
        |near: &[Neighbor]| -> Vec<Point> { near.iter().map(|n| points[n.1 as usize]).chain([*p]).collect() };
    let near = tree.k_nearest(p, NORMAL_NEIGHBOR_COUNTS[0], Some(i));
    let (values, rows) = spread(&places(&near));
    if values[1] >= MIN_SPREAD_RATIO * values[2] && values[1] > 0.0 {
        return (rows[0], near);
    }
    let near = tree.k_nearest(p, NORMAL_NEIGHBOR_COUNTS[1], Some(i));
    (flattest(&places(&near)), near)
}

/// The neighbors that a region grows to from `p`. They are the nearest one in each direction along the surface, and then the
/// nearest of the others. The nearest of all may lie on one row.
fn growth_neighbors(points: &[Point], p: &Point, normal: Vector, near: &[Neighbor]) -> Vec<u32> {
    let first = near.iter().find_map(|n| {
        let q = minus(points[n.1 as usize], *p);
        unit(minus(q, times(dot(q, normal), normal)))
    });
    let Some((u, _)) = first else { return near.iter().take(GROWTH_NEIGHBORS).map(|n| n.1).collect() };
    let v = cross(normal, u);
    let mut occupied = [false; GROWTH_NEIGHBORS];
    // The first neighbor is in the middle of its sector, so that a row lies in two of them.
    let mut alone = |n: &&Neighbor| {
        let q = minus(points[n.1 as usize], *p);
        let turns = libm::atan2(dot(q, v), dot(q, u)) / TAU + 1.0 + 0.5 / GROWTH_NEIGHBORS as f64;
        !std::mem::replace(&mut occupied[(turns * GROWTH_NEIGHBORS as f64) as usize % GROWTH_NEIGHBORS], true)
    };
    let (mut chosen, others): (Vec<&Neighbor>, Vec<&Neighbor>) = near.iter().partition(|n| alone(n));
    let missing = GROWTH_NEIGHBORS - chosen.len();
    chosen.extend(others.into_iter().take(missing));
    chosen.into_iter().map(|n| n.1).collect()
}

/// The direction in which the points spread least; zero where they lie on a line or at one place.
pub(super) fn flattest(points: &[Point]) -> Vector {
    let (values, rows) = spread(points);
    if values[1] > 1e-12 * values[2] { rows[0] } else { [0.0; 3] }
}

/// Variances of the points along their principal directions, least first, and those directions.
fn spread(points: &[Point]) -> ([f64; 3], [Vector; 3]) {
    let share = 1.0 / points.len() as f64;
    let mean = times(share, points.iter().fold([0.0; 3], |s, &p| plus(s, p)));
    let mut spread = [[0.0; 3]; 3];
    for &p in points {
        let q = minus(p, mean);
        for i in 0..3 {
            for j in 0..3 {
                spread[i][j] += share * q[i] * q[j];
            }
        }
    }
    eigen(spread)
}
