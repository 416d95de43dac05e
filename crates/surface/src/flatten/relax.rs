//! A mesh in the plane, relaxed until its facets keep their lengths as far as they can.
//!
//! By turns each facet is laid by itself, turned as it lies, and all places are found that suit these best. (Liu,
//! Zhang, Xu, Gotsman, Gortler, A local/global approach to mesh parameterization, Computer Graphics Forum 27, 2008). A
//! step never takes a facet to no area: it ends at four fifths of the way there. (Smith, Schaefer, Bijective
//! parameterization with free boundaries, ACM Transactions on Graphics 34, 2015). The energy that the steps lower is
//! quadratic for given turns, so a part of a step lowers it too.

use super::disc::Disc;
use super::triangle::{Triangle, cross, dot, length};
use std::collections::VecDeque;
use trueness_geom::num::cholesky::Cholesky;
use trueness_geom::num::multigrid::Multigrid;
use trueness_geom::num::sparse::Sparse;
use trueness_geom::progress::{Cancelled, Progress};

/// Steps at most.
const MAX_RELAXING_STEPS: usize = 200;
/// A step that takes away less than this share of the energy is the last but for a few.
const MIN_ENERGY_GAIN: f64 = 1e-3;
/// So many such steps in a row end it.
const IDLE_STEPS_TO_END: usize = 3;
/// Energy for a unit of area, the square of the change of lengths, that is next to nothing.
const ZERO_ENERGY_PER_AREA: f64 = 1e-10;
/// Residual that the solver may leave in the equations.
const RELAXING_ACCURACY: f64 = 1e-5;
/// Weight, relative to the neighbors', with which vertices are held where they are: the equations do not tell where the whole lies.
const HOLDING_WEIGHT: f64 = 1e-9;
/// Share of the way to where a facet has no area.
const SAFE_STEP_SHARE: f64 = 0.8;

/// Relaxes places in which all facets run against the clock.
pub(super) fn relax(
    disc: &Disc,
    triangles: &[Triangle],
    places: &mut [[f64; 2]],
    progress: &dyn Progress,
) -> Result<(), Cancelled> {
    let count = places.len();
    let mut entries = vec![];
    for (face, triangle) in disc.faces.iter().zip(triangles) {
        for k in 0..3 {
            let (a, b) = (face[(k + 1) % 3], face[(k + 2) % 3]);
            let weight = 0.5 * triangle.cotangent(k);
            entries.extend([(a, a, weight), (b, b, weight), (a, b, -weight), (b, a, -weight)]);
        }
    }
    let mut held = Sparse::new(count, count, &entries).diagonal();
    held.iter_mut().for_each(|d| *d *= HOLDING_WEIGHT);
    entries.extend((0..).zip(&held).map(|(v, held)| (v, v, *held)));
    let matrix = Sparse::new(count, count, &entries);
    drop(entries);
    let solver = Multigrid::new(matrix);
    let area: f64 = triangles.iter().map(|t| 0.5 * t.doubled_area()).sum();
    let (mut before, mut idle) = (f64::INFINITY, 0);
    let mut ahead = AndersonAcceleration::default();
    // Where a plain step led to, while the places are those of a step ahead of it.
    let mut plain: Option<Vec<[f64; 2]>> = None;
    for _ in 0..MAX_RELAXING_STEPS {
        let (energy, mut right) = pulls(disc, triangles, places);
        if let Some(plain) = plain.take_if(|_| energy > before) {
            places.copy_from_slice(&plain);
            ahead = AndersonAcceleration::default();
            continue;
        }
        idle = if energy > (1.0 - MIN_ENERGY_GAIN) * before { idle + 1 } else { 0 };
        if energy <= ZERO_ENERGY_PER_AREA * area || idle >= IDLE_STEPS_TO_END {
            break;
        }
        before = energy;
        let mut target = places.to_vec();
        for (d, right) in right.iter_mut().enumerate() {
            right.iter_mut().zip(&held).zip(&*places).for_each(|((r, held), p)| *r += held * p[d]);
            let mut x: Vec<f64> = places.iter().map(|p| p[d]).collect();
            solver.solve(right, &mut x, RELAXING_ACCURACY, progress)?;
            target.iter_mut().zip(x).for_each(|(t, x)| t[d] = x);
        }
        let part = share(disc, places, &target);
        let further = ahead.of(places, &target).filter(|f| part == 1.0 && share(disc, places, f) == 1.0);
        match further {
            Some(further) => {
                places.copy_from_slice(&further);
                plain = Some(target);
            }
            None => {
                let step =
                    |(p, t): (&mut [f64; 2], &[f64; 2])| (0..2).for_each(|d| p[d] += part * (t[d] - p[d]));
                places.iter_mut().zip(&target).for_each(step);
            }
        }
    }
    if let Some(plain) = plain.filter(|_| pulls(disc, triangles, places).0 > before) {
        places.copy_from_slice(&plain);
    }
    Ok(())
}

