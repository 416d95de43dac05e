//! Scatter and weights of crossings, by the covariances of the vertices between which they lie.

use super::cut_mesh::CutMesh;
use crate::Chain;
use trueness_geom::space::{minus, norm};

/// Scatter of crossings, as far as it is known.
pub(super) struct Scatter {
    /// How many independent points each tells as much as.
    pub weights: Vec<f64>,
    /// Their standard deviation, in those of the vertices.
    pub share: f64,
}

/// A crossing as the mean of two vertices.
struct Mean {
    vertices: [u32; 2],
    shares: [f64; 2],
}

/// The scatter of the crossings of a chain. Without any noise known vertices are taken to be independent.
pub(super) fn scatter(cut: &CutMesh, chain: &Chain) -> Scatter {
    let place = |v: u32| cut.mesh.positions[v as usize];
    let means: Vec<Mean> = (chain.edges.iter().zip(&chain.points))
        .map(|(edge, p)| {
            let [a, b] = edge.map(place);
            let length = norm(minus(b, a));
            let t = if length > 0.0 { (norm(minus(*p, a)) / length).min(1.0) } else { 0.5 };
            Mean { vertices: *edge, shares: [1.0 - t, t] }
        })
        .collect();
    let reach = cut.noise.map_or(0.0, |n| n.reach);
    let correlation = |v: u32, w: u32| match cut.noise {
        _ if v == w => 1.0,
        Some(noise) if reach > 0.0 => noise.correlation(norm(minus(place(v), place(w)))),
        _ => 0.0,
    };
    let covariance = |i: usize, j: usize| {
        let (a, b) = (&means[i], &means[j]);
        let mut sum = 0.0;
        for (v, s) in a.vertices.iter().zip(a.shares) {
            for (w, t) in b.vertices.iter().zip(b.shares) {
                sum += s * t * correlation(*v, *w);
            }
        }
        sum
    };
    // Crossings beyond share neither a vertex nor noise.
    let apart = |i: usize, j: usize| {
        let (a, b) = (means[i].vertices, means[j].vertices);
        a.iter().all(|v| !b.contains(v))
            && a.iter().all(|v| b.iter().all(|w| norm(minus(place(*v), place(*w))) >= reach))
    };
    let n = means.len();
    let mut sums = vec![0.0; n];
    let mut variance = 0.0;
    let mut own = vec![0.0; n];
    for i in 0..n {
        own[i] = covariance(i, i);
        variance += own[i] / n as f64;
        sums[i] += own[i];
        for step in 1..n {
            let j = i + step;
            // Round a closed chain each pair once.
            if !chain.closed && j >= n || 2 * step > n || 2 * step == n && i >= j % n || apart(i, j % n) {
                break;
            }
            let shared = covariance(i, j % n);
            sums[i] += shared;
            sums[j % n] += shared;
        }
    }
    let weights = own.iter().zip(&sums).map(|(own, sum)| (own / sum).min(1.0)).collect();
    Scatter { weights, share: variance.sqrt() }
}
