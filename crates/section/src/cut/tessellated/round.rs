//! Sections of round bodies by their facets: form within these is no doubt.

use super::*;
use crate::{Geometry, cut};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::plane::Plane;
use trueness_geom::progress::Silent;

/// A body of revolution about z in `around` chords, its outline at these radii and heights, open at both ends.
fn turned(outline: &[[f64; 2]], around: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for [r, z] in outline {
        for i in 0..around {
            let (s, c) = libm::sincos(std::f64::consts::TAU * i as f64 / around as f64);
            mesh.positions.push([r * c, r * s, *z].map(|x| f64::from(x as f32)));
        }
    }
    for k in 0..outline.len() as u32 - 1 {
        for i in 0..around as u32 {
            let n = around as u32;
            let (a, b) = (k * n + i, k * n + (i + 1) % n);
            mesh.faces.extend([[a, b, b + n], [a, b + n, a + n]]);
        }
    }
    mesh
}

/// A part of a sphere, a cone, a cylinder or the outer half of a torus, and its radius at a height.
fn body(random: &mut Random) -> (Mesh, impl Fn(f64) -> f64 + use<>, [f64; 2], f64) {
    let mut between = |a: f64, b: f64| a + (b - a) * random.unit();
    let (kind, r, slope) = (between(0.0, 4.0) as usize, between(5.0, 30.0), between(0.1, 2.0));
    let radius = move |z: f64| match kind {
        0 => (r * r - z * z).sqrt(),
        1 => r + slope * z,
        2 => r,
        _ => 2.0 * r + (r * r - z * z).sqrt(),
    };
    let high = [0.95, 1.0, 1.0, 0.95][kind] * r;
    let low = if kind == 1 { -0.5 * r / slope.max(0.5) } else { -high };
    let (rings, around) = (between(3.0, 30.0) as usize, between(24.0, 200.0) as usize);
    let outline: Vec<[f64; 2]> =
        (0..=rings).map(|k| low + (high - low) * k as f64 / rings as f64).map(|z| [radius(z), z]).collect();
    let turn = std::f64::consts::TAU / around as f64;
    // How far facets lie within the surface, in the plane.
    let apart = (high - low) / rings as f64;
    let worst = outline.windows(2).map(|w| {
        let middle = 0.5 * (w[0][1] + w[1][1]);
        (radius(middle) - 0.5 * (w[0][0] + w[1][0])).abs()
    });
    let off = worst.fold(0.0, f64::max) + 0.125 * turn * turn * 3.0 * r + 1e-6 * apart;
    (turned(&outline, around), radius, [low, high], 2.0 * off)
}

/// Circles of round bodies are circles, to the resolution of the facets, and no doubt is told of them at any height.
#[test]
fn circles_through_facets_are_no_doubt() {
    let random = &mut Random::new(3);
    let count = 60;
    let (mut doubts, mut right, mut other) = (0, 0, 0);
    for k in 0..count {
        let (mesh, radius, [low, high], off) = body(random);
        let z = low + (high - low) * (0.02 + 0.96 * random.unit());
        let chains = cut(&mesh, &Plane { normal: [0.0, 0.0, 1.0], offset: z }, &Silent).unwrap();
        let frame = PlaneFrame { origin: [0.0, 0.0, z], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0] };
        let options = Options::default();
        let found = chain_contour(&chains[0], &frame, &CutMesh::new(&mesh, None), &options, &Silent).unwrap();
        doubts += usize::from(!found.unreliable.is_empty());
        match found.segments[..] {
            [Segment { geometry: Geometry::Arc { radius: r, .. }, .. }] => {
                let good = (r - radius(z)).abs() <= off;
                right += usize::from(good);
                assert!(good || !found.unreliable.is_empty(), "{k}: {r} for {} ± {off}", radius(z));
            }
            _ => other += 1,
        }
    }
    println!("{doubts} doubts, {right} right, {other} of other kinds, of {count}");
    assert!(20 * doubts <= count && 10 * right >= 8 * count, "{doubts} {right} {other}");
}

/// A circle that misses its points by more than facets do stays in doubt, and so does one about noise.
#[test]
fn what_facets_do_not_tell_stays_in_doubt() {
    let random = &mut Random::new(9);
    let ring = |off: &mut dyn FnMut(usize) -> f64| -> Vec<[f64; 2]> {
        let place = |i: usize| {
            let (s, c) = libm::sincos(std::f64::consts::TAU * i as f64 / 80.0);
            let r = 10.0 + off(i);
            [r * c, r * s]
        };
        (0..80).map(place).collect()
    };
    let doubtful = |points: &[[f64; 2]]| {
        let geometry =
            Geometry::Arc { center: [0.0; 2], radius: 10.0, start: 0.0, sweep: std::f64::consts::TAU };
        let off: Vec<f64> = points.iter().map(|p| libm::hypot(p[0], p[1]) - 10.0).collect();
        let (rms, max) = (
            (off.iter().map(|x| x * x).sum::<f64>() / 80.0).sqrt(),
            off.iter().fold(0.0_f64, |m, x| m.max(x.abs())),
        );
        let line = Segment::line([10.0, 0.0], [10.0, 0.0]);
        let length = 20.0 * std::f64::consts::PI;
        let segment = Segment { geometry, length, count: 80, rms, max, ..line };
        let found = Contour {
            closed: true,
            segments: vec![segment],
            labels: vec![0; 80],
            residuals: off,
            unreliable: vec![0],
            ..Contour::default()
        };
        !within_facets(found, points).unreliable.is_empty()
    };
    assert!(!doubtful(&ring(&mut |i| if i % 2 == 0 { 0.003 } else { -0.003 })));
    assert!(doubtful(&ring(&mut |_| 0.05 * (random.unit() - 0.5))));
    assert!(doubtful(&ring(&mut |i| if i % 40 < 20 { 0.1 } else { -0.1 })));
}