/// The last steps, which tell where many more of them would lead. (Anderson, Iterative procedures for nonlinear
/// integral equations, Journal of the ACM 12, 1965. Peng, Deng, Zhang, Geng, Qin, Liu, Anderson acceleration for
/// geometry optimization and physics simulation, ACM Transactions on Graphics 37, 2018).
#[derive(Default)]
struct AndersonAcceleration {
    /// The last step, and where it led to.
    last: Option<[Vec<[f64; 2]>; 2]>,
    /// How both changed from one step to the next.
    changes: VecDeque<[Vec<[f64; 2]>; 2]>,
}

impl AndersonAcceleration {
    /// Changes that are remembered.
    const MAX_CHANGES_KEPT: usize = 6;

    /// Where the step from places to a target would go on to; `None` before there are two.
    fn of(&mut self, places: &[[f64; 2]], target: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
        let less = |a: &[[f64; 2]], b: &[[f64; 2]]| -> Vec<[f64; 2]> {
            a.iter().zip(b).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]).collect()
        };
        let step = less(target, places);
        if let Some([before, led]) = &self.last {
            self.changes.push_back([less(&step, before), less(target, led)]);
            if self.changes.len() > AndersonAcceleration::MAX_CHANGES_KEPT {
                self.changes.pop_front();
            }
        }
        let sum = |a: &[[f64; 2]], b: &[[f64; 2]]| a.iter().zip(b).map(|(a, b)| dot(*a, *b)).sum::<f64>();
        let n = self.changes.len();
        let mut matrix = vec![0.0; n * n];
        for i in 0..n {
            (0..=i).for_each(|j| matrix[i * n + j] = sum(&self.changes[i][0], &self.changes[j][0]));
            matrix[i * n + i] *= 1.0 + 1e-10;
        }
        let mut shares: Vec<f64> = self.changes.iter().map(|c| sum(&c[0], &step)).collect();
        self.last = Some([step, target.to_vec()]);
        Cholesky::new(matrix, n).filter(|_| n > 0)?.solve(&mut shares);
        let mut further = target.to_vec();
        for ([_, led], share) in self.changes.iter().zip(shares) {
            further.iter_mut().zip(led).for_each(|(f, led)| (0..2).for_each(|d| f[d] -= share * led[d]));
        }
        Some(further)
    }
}

/// The energy of these places, and the right sides for the places that suit the facets as they are turned there.
fn pulls(disc: &Disc, triangles: &[Triangle], places: &[[f64; 2]]) -> (f64, [Vec<f64>; 2]) {
    let mut energy = 0.0;
    let mut right = [vec![0.0; places.len()], vec![0.0; places.len()]];
    for (face, triangle) in disc.faces.iter().zip(triangles) {
        let own = Triangle(face.map(|v| places[v as usize]));
        let mut turn = [0.0; 2];
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let weight = triangle.cotangent(k);
            let (x, u) = (triangle.edge(a, b), own.edge(a, b));
            turn[0] += weight * dot(x, u);
            turn[1] += weight * cross(x, u);
        }
        let size = length(turn);
        let [cos, sin] = if size > 0.0 { turn.map(|t| t / size) } else { [1.0, 0.0] };
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let weight = 0.5 * triangle.cotangent(k);
            let (x, u) = (triangle.edge(a, b), own.edge(a, b));
            let laid = [cos * x[0] - sin * x[1], sin * x[0] + cos * x[1]];
            for d in 0..2 {
                energy += weight * (u[d] - laid[d]) * (u[d] - laid[d]);
                right[d][face[b] as usize] += weight * laid[d];
                right[d][face[a] as usize] -= weight * laid[d];
            }
        }
    }
    (energy, right)
}

/// The share of the way to the target that turns no facet over. It is all of it, or less than that to the first facet
/// without an area.
fn share(disc: &Disc, places: &[[f64; 2]], target: &[[f64; 2]]) -> f64 {
    let mut first = f64::INFINITY;
    for face in &disc.faces {
        let from = Triangle(face.map(|v| places[v as usize]));
        let to = Triangle(face.map(|v| target[v as usize]));
        let way = |k: usize| [0, 1].map(|d| to.edge(0, k)[d] - from.edge(0, k)[d]);
        // The area over the share of the way.
        let (a, b) = (from.edge(0, 1), from.edge(0, 2));
        let (p, q) = (way(1), way(2));
        let [c0, c1, c2] = [cross(a, b), cross(a, q) + cross(p, b), cross(p, q)];
        first = first.min(first_zero(c0, c1, c2));
    }
    if first > 1.0 / SAFE_STEP_SHARE { 1.0 } else { SAFE_STEP_SHARE * first }
}

/// The least positive zero of `c0 + c1 t + c2 t²` with `c0 > 0`.
fn first_zero(c0: f64, c1: f64, c2: f64) -> f64 {
    let under = c1 * c1 - 4.0 * c0 * c2;
    if under < 0.0 {
        return f64::INFINITY;
    }
    // Without cancellation.
    let q = -0.5 * (c1 + if c1 < 0.0 { -under.sqrt() } else { under.sqrt() });
    [q / c2, c0 / q].into_iter().filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min)
}
