//! Faces without topology: their loops, their senses and their neighbors.

use super::super::super::written::{Text, list};
use super::solids::{SIDES, corner};
use super::{bound, circle, line, measured, near, plane, polygon, read};
use std::f64::consts::PI;

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];

fn backwards<const N: usize>(mut corners: [[f64; 3]; N]) -> [[f64; 3]; N] {
    corners.reverse();
    corners
}

/// Outer loops and holes may run either way; each piece may be given backwards.
#[test]
fn loops_of_either_sense_bound_the_same() {
    let hole = [[1.0, 1.0, 0.0], [3.0, 1.0, 0.0], [2.0, 3.0, 0.0]];
    for outer in [SQUARE, backwards(SQUARE)] {
        for inner in [hole, backwards(hole)] {
            let mut text = Text::new();
            let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
            let curves = [polygon(&mut text, &outer), polygon(&mut text, &inner)];
            let [outer, inner] = curves.map(|c| bound(&mut text, surface, c));
            text.add(144, format!("{surface},1,1,{outer},{inner}"));
            assert!(near(measured(&text).area(), 14.0));
        }
    }
    let mut text = Text::new();
    let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
    let sides = [(0, 1), (2, 1), (2, 3), (0, 3)].map(|(a, b)| line(&mut text, SQUARE[a], SQUARE[b]));
    let curve = text.add(102, format!("4,{}", list(sides)));
    let around = bound(&mut text, surface, curve);
    text.add(144, format!("{surface},1,0,{around}"));
    assert!(near(measured(&text).area(), 16.0));
}

/// A bounded surface (143) has its boundaries in any order, and its curves with a sense.
#[test]
fn boundaries_have_a_sense_for_each_curve() {
    let mut text = Text::new();
    let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
    let sides = [(0, 1), (2, 1), (2, 3), (0, 3)].map(|(a, b)| line(&mut text, SQUARE[a], SQUARE[b]));
    let uses: Vec<String> =
        sides.iter().zip([1, 2, 1, 2]).map(|(s, sense)| format!("{s},{sense},0")).collect();
    let outer = text.add(141, format!("0,1,{surface},4,{}", uses.join(",")));
    let ring = circle(&mut text, [2.0, 2.0, 0.0], 1.0, 0.3);
    let hole = text.add(141, format!("0,1,{surface},1,{ring},2,0"));
    text.add(143, format!("0,{surface},2,{hole},{outer}"));
    assert!(near(measured(&text).area(), 16.0 - PI));
    let mut text = Text::new();
    let curve = polygon(&mut text, &SQUARE);
    text.form(108, 1, format!("0.,0.,1.,0.,{curve},0.,0.,0.,0."));
    assert!(near(measured(&text).area(), 16.0));
}

fn cylinder(text: &mut Text, height: f64) -> u64 {
    let axis = line(text, [0.0; 3], [0.0, 0.0, 1.0]);
    let profile = line(text, [2.0, 0.0, 0.0], [2.0, 0.0, height]);
    text.add(120, format!("{axis},{profile},0.,{}", 2.0 * PI))
}

/// All around a cylinder: the two sides of the seam are two lines in the file, one edge in the model. A hole goes through it.
#[test]
fn a_seam_is_one_edge() {
    for sense in [1.0, -1.0] {
        let mut text = Text::new();
        let surface = cylinder(&mut text, 5.0);
        let rings = [0.0, 5.0].map(|z| circle(&mut text, [0.0, 0.0, z], 2.0, 0.0));
        let up = line(&mut text, [2.0, 0.0, 0.0], [2.0, 0.0, 5.0]);
        let down = line(&mut text, [2.0, 0.0, 5.0], [2.0, 0.0, 0.0]);
        // The second ring runs backwards: turned by its matrix.
        let mirror = text.add(124, list([1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, sense, 0.0]));
        let z = 5.0 * sense;
        let back = text.add(100, list([z, 0.0, 0.0, 2.0, 0.0, 2.0, 0.0]));
        text.placed(mirror);
        let all = text.add(102, format!("4,{},{up},{back},{down}", rings[0]));
        let around = bound(&mut text, surface, all);
        text.add(144, format!("{surface},1,0,{around}"));
        let found = measured(&text);
        assert!(near(found.area(), 20.0 * PI), "{}", found.area());
        assert_eq!(found.brep.edges.len(), 3);
    }
    // Two loops around, without a seam, both in the same sense.
    let mut text = Text::new();
    let surface = cylinder(&mut text, 5.0);
    let bounds = [1.0, 4.0].map(|z| {
        let ring = circle(&mut text, [0.0, 0.0, z], 2.0, 0.0);
        bound(&mut text, surface, ring)
    });
    text.add(144, format!("{surface},1,1,{},{}", bounds[0], bounds[1]));
    assert!(near(measured(&text).area(), 12.0 * PI));
}

