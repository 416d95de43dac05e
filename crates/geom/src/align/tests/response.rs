//! The answer of a best fit to small shifts, against the same fit done again.

use super::parts::bracket;
use crate::align::{AlignWarning, BestFit, Measured, Response, Start, Target, best_fit, response};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::{dot, plus, times};

#[test]
fn the_pose_answers_to_noise_as_a_fit_done_again() {
    let reference = bracket(200.0);
    let scan = bracket(4.0);
    let tree = Tree::build(&reference).unwrap();
    let target = Target::new(&reference, &tree);
    let options = BestFit { start: Start::From(Rigid::IDENTITY), ..BestFit::default() };
    let random = &mut Random::new(5);
    // A scan with noise of its own, brought where it fits: small shifts are small beside it.
    let mut shaken = |mesh: &Mesh, size: f64| {
        let shift = |_: usize| -> [f64; 3] { std::array::from_fn(|_| size * (2.0 * random.unit() - 1.0)) };
        let shifts: Vec<[f64; 3]> = (0..mesh.positions.len()).map(shift).collect();
        let positions = mesh.positions.iter().zip(&shifts).map(|(p, s)| plus(*p, *s)).collect();
        (Mesh { positions, faces: mesh.faces.clone() }, shifts)
    };
    let (scan, _) = shaken(&scan, 0.02);
    let first = best_fit(&Measured::Mesh(&scan), &target, &options, &Silent).unwrap();
    let positions = scan.positions.iter().map(|p| first.reference_from_measured.point(*p)).collect();
    let scan = Mesh { positions, faces: scan.faces };
    // Points in the middle of facets: one on an edge answers to noise by changing its facet, which no first order tells.
    let middle = |f: &[u32; 3]| {
        times(1.0 / 3.0, f.iter().fold([0.0; 3], |sum, v| plus(sum, scan.positions[*v as usize])))
    };
    let cloud = Mesh { positions: scan.faces.iter().map(middle).collect(), faces: vec![] };
    for (scan, as_points) in [(&scan, false), (&cloud, true)] {
        let fit = |mesh: &Mesh| {
            let measured = match as_points {
                true => Measured::Points { points: &mesh.positions, normals: None },
                false => Measured::Mesh(mesh),
            };
            best_fit(&measured, &target, &options, &Silent).unwrap()
        };
        let at_rest = fit(scan);
        assert!(!at_rest.warnings.contains(&AlignWarning::NormalsTurned));
        let rest = at_rest.reference_from_measured;
        let still = Mesh {
            positions: scan.positions.iter().map(|p| rest.point(*p)).collect(),
            faces: scan.faces.clone(),
        };
        let measured = match as_points {
            true => Measured::Points { points: &still.positions, normals: None },
            false => Measured::Mesh(&still),
        };
        let found = response(&measured, &target, &at_rest, &options, &Silent).unwrap();
        let (mut off, mut all) = (0.0, 0.0);
        for _ in 0..5 {
            let (noisy, shifts) = shaken(&still, 0.005);
            let again = fit(&noisy).reference_from_measured;
            let change =
                std::array::from_fn(|i| found.gains.iter().zip(&shifts).map(|(g, s)| dot(g[i], *s)).sum());
            let told = Response::motion(found.center, change);
            for p in &reference.positions {
                let (a, b) = (plus(again.point(*p), times(-1.0, *p)), plus(told.point(*p), times(-1.0, *p)));
                let d = plus(a, times(-1.0, b));
                off += dot(d, d);
                all += dot(a, a);
            }
        }
        let share = (off / all).sqrt();
        assert!(all > 0.0 && share < 0.1, "as points {as_points}: {share}");
    }
}
