//! Scans that round edges, over so many distances of points, more the nearer to the edge.

use super::*;

const STEP: f64 = 0.4;
/// A stepped pin with a bore through it: rectangular corners only, faces from 5 to 20 wide.
const PIN: [[f64; 2]; 6] = [[5.0, 0.0], [15.0, 0.0], [15.0, 12.0], [10.0, 12.0], [10.0, 32.0], [5.0, 32.0]];

/// A point of a profile and its turn: where the scan has it, and how far it is from the nearest corner.
fn rounded(profile: &Profile, side: usize, p: Point, width: f64) -> (Point, f64) {
    let rho = libm::hypot(p[0], p[1]);
    let at = |k: usize| profile[k % profile.len()];
    let way = |k: usize| minus2(at(k + 1), at(k));
    let crossed = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let ends = [(at(side), side + profile.len() - 1), (at(side + 1), side)];
    let far = |end: [f64; 2]| {
        let off = minus2([rho, p[2]], end);
        libm::hypot(off[0], off[1])
    };
    let [first, second] = ends.map(|(end, before)| (far(end), crossed(way(before), way(before + 1))));
    let (far, turn) = if first.0 < second.0 { first } else { second };
    // Into the material at a corner that stands out, out of it in one that does not.
    let along = way(side);
    let inward = [-along[1], along[0]].map(|x| x / libm::hypot(along[0], along[1]));
    let off = (width - far).max(0.0).powi(2) / (4.0 * width.max(1e-9)) * turn.signum();
    let [rho_off, z_off] = inward.map(|x| x * off);
    let scale = (rho + rho_off) / rho;
    ([p[0] * scale, p[1] * scale, p[2] + z_off], far)
}

/// No point that rounding moves by more than the noise is form of a face, and what is clear of the edges stays. Nothing is left
/// out at edges that are sharp, or as good as sharp.
#[test]
fn what_edges_round_is_of_no_face() {
    let profile = PIN.to_vec();
    let faces = Faces::of(&turned(&profile, SIDES), &Silent).unwrap();
    for (case, (width, noise)) in
        [(0.0, 0.0), (0.0, 0.003), (1.0, 0.003), (1.5, 0.0), (2.0, 0.001), (2.0, 0.006), (2.5, 0.003)]
            .into_iter()
            .enumerate()
    {
        for as_mesh in [false, true] {
            let (mut scan, sides) = scan(&profile, STEP, 0.0, as_mesh, case as u64);
            let mut random = Random::new(case as u64);
            let mut far = vec![];
            for (p, side) in scan.positions.iter_mut().zip(&sides) {
                let (place, from_corner) = rounded(&profile, *side, *p, width * STEP);
                *p = place.map(|x| x + noise * normal(&mut random));
                far.push(from_corner);
            }
            let found = partition(&scan, &all_of(&faces), &OPTIONS, &Silent).unwrap();
            let moved = |far: f64| (width * STEP - far).max(0.0).powi(2) / (4.0 * width.max(1e-9) * STEP);
            let count = |wanted: &dyn Fn(usize) -> bool, class: &dyn Fn(Class) -> bool| {
                let all = (0..far.len()).filter(|p| wanted(*p));
                let (mut total, mut those) = (0, 0);
                all.for_each(|p| {
                    total += 1;
                    those += usize::from(class(found.classes[p]));
                });
                f64::from(those as u32) / f64::from(total.max(1))
            };
            let is_moved = |p: usize| moved(far[p]) > 3.0 * noise + 1e-6;
            let is_clear = |p: usize| far[p] > (width + 0.75) * STEP;
            let formed = count(&is_moved, &|class| class == Class::Face);
            let lost = count(&is_clear, &|class| class != Class::Face);
            println!(
                "{width} {noise} {as_mesh}: {formed:.4} of what is rounded is form, {lost:.4} of the rest is lost"
            );
            assert!(formed <= 0.01 && lost <= 0.01, "{width} {noise} {as_mesh}: {formed} {lost}");
        }
    }
}
