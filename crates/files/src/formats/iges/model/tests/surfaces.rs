//! Surfaces with ends, and the curves that they are made of.

use super::super::super::written::{Text, list};
use super::{bound, circle, line, measured, near, plane};
use std::f64::consts::{FRAC_PI_2, PI};
use trueness_cad::surface::{Surface, SurfaceKind};

fn kind(text: &Text) -> SurfaceKind {
    measured(text).brep.faces[0].surface.kind()
}

#[test]
fn turned_lines_and_arcs_have_their_areas() {
    let mut text = Text::new();
    let axis = line(&mut text, [1.0, 0.0, -3.0], [1.0, 0.0, 5.0]);
    let profile = line(&mut text, [3.0, 0.0, 0.0], [3.0, 0.0, 4.0]);
    text.add(120, format!("{axis},{profile},0.25,1.75"));
    assert!(near(measured(&text).area(), 1.5 * 2.0 * 4.0));
    assert_eq!(kind(&text), SurfaceKind::Revolution);
    // A whole turn, with the six digits of some programs.
    let mut text = Text::new();
    let axis = line(&mut text, [0.0; 3], [0.0, 0.0, 1.0]);
    let profile = line(&mut text, [2.0, 0.0, 0.0], [1.0, 0.0, 3.0]);
    text.add(120, format!("{axis},{profile},0.,6.28318"));
    assert!(near(measured(&text).area(), PI * 3.0 * 10.0f64.sqrt()));
}

/// The normal of a surface of revolution is that of its curve's direction and of the turn, in this order.
#[test]
fn normals_are_those_of_the_parameters_of_the_file() {
    let mut text = Text::new();
    let axis = line(&mut text, [0.0; 3], [0.0, 0.0, 1.0]);
    let profile = line(&mut text, [2.0, 0.0, 0.0], [2.0, 0.0, 3.0]);
    text.add(120, format!("{axis},{profile},0.,{PI}"));
    let found = measured(&text);
    let face = &found.brep.faces[0];
    // Along z, then around z: inward.
    let [x, y, _] = face.surface.normal(FRAC_PI_2, 0.5).unwrap().map(|n| if face.reversed { -n } else { n });
    assert!(x.abs() < 1e-12 && near(y, -1.0));
}

#[test]
fn tabulated_cylinders_follow_their_curve() {
    for (range, turn) in [([0.0, 1.0], 1.0), ([5.9, 7.1], 1.2)] {
        let mut text = Text::new();
        let p = |t: f64| [2.0 * t.cos(), 2.0 * t.sin()];
        let ends = [p(range[0]), p(range[1])].concat();
        let arc = text.add(100, format!("1.,0.,0.,{}", list(ends.clone())));
        text.add(122, format!("{arc},{},{},5.", ends[0], ends[1]));
        let found = measured(&text);
        assert!(near(found.area(), turn * 2.0 * 4.0), "{range:?} {}", found.area());
        assert!(near(found.bounds.min[2], 1.0) && near(found.bounds.max[2], 5.0));
    }
}

