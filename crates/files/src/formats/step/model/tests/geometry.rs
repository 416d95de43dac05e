//! Curves and surfaces of every kind.

use super::{faces, model, near, part};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_cad::brep::{Bounds, Edge};
use trueness_cad::curve::Curve;
use trueness_cad::surface::Surface;
use trueness_geom::space::Point;

/// The surface of a face whose only bound is a vertex, and whether its normal is turned.
fn surface(entities: &str) -> (Surface, bool) {
    let text = part(
        "#50",
        &format!(
            "#50=OPEN_SHELL('',(#51));\n#51=ADVANCED_FACE('face',(#52),#100,.T.);\n#52=FACE_BOUND('',#53,.T.);\n\
             #53=VERTEX_LOOP('',#54);\n#54=VERTEX_POINT('',#5);\n{entities}"
        ),
    );
    let face = faces(&text).remove(0);
    assert_eq!((face.entity, &face.name[..]), (51, "face"));
    (face.surface, face.reversed)
}

const AXES: &str = "#90=CARTESIAN_POINT('',(1.,2.,3.));\n#91=AXIS2_PLACEMENT_3D('',#90,#6,#7);\n";

/// Of an entity the places at some parameters.
type Case = (&'static str, &'static [([f64; 2], Point)]);

#[test]
fn surfaces_are_where_they_are_stated_to_be() {
    // Axes at (1, 2, 3): the first along y, the second along z, the third along x.
    let cases: [Case; 12] = [
        ("#100=PLANE('',#91);", &[([4.0, 5.0], [1.0, 6.0, 8.0])]),
        ("#100=CYLINDRICAL_SURFACE('',#91,2.);", &[([FRAC_PI_2, 5.0], [6.0, 2.0, 5.0])]),
        ("#100=CONICAL_SURFACE('',#91,2.,0.785398163397448);", &[([0.0, 5.0], [6.0, 9.0, 3.0])]),
        (
            "#100=SPHERICAL_SURFACE('',#91,2.);",
            &[([0.0, FRAC_PI_2], [3.0, 2.0, 3.0]), ([FRAC_PI_2, 0.0], [1.0, 2.0, 5.0])],
        ),
        (
            "#100=TOROIDAL_SURFACE('',#91,5.,2.);",
            &[([0.0, 0.0], [1.0, 9.0, 3.0]), ([0.0, FRAC_PI_2], [3.0, 7.0, 3.0])],
        ),
        ("#100=DEGENERATE_TOROIDAL_SURFACE('',#91,1.,2.,.T.);", &[([0.0, 0.0], [1.0, 5.0, 3.0])]),
        ("#100=DEGENERATE_TOROIDAL_SURFACE('',#91,1.,2.,.F.);", &[([0.0, 0.0], [1.0, 3.0, 3.0])]),
        (
            "#100=SURFACE_OF_LINEAR_EXTRUSION('',#101,#102);\n#101=CIRCLE('',#91,2.);\n#102=VECTOR('',#6,3.);",
            &[([0.0, 2.0], [7.0, 4.0, 3.0])],
        ),
        (
            "#100=SURFACE_OF_REVOLUTION('',#101,#102);\n#101=LINE('',#90,#103);\n#103=VECTOR('',#8,2.);\n#102=AXIS1_PLACEMENT('',#5,#8);",
            &[([FRAC_PI_2, 3.0], [-2.0, 1.0, 9.0])],
        ),
        (
            "#100=OFFSET_SURFACE('',#101,-0.5,.F.);\n#101=CYLINDRICAL_SURFACE('',#91,2.);",
            &[([0.0, 4.0], [5.0, 3.5, 3.0])],
        ),
        (
            "#100=SURFACE_REPLICA('',#101,#102);\n#101=CYLINDRICAL_SURFACE('',#91,2.);\n#102=CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,$,$,$,#90,2.,$);",
            &[([0.0, 0.0], [3.0, 10.0, 9.0])],
        ),
        (
            "#100=(BOUNDED_SURFACE()B_SPLINE_SURFACE(1,1,((#5,#101),(#102,#103)),.U.,.F.,.F.,.U.)B_SPLINE_SURFACE_WITH_KNOTS((2,2),(2,2),(0.,1.),(0.,2.),.U.)\
          GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE(((1.,1.),(3.,3.)))REPRESENTATION_ITEM('')SURFACE());\n\
          #101=CARTESIAN_POINT('',(0.,4.,0.));\n#102=CARTESIAN_POINT('',(4.,0.,0.));\n#103=CARTESIAN_POINT('',(4.,4.,0.));",
            &[([0.5, 1.0], [3.0, 2.0, 0.0])],
        ),
    ];
    for (entities, places) in cases {
        let (surface, reversed) = surface(&format!("{AXES}{entities}"));
        for (at, place) in places {
            assert!(near(surface.at(at[0], at[1]), *place), "{entities}: {:?}", surface.at(at[0], at[1]));
        }
        assert_eq!(reversed, entities.contains(".F.);") && entities.contains("DEGENERATE"), "{entities}");
    }
}

