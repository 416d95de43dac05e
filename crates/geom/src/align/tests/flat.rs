//! Scans that are flat.

use crate::align::{BestFit, Measured, Target, best_fit};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::progress::Silent;

/// Poses of a flat scan in a coordinate plane leave what rounding leaves of zeros: 1e-54 and less.
#[test]
fn a_flat_scan_at_zero_is_aligned() {
    let corner = |k: usize| [[0.0, 60.0][k / 4], [0.0, 40.0][k / 2 % 2], [0.0, 20.0][k % 2]];
    let sides = [
        [1, 0, 4],
        [2, 4, 0],
        [1, 3, 0],
        [3, 1, 5],
        [3, 2, 0],
        [3, 7, 2],
        [5, 4, 6],
        [5, 1, 4],
        [6, 4, 2],
        [7, 6, 2],
        [7, 3, 5],
        [7, 5, 6],
    ];
    let reference = Mesh { positions: (0..8).map(corner).collect(), faces: sides.to_vec() };
    let tree = Tree::build(&reference).unwrap();
    let place = |x: u32, y: u32| 61 * y + x;
    let cells = (0..40).flat_map(|y| (0..60).map(move |x| (x, y)));
    let faces = cells.flat_map(|(x, y)| {
        let [a, b, c, d] = [place(x, y), place(x + 1, y), place(x + 1, y + 1), place(x, y + 1)];
        [[a, c, b], [a, d, c]]
    });
    let faces: Vec<[u32; 3]> = faces.collect();
    let turns: [fn(f64, f64) -> [f64; 3]; 3] =
        [|x, y| [x, y, 0.0], |x, y| [6e-17 * x - y, x + 6e-17 * y, 0.0], |x, y| [x, -y, -0.0]];
    for turn in turns {
        let positions = (0..41).flat_map(|y| (0..61).map(move |x| turn(f64::from(x), f64::from(y))));
        let scan = Mesh { positions: positions.collect(), faces: faces.clone() };
        let target = Target::new(&reference, &tree);
        let found = best_fit(&Measured::Mesh(&scan), &target, &BestFit::default(), &Silent).unwrap();
        assert!(found.rms < 1e-9, "{found:?}");
    }
}