/// The outer bound is that of the surface, which has a hole.
#[test]
fn holes_in_whole_surfaces() {
    let mut text = Text::new();
    let numbers = "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,4.,0.,0.,0.,5.,0.,4.,5.,0.,0.,1.,0.,1.";
    let surface = text.add(128, numbers);
    let ring = circle(&mut text, [2.0, 2.0, 0.0], 1.0, 0.0);
    let hole = bound(&mut text, surface, ring);
    text.add(144, format!("{surface},0,1,0,{hole}"));
    assert!(near(measured(&text).area(), 20.0 - PI));
    let mut text = Text::new();
    let surface = text.add(128, numbers);
    text.add(144, format!("{surface},0,0,0"));
    assert!(near(measured(&text).area(), 20.0));
}

/// Bounds given in parameters alone: lines of equal parameters are exact, others are near.
#[test]
fn bounds_in_parameters() {
    let mut text = Text::new();
    let surface = cylinder(&mut text, 5.0);
    // Parameters: along the line, then the angle.
    let own = polygon(&mut text, &[[0.2, 1.0, 0.0], [0.8, 1.0, 0.0], [0.8, 2.5, 0.0], [0.2, 2.5, 0.0]]);
    let around = text.add(142, format!("0,{surface},{own},0,1"));
    text.add(144, format!("{surface},1,0,{around}"));
    assert!(near(measured(&text).area(), 3.0 * 1.5 * 2.0));
    // Across: two sides are helices.
    let mut text = Text::new();
    let surface = cylinder(&mut text, 5.0);
    let own = polygon(&mut text, &[[0.2, 1.0, 0.0], [0.6, 1.5, 0.0], [0.6, 3.0, 0.0], [0.2, 2.5, 0.0]]);
    let around = text.add(142, format!("0,{surface},{own},0,1"));
    text.add(144, format!("{surface},1,0,{around}"));
    assert!((measured(&text).area() - 2.0 * 1.5 * 2.0).abs() < 1e-5, "{}", measured(&text).area());
    // A tabulated cylinder counts its curve from 0 to 1.
    let mut text = Text::new();
    let curve = text.add(126, "1,1,1,0,1,0,3.,3.,7.,7.,1.,1.,0.,0.,0.,8.,0.,0.,3.,7.,0.,0.,1.");
    let surface = text.add(122, format!("{curve},0.,0.,6."));
    let own = polygon(&mut text, &[[0.25, 0.5, 0.0], [0.5, 0.5, 0.0], [0.5, 1.0, 0.0], [0.25, 1.0, 0.0]]);
    let around = text.add(142, format!("0,{surface},{own},0,1"));
    text.add(144, format!("{surface},1,0,{around}"));
    assert!(near(measured(&text).area(), 2.0 * 3.0));
    // Both are there, and the file prefers that in parameters: that in space is taken, which is told.
    let mut text = Text::new();
    let surface = cylinder(&mut text, 5.0);
    let own = polygon(&mut text, &[[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 2.0, 0.0]]);
    let p = |z: f64, t: f64| [2.0 * t.cos(), 2.0 * t.sin(), z];
    let rings = [0.0, 5.0].map(|z| {
        text.add(100, list([vec![z, 0.0, 0.0], p(z, 1.0)[..2].to_vec(), p(z, 2.0)[..2].to_vec()].concat()))
    });
    let sides = [1.0, 2.0].map(|t| line(&mut text, p(0.0, t), p(5.0, t)));
    let all = text.add(102, format!("4,{},{},{},{}", rings[0], sides[1], rings[1], sides[0]));
    let around = text.add(142, format!("0,{surface},{own},{all},1"));
    text.add(144, format!("{surface},1,0,{around}"));
    let file = read(&text);
    assert!(file.model.is_complete() && file.model.unread.len() == 1, "{:?}", file.model.unread);
    assert!(file.model.unread[0].reason.contains("prefers"));
}