#[test]
fn ruled_surfaces_of_lines_arcs_and_splines() {
    let mut text = Text::new();
    let [a, b] = [0.0, 3.0].map(|y| line(&mut text, [0.0, y, 0.0], [2.0, y, 0.0]));
    text.form(118, 1, format!("{a},{b},0,1"));
    assert!(near(measured(&text).area(), 6.0));
    // Backwards: two triangles of a hyperbolic paraboloid; the middle is where all rulings meet.
    let mut text = Text::new();
    let [a, b] = [0.0, 3.0].map(|y| line(&mut text, [0.0, y, y], [2.0, y, y]));
    text.form(118, 1, format!("{a},{b},1,0"));
    let Surface::Spline(nurbs) = &super::read(&text).model.parts[0].brep.faces[0].surface.clone() else {
        panic!()
    };
    for u in [0.0, 0.3, 1.0] {
        let p = nurbs.at(u, 0.5).unwrap();
        assert!(near(p[0], 1.0) && near(p[1], 1.5) && near(p[2], 1.5));
    }
    // Two arcs of as many radians: a cone.
    let mut text = Text::new();
    let arcs = [(2.0, 0.0), (1.0, 3.0)].map(|(r, z): (f64, f64)| {
        text.add(100, list([z, 0.0, 0.0, r, 0.0, r * 2.0f64.cos(), r * 2.0f64.sin()]))
    });
    text.form(118, 0, format!("{},0,1", list(arcs)));
    assert!(near(measured(&text).area(), 0.5 * 2.0 * 3.0 * 10.0f64.sqrt()));
    // A point and a spline in one plane: a triangle.
    let mut text = Text::new();
    let point = text.add(116, "0.,0.,0.,0");
    let spline =
        text.add(126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,0.,0.,1.,1.,0.,1.,2.,0.,0.,1.,0.,0.,1.");
    text.form(118, 1, format!("{point},{spline},0,0"));
    assert!(near(measured(&text).area(), 1.0));
    // An arc and a line by their parameters are no splines: told.
    let mut text = Text::new();
    let a = circle(&mut text, [0.0; 3], 1.0, 0.0);
    let b = line(&mut text, [1.0, 0.0, 1.0], [2.0, 0.0, 1.0]);
    text.form(118, 1, format!("{a},{b},0,0"));
    let error = super::read_bytes(text.bytes()).unwrap_err().to_string();
    assert!(error.contains("joins an arc"), "{error}");
}

/// z = s t + 2 s³ − t² in two by two patches, some programs without the patches that have no meaning.
#[test]
fn parametric_spline_surfaces_are_exact() {
    let breaks = [[0.0, 0.5, 2.0], [1.0, 1.5, 4.0]];
    // Derivatives about the corner of a patch.
    let patch = |u: f64, v: f64| {
        let mut z = [0.0; 16];
        (z[0], z[1], z[2], z[3]) = (u * v + 2.0 * u * u * u - v * v, v + 6.0 * u * u, 6.0 * u, 2.0);
        (z[4], z[5], z[8]) = (u - 2.0 * v, 1.0, -1.0);
        let (mut x, mut y) = ([0.0; 16], [0.0; 16]);
        (x[0], x[1], y[0], y[4]) = (u, 1.0, v, 1.0);
        [x, y, z].concat()
    };
    for filling in [true, false] {
        let mut numbers = vec![];
        for i in 0..if filling { 3 } else { 2 } {
            for j in 0..if filling { 3 } else { 2 } {
                let own = if i < 2 && j < 2 { patch(breaks[0][i], breaks[1][j]) } else { vec![9.9; 48] };
                numbers.extend(own);
            }
        }
        let mut text = Text::new();
        text.add(114, format!("3,1,2,2,{},{}", list(breaks.concat()), list(numbers)));
        let found = super::read(&text);
        let Surface::Spline(nurbs) = &found.model.parts[0].brep.faces[0].surface else { panic!() };
        for (u, v) in [(0.0, 1.0), (0.2, 1.3), (0.5, 3.0), (1.7, 1.5), (2.0, 4.0)] {
            let [x, y, z] = nurbs.at(u, v).unwrap();
            let wanted = u * v + 2.0 * u * u * u - v * v;
            assert!(near(x, u) && near(y, v) && near(z, wanted), "{u} {v}: {z} {wanted}");
        }
    }
}

/// A parametric spline (y = s², by the breaks of two segments) that is moved.
#[test]
fn parametric_spline_curves_are_exact() {
    let mut text = Text::new();
    let segment = |u: f64| list([[u, 1.0, 0.0, 0.0], [u * u, 2.0 * u, 1.0, 0.0], [0.0; 4]].concat());
    let end = list([0.0; 12]);
    let curve = text.add(112, format!("3,1,3,2,0.,1.,3.,{},{},{end}", segment(0.0), segment(1.0)));
    text.add(122, format!("{curve},0.,0.,2."));
    let length = |x: f64| 0.5 * x * (1.0 + 4.0 * x * x).sqrt() + 0.25 * (2.0 * x).asinh();
    assert!(near(measured(&text).area(), 2.0 * length(3.0)));
}

#[test]
fn offsets_lie_on_the_side_of_their_direction() {
    for (direction, radius) in [("0.,1.,0.", 2.5), ("0.,-1.,0.", 1.5)] {
        let mut text = Text::new();
        let axis = line(&mut text, [0.0; 3], [0.0, 0.0, 1.0]);
        let profile = line(&mut text, [2.0, 0.0, 0.0], [2.0, 0.0, 4.0]);
        let cylinder = text.add(120, format!("{axis},{profile},0.,{PI}"));
        text.add(140, format!("{direction},0.5,{cylinder}"));
        let found = measured(&text);
        assert!(near(found.area(), PI * radius * 4.0), "{direction}: {}", found.area());
        assert_eq!(found.brep.faces[0].surface.kind(), SurfaceKind::Offset);
    }
    // Of an unbounded plane, without a face: no shape.
    let mut text = Text::new();
    let basis = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
    text.add(140, format!("0.,0.,1.,2.,{basis}"));
    assert!(super::read_bytes(text.bytes()).unwrap_err().to_string().contains("no shape"));
}

#[test]
fn spheres_and_tori_without_borders_are_whole() {
    let mut text = Text::new();
    let center = text.add(116, "1.,2.,3.,0");
    text.add(196, format!("{center},2."));
    assert!(near(measured(&text).area(), 16.0 * PI) && near(measured(&text).volume, 32.0 / 3.0 * PI));
    let mut text = Text::new();
    let center = text.add(116, "1.,2.,3.,0");
    let axis = text.add(123, "0.,1.,1.");
    text.add(198, format!("{center},{axis},3.,1."));
    assert!(near(measured(&text).area(), 12.0 * PI * PI));
}

/// Conics around a plane: ellipses turned and moved, and what parabola and hyperbola cut off.
#[test]
fn conics_bound_their_areas() {
    // (x' / 3)² + (y' / 2)² = 1, turned by an angle and moved.
    let (angle, at): (f64, [f64; 2]) = (0.7, [4.0, -1.0]);
    let (c, s) = (angle.cos(), angle.sin());
    let [p, q] = [1.0 / 9.0, 1.0 / 4.0];
    let (a, b, cc) = (p * c * c + q * s * s, 2.0 * (p - q) * c * s, p * s * s + q * c * c);
    let (d, e) = (-2.0 * a * at[0] - b * at[1], -2.0 * cc * at[1] - b * at[0]);
    let f = a * at[0] * at[0] + b * at[0] * at[1] + cc * at[1] * at[1] - 1.0;
    let place = |t: f64| {
        [at[0] + 3.0 * t.cos() * c - 2.0 * t.sin() * s, at[1] + 3.0 * t.cos() * s + 2.0 * t.sin() * c]
    };
    let whole = |ends: [[f64; 2]; 2]| list([vec![a, b, cc, d, e, f, 5.0], ends.concat()].concat());
    let mut text = Text::new();
    let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0, 0.0, 5.0]);
    let curve = text.form(104, 1, whole([place(0.4), place(0.4)]));
    let around = bound(&mut text, surface, curve);
    text.add(144, format!("{surface},1,0,{around}"));
    assert!(near(measured(&text).area(), 6.0 * PI), "{}", measured(&text).area());
    // Half of it, from one end of the long axis against the clock to the other.
    let mut text = Text::new();
    let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0, 0.0, 5.0]);
    let half = text.form(104, 1, whole([place(0.0), place(PI)]));
    let ends = [place(PI), place(0.0)].map(|[x, y]| [x, y, 5.0]);
    let back = line(&mut text, ends[0], ends[1]);
    let curve = text.add(102, format!("2,{half},{back}"));
    let around = bound(&mut text, surface, curve);
    text.add(144, format!("{surface},1,0,{around}"));
    assert!(near(measured(&text).area(), 3.0 * PI));
    // y = x² up to y = 4, and x = √(1 + y²) up to y = ±1: the second is turned in the file by its sign alone.
    let cases = [
        ([1.0, 0.0, 0.0, 0.0, -1.0, 0.0], [[-2.0, 4.0], [2.0, 4.0]], 32.0 / 3.0),
        ([-1.0, 0.0, 0.0, 0.0, 1.0, 0.0], [[2.0, 4.0], [-2.0, 4.0]], 32.0 / 3.0),
        (
            [1.0, 0.0, -1.0, 0.0, 0.0, -1.0],
            [[2f64.sqrt(), -1.0], [2f64.sqrt(), 1.0]],
            2f64.sqrt() - 1f64.asinh(),
        ),
        (
            [1.0, 0.0, -1.0, 0.0, 0.0, -1.0],
            [[-2f64.sqrt(), -1.0], [-2f64.sqrt(), 1.0]],
            2f64.sqrt() - 1f64.asinh(),
        ),
        ([0.0, 1.0, 0.0, 0.0, 0.0, -1.0], [[0.5, 2.0], [2.0, 0.5]], 1.875 - 2.0 * 2f64.ln()),
    ];
    for (form, ends, area) in cases {
        let mut text = Text::new();
        let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
        let curve = text.add(104, list([form.to_vec(), vec![0.0], ends.concat()].concat()));
        let back = line(&mut text, [ends[1][0], ends[1][1], 0.0], [ends[0][0], ends[0][1], 0.0]);
        let all = text.add(102, format!("2,{curve},{back}"));
        let around = bound(&mut text, surface, all);
        text.add(144, format!("{surface},1,0,{around}"));
        assert!(near(measured(&text).area(), area), "{form:?}: {} {area}", measured(&text).area());
    }
}

#[test]
fn points_and_offsets_of_lines_and_circles() {
    for (form, tuple, numbers) in
        [(11, 1, "7.,0.,0.,4.,0.,4.,3.,0.,0."), (12, 2, "0.,0.,7.,4.,0.,7.,4.,3.,7.,0.,0.,7.")]
    {
        let mut text = Text::new();
        let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0, 0.0, 7.0]);
        let curve = text.form(106, form, format!("{tuple},4,{numbers}"));
        let around = bound(&mut text, surface, curve);
        text.add(144, format!("{surface},1,0,{around}"));
        assert!(near(measured(&text).area(), 6.0), "{form}");
    }
    // A disk of radius 3, whose border is the offset of a circle of radius 2 outward.
    let mut text = Text::new();
    let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
    let basis = circle(&mut text, [0.0; 3], 2.0, 0.0);
    let curve = text.add(130, format!("{basis},1,0,0,0,-1.,0.,0.,0.,0.,0.,1.,0.,{}", 2.0 * PI));
    let around = bound(&mut text, surface, curve);
    text.add(144, format!("{surface},1,0,{around}"));
    assert!(near(measured(&text).area(), 9.0 * PI));
}