/// Both parts of a spindle torus end on the axis at ±√3.
#[test]
fn the_parts_of_a_spindle_torus() {
    for (word, major, pole) in [(".T.", 1.0, TAU / 3.0), (".F.", -1.0, TAU / 6.0)] {
        let (surface, _) = surface(&format!("{AXES}#100=DEGENERATE_TOROIDAL_SURFACE('',#91,1.,2.,{word});"));
        assert!(matches!(surface, Surface::Torus { major: m, minor: 2.0, .. } if m == major));
        let [_, [low, high]] = surface.domain();
        assert!((low + pole).abs() < 1e-15 && (high - pole).abs() < 1e-15);
        assert!(near(surface.at(1.0, high), [1.0 + 3f64.sqrt(), 2.0, 3.0]));
    }
}

/// The edges of a loop of one face; the surface does not matter.
fn edges(entities: &str, loops: &str) -> Vec<Edge> {
    let text = part(
        "#50",
        &format!(
            "#50=OPEN_SHELL('',(#51));\n#51=ADVANCED_FACE('',(#52),#55,.T.);\n#52=FACE_BOUND('',#53,.T.);\n\
             #53=EDGE_LOOP('',({loops}));\n#55=PLANE('',#9);\n{AXES}{entities}"
        ),
    );
    model(&text).parts.remove(0).brep.edges
}

/// An edge on a curve from the first point to the second and back on a line, or closed.
fn edge(curve: &str, ends: [Point; 2], same: bool) -> Edge {
    let [[a, b, c], [d, e, f]] = ends;
    let same = if same { ".T." } else { ".F." };
    let last = if ends[0] == ends[1] { "#80" } else { "#81" };
    let back = if ends[0] == ends[1] { "" } else { ",#63" };
    let entities = format!(
        "#60=ORIENTED_EDGE('',*,*,#70,.T.);\n#63=ORIENTED_EDGE('',*,*,#71,.F.);\n#70=EDGE_CURVE('',#80,{last},#100,{same});\n\
         #71=EDGE('',#80,#81);\n#80=VERTEX_POINT('',#82);\n#81=VERTEX_POINT('',#83);\n#82=CARTESIAN_POINT('',({a:?},{b:?},{c:?}));\n\
         #83=CARTESIAN_POINT('',({d:?},{e:?},{f:?}));\n{curve}"
    );
    edges(&entities, &format!("#60{back}")).remove(0)
}

