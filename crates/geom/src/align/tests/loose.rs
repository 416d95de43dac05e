//! What the insides of faces hold is not told as free.

use super::parts::{block, normal};
use crate::align::{Alignment, BestFit, Measured, Start, Target, best_fit};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::{Point, norm};

fn fit(points: &[Point], reference: &Mesh, start: Start) -> Alignment {
    let tree = Tree::build(reference).unwrap();
    let options = BestFit { start, ..BestFit::default() };
    best_fit(&Measured::Points { points, normals: None }, &Target::new(reference, &tree), &options, &Silent)
        .unwrap()
}

/// What faces hold by their insides is held: three faces of a block with noise, seen to their rims and not.
#[test]
fn faces_of_three_directions_leave_nothing_free() {
    let random = &mut Random::new(5);
    let (sizes, reference) = ([60.0, 40.0, 8.0], block([0.0; 3], [60.0, 40.0, 8.0], 4.0));
    for trial in 0..12 {
        let noise = [0.0, 0.002, 0.02][trial % 3];
        let inset = [0.0, 1.0][trial / 3 % 2];
        let mut points: Vec<Point> = vec![];
        for axis in 0..3 {
            let count = [40, 80, 1200][axis];
            points.extend((0..count).map(|_| -> Point {
                let mut p: Point = std::array::from_fn(|k| inset + (sizes[k] - 2.0 * inset) * random.unit());
                p[axis] = if trial % 2 == 0 { 0.0 } else { sizes[axis] };
                p[axis] += noise * normal(random);
                p
            }));
        }
        let found = fit(&points, &reference, Start::Given(Rigid::IDENTITY));
        assert!(found.freedoms.is_empty() && found.slack.is_empty(), "{trial}: {found:?}");
        assert!(norm(found.reference_from_measured.translation()) < 10.0 * noise + 1e-6, "{trial}");
    }
}
