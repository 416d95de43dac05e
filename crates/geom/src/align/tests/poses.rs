//! Poses found from anywhere.

use super::parts::{bracket, moved, random_pose};
use crate::align::{Alignment, BestFit, Measured, Target, best_fit};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;

fn fit(measured: &Mesh, reference: &Mesh) -> Alignment {
    let tree = Tree::build(reference).unwrap();
    best_fit(&Measured::Mesh(measured), &Target::new(reference, &tree), &BestFit::default(), &Silent).unwrap()
}

#[test]
fn the_same_part_is_found_from_random_poses() {
    let reference = bracket(4.0);
    let random = &mut Random::new(1);
    for trial in 0..20 {
        let pose = random_pose(random, 200.0);
        let found = fit(&moved(&reference, &pose), &reference);
        let off = found.reference_from_measured.after(&pose);
        assert!(off.angle() < 1e-10 && off.displacement([40.0, 25.0, 10.0]) < 1e-9, "{trial}: {found:?}");
        assert!(found.converged && found.warnings.is_empty(), "{trial}: {:?}", found.warnings);
    }
}