/// Of an entity with its axes at (1, 2, 3), the first along y, the second along z: the ends of an edge, whether it has the sense of the
/// curve, and the place halfway in its parameters.
type Bow = (&'static str, [Point; 2], bool, Point);

#[test]
fn edges_go_from_vertex_to_vertex_the_way_of_their_sense() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let right = [1.0, 4.0, 3.0];
    let top = [1.0, 2.0, 5.0];
    let circle = "#100=CIRCLE('',#91,2.);";
    let bezier = "#100=BEZIER_CURVE('',2,(#101,#102,#103),.U.,.F.,.U.);\n#101=CARTESIAN_POINT('',(0.,0.,0.));\n\
        #102=CARTESIAN_POINT('',(2.,2.,0.));\n#103=CARTESIAN_POINT('',(4.,0.,0.));";
    let carried = "#100=SURFACE_CURVE('',#104,(#55),.CURVE_3D.);\n#104=CIRCLE('',#91,2.);";
    let complex = "#100=(BOUNDED_CURVE()CURVE()GEOMETRIC_REPRESENTATION_ITEM()REPRESENTATION_ITEM('')SURFACE_CURVE(#104,(#55),.CURVE_3D.));\n\
        #104=CIRCLE('',#91,2.);";
    let trimmed = "#100=TRIMMED_CURVE('',#104,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.F.,.PARAMETER.);\n#104=CIRCLE('',#91,2.);";
    let replica = "#100=CURVE_REPLICA('',#104,#105);\n#104=CIRCLE('',#9,1.);\n#105=CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,$,#7,#8,#90,2.,#6);";
    let quarter = [1.0, 2.0 + 2.0 * half, 3.0 + 2.0 * half];
    let opposite = [1.0, 2.0 - 2.0 * half, 3.0 - 2.0 * half];
    let cases: Vec<Bow> = vec![
        (circle, [right, top], true, quarter),
        (circle, [top, right], false, quarter),
        (circle, [right, top], false, opposite),
        (circle, [right, right], true, [1.0, 0.0, 3.0]),
        (circle, [top, top], false, [1.0, 2.0, 1.0]),
        (carried, [right, top], true, quarter),
        (complex, [right, top], true, quarter),
        (trimmed, [right, top], true, opposite),
        (trimmed, [right, top], false, quarter),
        (replica, [right, top], true, quarter),
        ("#100=LINE('',#90,#101);\n#101=VECTOR('',#7,7.);", [right, [1.0, 8.0, 3.0]], false, [1.0, 6.0, 3.0]),
        (
            "#100=ELLIPSE('',#91,3.,2.);",
            [[1.0, 5.0, 3.0], top],
            true,
            [1.0, 2.0 + 3.0 * half, 3.0 + 2.0 * half],
        ),
        ("#100=PARABOLA('',#91,2.);", [[1.0, 2.0, 3.0], [1.0, 4.0, 7.0]], true, [1.0, 2.5, 5.0]),
        (bezier, [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0]], true, [2.0, 1.0, 0.0]),
        (bezier, [[4.0, 0.0, 0.0], [2.0, 1.0, 0.0]], false, [3.0, 0.75, 0.0]),
        (
            "#100=POLYLINE('',(#5,#101,#102));\n#101=CARTESIAN_POINT('',(4.,0.,0.));\n#102=CARTESIAN_POINT('',(4.,2.,0.));",
            [[2.0, 0.0, 0.0], [4.0, 1.0, 0.0]],
            true,
            [4.0, 0.0, 0.0],
        ),
        ("#100=OFFSET_CURVE_3D('',#101,1.,.F.,#6);\n#101=CIRCLE('',#91,3.);", [right, top], true, quarter),
    ];
    for (curve, ends, same, middle) in cases {
        let edge = edge(curve, ends, same);
        let [from, to] = edge.span.ends();
        let halfway = edge.span.derivatives(0.5)[0];
        assert!(near(from, ends[0]) && near(to, ends[1]), "{curve}: {:?}", edge.span);
        assert!(near(halfway, middle), "{curve}: {halfway:?} {:?}", edge.span);
    }
}

#[test]
fn a_hyperbola_runs_along_its_first_axis() {
    let at = |t: f64| [1.0, 2.0 + 3.0 * t.cosh(), 3.0 + 2.0 * t.sinh()];
    let edge = edge("#100=HYPERBOLA('',#91,3.,2.);", [at(-1.0), at(2.0)], true);
    assert!(edge.span.ends().iter().zip([at(-1.0), at(2.0)]).all(|(a, b)| near(*a, b)));
    assert!((edge.span.range[0] + 1.0).abs() < 1e-12 && (edge.span.range[1] - 2.0).abs() < 1e-12);
}