/// Six faces that share nothing in the file become one sheet that looks outward, however they are given; a solid it is not.
#[test]
fn faces_of_a_box_agree() {
    for turned in 0..8 {
        let mut text = Text::new();
        for (side, (around, normal)) in SIDES.into_iter().enumerate() {
            let sense = if turned >> (side % 3) & 1 == 1 { -1.0 } else { 1.0 };
            let surface = plane(&mut text, normal.map(|n| sense * n), corner(around[0]));
            text.status("00010000");
            // Corners are off by less than the resolution.
            let off = 4e-7 * (side % 2) as f64;
            let corners = around.map(|k| corner(k).map(|x| x + off));
            let curve = polygon(&mut text, &corners);
            let around = bound(&mut text, surface, curve);
            text.add(144, format!("{surface},1,0,{around}"));
        }
        let found = measured(&text);
        let counts = (found.brep.edges.len(), found.brep.vertices.len(), found.brep.shells.len());
        assert_eq!((counts, found.brep.solids.len()), ((12, 8, 1), 0), "{turned}");
        assert!((found.volume - 24.0).abs() < 1e-4, "{turned}: {}", found.volume);
        let told = found.file.warnings.iter().map(ToString::to_string).collect::<String>();
        assert!(told.contains("6 face(s) are surfaces of no solid, in sheets of which 1 close"), "{told}");
    }
}

/// A band around a sphere has its seam within it, whichever way its loop runs: the rest of the sphere would be bounded as well.
#[test]
fn a_seam_tells_the_side_of_a_ball() {
    let height = 1.2f64;
    let radius = (4.0 - height * height).sqrt();
    for up in [true, false] {
        let mut text = Text::new();
        let axis = line(&mut text, [0.0; 3], [0.0, 0.0, 1.0]);
        let turn = text.add(124, list([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0]));
        let half = text.add(100, "0.,0.,0.,0.,-2.,0.,2.");
        text.placed(turn);
        let surface = text.add(120, format!("{axis},{half},0.,{}", 2.0 * PI));
        let ring = circle(&mut text, [0.0, 0.0, height], radius, 0.0);
        // Along the meridian of the seam from the ring to a pole, and back.
        let pole = if up { 2.0 } else { -2.0 };
        let meridian = |text: &mut Text, from: [f64; 2], to: [f64; 2]| {
            let number = text.add(100, list([vec![0.0, 0.0, 0.0], from.to_vec(), to.to_vec()].concat()));
            text.placed(turn);
            number
        };
        let ends = [[radius, height], [0.0, pole]];
        let ways = if up { [ends[0], ends[1]] } else { [ends[1], ends[0]] };
        let arcs = [meridian(&mut text, ways[0], ways[1]), meridian(&mut text, ways[0], ways[1])];
        let all = text.add(102, format!("3,{ring},{},{}", arcs[0], arcs[1]));
        let around = bound(&mut text, surface, all);
        text.add(144, format!("{surface},1,0,{around}"));
        let wanted = 4.0 * PI * if up { 2.0 - height } else { 2.0 + height };
        assert!(near(measured(&text).area(), wanted), "{up}: {} {wanted}", measured(&text).area());
    }
}