/// A square with rounded corners as one closed spline: edges may begin anywhere and pass its ends.
#[test]
fn edges_pass_over_the_ends_of_closed_splines() {
    let corners = [
        "(2.,0.,0.)",
        "(2.,2.,0.)",
        "(0.,2.,0.)",
        "(-2.,2.,0.)",
        "(-2.,0.,0.)",
        "(-2.,-2.,0.)",
        "(0.,-2.,0.)",
        "(2.,-2.,0.)",
    ];
    let points: String =
        (0..8).map(|k| format!("#{}=CARTESIAN_POINT('',{});\n", 110 + k, corners[k])).collect();
    let curve = format!(
        "#100=B_SPLINE_CURVE_WITH_KNOTS('',2,(#110,#111,#112,#113,#114,#115,#116,#117,#110),.U.,.T.,.F.,(3,2,2,2,3),(0.,1.,2.,3.,4.),.U.);\n{points}"
    );
    let (right, top, low) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, -2.0, 0.0]);
    let ranges = [
        ([right, right], true, [0.0, 4.0]),
        ([right, right], false, [4.0, 0.0]),
        ([right, top], true, [0.0, 1.0]),
        ([low, right], true, [3.0, 4.0]),
        ([right, low], false, [4.0, 3.0]),
        ([right, top], false, [4.0, 1.0]),
    ];
    for (ends, same, range) in ranges {
        let span = edge(&curve, ends, same).span;
        assert!((0..2).all(|k| (span.range[k] - range[k]).abs() < 1e-9), "{ends:?} {same}: {:?}", span.range);
    }
    for (ends, same, first) in
        [([low, top], true, [3.0, 4.0]), ([top, low], false, [1.0, 0.0]), ([top, top], true, [1.0, 4.0])]
    {
        let Curve::Joined(spans) = edge(&curve, ends, same).span.curve else { panic!("it passes the ends") };
        assert!((0..2).all(|k| (spans[0].range[k] - first[k]).abs() < 1e-9), "{:?}", spans[0].range);
        assert!(near(spans[1].ends()[0], right) && near(spans[1].ends()[1], ends[1]));
    }
}

#[test]
fn chains_of_curves_are_joined() {
    let curve = "#100=COMPOSITE_CURVE('',(#101,#102),.F.);\n#101=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#103);\n\
        #102=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.F.,#104);\n\
        #103=TRIMMED_CURVE('',#105,(#106,PARAMETER_VALUE(9.)),(#107),.T.,.CARTESIAN.);\n#105=CIRCLE('',#9,2.);\n\
        #106=CARTESIAN_POINT('',(2.,0.,0.));\n#107=CARTESIAN_POINT('',(0.,2.,0.));\n#104=POLYLINE('',(#108,#107));\n\
        #108=CARTESIAN_POINT('',(-4.,2.,0.));";
    let span = edge(curve, [[2.0, 0.0, 0.0], [-4.0, 2.0, 0.0]], true).span;
    assert_eq!(span.range, [0.0, 2.0]);
    assert!(near(span.curve.at(1.0), [0.0, 2.0, 0.0]) && near(span.curve.at(1.5), [-2.0, 2.0, 0.0]));
}

/// The same in degrees and inches.
#[test]
fn angles_and_lengths_are_in_the_units_of_the_file() {
    let text = part(
        "#50",
        "#50=GEOMETRIC_SET('',(#51,#52));\n#51=RECTANGULAR_TRIMMED_SURFACE('',#53,0.,90.,1.,2.,.T.,.T.);\n\
         #53=CONICAL_SURFACE('',#9,1.,45.);\n#52=RECTANGULAR_TRIMMED_SURFACE('',#54,270.,90.,45.,-45.,.T.,.F.);\n#54=SPHERICAL_SURFACE('',#9,1.);",
    );
    let degrees = "#2=(CONVERSION_BASED_UNIT('DEGREE',#20)NAMED_UNIT(*)PLANE_ANGLE_UNIT());\n\
        #20=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.01745329252),#21);\n#21=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));";
    let inches = "#1=(CONVERSION_BASED_UNIT('INCH',#22)LENGTH_UNIT()NAMED_UNIT(*));\n\
        #22=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.54),#23);\n#23=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));";
    let text = text.replace("#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));", degrees);
    let text = text.replace("#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));", inches);
    let found = faces(&text);
    assert!(
        matches!(found[0].surface, Surface::Cone { radius: 25.4, half_angle, .. } if half_angle == PI / 4.0)
    );
    assert_eq!(found[0].bounds, Bounds::Rectangle([[0.0, FRAC_PI_2], [25.4, 50.8]]));
    assert!(!found[0].reversed && found[1].reversed);
    let Bounds::Rectangle([u, v]) = found[1].bounds else { panic!("a rectangle") };
    assert!((u[0] - 1.5 * PI).abs() < 1e-14 && (u[1] - 2.5 * PI).abs() < 1e-14, "{u:?}");
    assert!((v[0] + PI / 4.0).abs() < 1e-14 && (v[1] - PI / 4.0).abs() < 1e-14, "{v:?}");
    assert!((model(&text).uncertainty.unwrap() - 25.4e-4).abs() < 1e-18);
}
