//! Products, instances, placements, names, colors.

use super::{model, near, part, read, whole};
use trueness_cad::surface::Surface;

/// A product: its definition is `#{n}1`, its representation `#{n}4`.
pub(super) fn product(n: u32, name: &str, items: &str) -> String {
    format!(
        "#{n}0=PRODUCT('id','{name}','',());\n#{n}2=PRODUCT_DEFINITION_FORMATION('','',#{n}0);\n#{n}1=PRODUCT_DEFINITION('','',#{n}2,$);\n\
         #{n}3=PRODUCT_DEFINITION_SHAPE('','',#{n}1);\n#{n}5=SHAPE_DEFINITION_REPRESENTATION(#{n}3,#{n}4);\n\
         #{n}4=SHAPE_REPRESENTATION('',({items}),#4);\n"
    )
}

/// An occurrence of `child` in `parent`; the transformation goes from item `from` to item `to`. `turned` names the parent first.
pub(super) fn occurrence(n: u32, [parent, child]: [u32; 2], [from, to]: [&str; 2], turned: bool) -> String {
    let [a, b] = if turned { [parent, child] } else { [child, parent] };
    format!(
        "#{n}0=NEXT_ASSEMBLY_USAGE_OCCURRENCE('o{n}','occurrence {n}','',#{parent}1,#{child}1,$);\n#{n}1=PRODUCT_DEFINITION_SHAPE('','',#{n}0);\n\
         #{n}2=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{n}3,#{n}1);\n#{n}3=(REPRESENTATION_RELATIONSHIP('','',#{a}4,#{b}4)\
         REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{n}4)SHAPE_REPRESENTATION_RELATIONSHIP());\n\
         #{n}4=ITEM_DEFINED_TRANSFORMATION('','',{from},{to});\n"
    )
}

/// Units, axes, a sphere of radius 1 as item `#80`, and axes `#70` at (10, 0, 0), turned by a quarter about z.
pub(super) fn base() -> String {
    part("#9", "").split("DATA;\n").nth(1).unwrap().split("#10=").next().unwrap().to_string()
        + "#70=AXIS2_PLACEMENT_3D('',#71,#8,#7);\n#71=CARTESIAN_POINT('',(10.,0.,0.));\n#80=MANIFOLD_SOLID_BREP('ball',#81);\n#81=CLOSED_SHELL('',(#82));\n\
           #82=ADVANCED_FACE('',(#83),#86,.T.);\n#83=FACE_BOUND('',#84,.T.);\n#84=VERTEX_LOOP('',#85);\n#85=VERTEX_POINT('',#87);\n\
           #86=SPHERICAL_SURFACE('',#88,1.);\n#87=CARTESIAN_POINT('',(5.,0.,1.));\n#88=AXIS2_PLACEMENT_3D('',#89,#8,#6);\n#89=CARTESIAN_POINT('',(5.,0.,0.));\n"
}

#[test]
fn parts_stand_where_the_products_say() {
    // Twice the same step: ten along x, a quarter turn.
    for turned in [false, true] {
        let text = whole(
            &(base()
                + &product(100, "ball", "#9,#80")
                + &product(101, "sub", "#9,#70")
                + &product(102, "top", "#9,#70")
                + &occurrence(200, [101, 100], ["#9", "#70"], false)
                + &occurrence(201, [102, 101], ["#9", "#70"], false)
                + &occurrence(202, [102, 100], ["#70", "#70"], turned)),
        );
        let found = model(&text);
        assert_eq!((found.parts.len(), found.instances.len(), found.depth), (1, 2, 2), "{text}");
        assert_eq!(found.instances[0].path, ["top", "occurrence 201", "occurrence 200"]);
        let all = found.assembled();
        let center = |surface: &Surface| match surface {
            Surface::Sphere { frame, .. } => frame.origin,
            _ => panic!("a sphere"),
        };
        let centers: Vec<_> = all.faces.iter().map(|f| center(&f.surface)).collect();
        // (5, 0, 0) → (10, 5, 0) → (5, 10, 0).
        assert!(near(centers[0], [5.0, 10.0, 0.0]) && near(centers[1], [5.0, 0.0, 0.0]), "{centers:?}");
        assert_eq!((all.solids.len(), &all.solids[0].name[..]), (2, "ball"));
    }
}

/// Each entity of a chain of products left out in turn: both balls stand where they were, or the model is not complete.
#[test]
fn a_broken_chain_of_products_is_told() {
    let chain = product(100, "ball", "#9,#80")
        + &product(101, "sub", "#9,#70")
        + &product(102, "top", "#9,#70")
        + &occurrence(200, [101, 100], ["#9", "#70"], false)
        + &occurrence(201, [102, 101], ["#9", "#70"], false)
        + &occurrence(202, [102, 100], ["#70", "#70"], false);
    let placed = |model: &trueness_cad::model::Model| {
        let faces = model.assembled().faces;
        let centers = faces.iter().map(|f| match &f.surface {
            Surface::Sphere { frame, .. } => frame.origin.map(|x| x.round() as i64),
            _ => panic!("a sphere"),
        });
        let mut centers: Vec<[i64; 3]> = centers.collect();
        centers.sort_unstable();
        centers
    };
    let wanted = placed(&model(&whole(&(base() + &chain))));
    let lines: Vec<&str> = chain.split_inclusive(";\n").collect();
    for left_out in 0..lines.len() {
        let rest: String = (0..lines.len()).filter(|k| *k != left_out).map(|k| lines[k]).collect();
        let Ok(found) = read(&whole(&(base() + &rest))) else { continue };
        let is_told = !found.model.is_complete();
        assert!(is_told || placed(&found.model) == wanted, "without {}", lines[left_out]);
    }
}

/// Some programs name the assembly first: the first item is then where it takes up the second.
#[test]
fn turned_relationships_are_recognized() {
    for (items, place) in [(["#9", "#70"], [0.0, 5.0, 0.0]), (["#70", "#9"], [10.0, 5.0, 0.0])] {
        let text = whole(
            &(base()
                + &product(100, "ball", "#9,#80")
                + &product(102, "top", "#70")
                + &occurrence(200, [102, 100], items, true)),
        );
        let found = model(&text);
        let Surface::Sphere { frame, .. } = found.assembled().faces[0].surface else { panic!("a sphere") };
        assert!(near(frame.origin, place), "{items:?} {:?}", frame.origin);
    }
}

#[test]
fn mapped_items_mirror_and_scale() {
    let text = whole(
        &(base()
            + &product(100, "top", "#9,#60,#61")
            + "#60=MAPPED_ITEM('first',#62,#63);\n#61=MAPPED_ITEM('',#62,#70);\n#62=REPRESENTATION_MAP(#9,#64);\n#64=SHAPE_REPRESENTATION('mapped',(#9,#80),#4);\n\
               #63=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',$,#65,#7,#71,2.,#8);\n#65=DIRECTION('',(-1.,0.,0.));\n#66=STYLED_ITEM('',(#67),#60);\n\
               #67=PRESENTATION_STYLE_ASSIGNMENT((#68));\n#68=SURFACE_STYLE_USAGE(.BOTH.,#69);\n#69=SURFACE_SIDE_STYLE('',(#75));\n\
               #75=SURFACE_STYLE_FILL_AREA(#76);\n#76=FILL_AREA_STYLE('',(#77));\n#77=FILL_AREA_STYLE_COLOUR('',#78);\n#78=DRAUGHTING_PRE_DEFINED_COLOUR('red');\n"),
    );
    let found = model(&text);
    assert_eq!((found.parts.len(), found.instances.len(), found.depth), (1, 2, 1));
    assert_eq!((found.instances[0].color, found.instances[1].color), (Some([1.0, 0.0, 0.0, 1.0]), None));
    assert_eq!(found.instances[0].path, ["top", "first"]);
    let first = &found.instances[0].placement;
    assert!(first.is_mirrored() && first.scale == 2.0 && near(first.point([5.0, 1.0, 0.0]), [0.0, 2.0, 0.0]));
    let all = found.assembled();
    assert!(matches!(all.faces[0].surface, Surface::Sphere { radius: 2.0, .. }) && all.faces[0].reversed);
    assert!(near(found.instances[1].placement.point([5.0, 0.0, 0.0]), [10.0, 5.0, 0.0]));
}

#[test]
fn replicas_of_solids_are_parts_of_their_part() {
    let text = whole(
        &(base()
            + &product(100, "two", "#80,#60")
            + "#60=SOLID_REPLICA('',#61,#62);\n#61=SOLID_REPLICA('',#80,#62);\n#62=CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,$,$,$,#71,2.,$);\n"),
    );
    let brep = model(&text).parts.remove(0).brep;
    assert_eq!((brep.solids.len(), brep.faces.len()), (2, 2));
    // (5, 0, 0) → (20, 0, 0) → (50, 0, 0).
    let Surface::Sphere { frame, radius } = brep.faces[1].surface else { panic!("a sphere") };
    assert!(near(frame.origin, [50.0, 0.0, 0.0]) && radius == 4.0);
}

/// A part in inches in an assembly in millimeters.
#[test]
fn each_representation_has_its_units() {
    let inches = "#40=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#41))REPRESENTATION_CONTEXT('',''));\n\
        #41=(CONVERSION_BASED_UNIT('INCH',#42)LENGTH_UNIT()NAMED_UNIT(*));\n#42=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#1);\n";
    let ball = product(100, "ball", "#9,#80").replace(",#4);", ",#40);");
    let text = whole(
        &(base()
            + inches
            + &ball
            + &product(102, "top", "#70")
            + &occurrence(200, [102, 100], ["#9", "#70"], false)),
    );
    let Surface::Sphere { frame, radius } = model(&text).assembled().faces[0].surface else {
        panic!("a sphere")
    };
    assert!(near(frame.origin, [10.0, 127.0, 0.0]) && radius == 25.4, "{frame:?}");
}

#[test]
fn faces_have_the_color_of_the_nearest_that_has_one() {
    let style = |n: u32, item: &str, rgb: &str, kind: &str| {
        let over = if kind == "OVER_RIDING_STYLED_ITEM" { ",#1" } else { "" };
        format!(
            "#{n}0={kind}('',(#{n}1),{item}{over});\n#{n}1=PRESENTATION_STYLE_ASSIGNMENT((#{n}2));\n#{n}2=SURFACE_STYLE_USAGE(.BOTH.,#{n}3);\n\
             #{n}3=SURFACE_SIDE_STYLE('',(#{n}4,#{n}5));\n#{n}4=SURFACE_STYLE_FILL_AREA(#{n}6);\n#{n}6=FILL_AREA_STYLE('',(#{n}7));\n\
             #{n}7=FILL_AREA_STYLE_COLOUR('',#{n}8);\n#{n}8=COLOUR_RGB('',{rgb});\n\
             #{n}5=SURFACE_STYLE_RENDERING_WITH_PROPERTIES($,#{n}8,(#{n}9));\n#{n}9=SURFACE_STYLE_TRANSPARENT(0.25);\n"
        )
    };
    let solid = style(30, "#80", "0.5,0.,0.", "STYLED_ITEM");
    let face = style(31, "#82", "0.,0.5,0.", "OVER_RIDING_STYLED_ITEM");
    let color = |styles: &str| {
        let text = whole(&(base() + &product(100, "ball", "#9,#80") + styles));
        model(&text).parts[0].brep.faces[0].color
    };
    assert_eq!(color(""), None);
    assert_eq!(color(&solid), Some([0.5, 0.0, 0.0, 0.75]));
    assert_eq!(color(&(solid.clone() + &face)), Some([0.0, 0.5, 0.0, 0.75]));
    let layers = "#32=PRESENTATION_LAYER_ASSIGNMENT('L\\X\\C4','',(#80));\n#33=INVISIBILITY((#300,#32));\n";
    let found = model(&whole(&(base() + &product(100, "ball", "#9,#80") + &solid + layers)));
    assert_eq!((&found.layers[..], &found.hidden[..]), (&["L\u{c4}".to_string()][..], &[80][..]));
}

/// A representation of no product that shows a product's solid once more is no second part.
#[test]
fn views_of_a_part_are_no_parts() {
    let text =
        whole(&(base() + &product(100, "ball", "#9,#80") + "#50=SHAPE_REPRESENTATION('view',(#80),#4);\n"));
    assert_eq!((model(&text).parts.len(), model(&text).instances.len()), (1, 1));
    let alone = model(&whole(&(base() + "#50=SHAPE_REPRESENTATION('alone',(#80),#4);\n")));
    assert_eq!((alone.parts.len(), &alone.parts[0].name[..], alone.depth), (1, "alone", 0));
}

/// Each level doubles the instances of the one below.
#[test]
fn assemblies_that_would_not_fit_are_counted_only() {
    let levels = |count: u32| {
        let mut text = base() + &product(100, "ball", "#9,#80");
        for n in 1..=count {
            text += &product(100 + n, &format!("level {n}"), "#9,#70");
            text += &occurrence(200 + 2 * n, [100 + n, 99 + n], ["#9", "#70"], false);
            text += &occurrence(201 + 2 * n, [100 + n, 99 + n], ["#9", "#9"], false);
        }
        whole(&text)
    };
    let found = model(&levels(10));
    assert_eq!((found.instances.len(), found.depth), (1024, 10));
    for (count, said) in [(40, "1099511627776 instances"), (90, &format!("{} instances", u64::MAX))] {
        let e = read(&levels(count)).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(e.contains(said), "{e}");
    }
}

#[test]
fn what_stands_in_itself_is_told() {
    let text = whole(
        &(base()
            + &product(100, "a", "#9,#80")
            + &product(101, "b", "#9")
            + &occurrence(200, [101, 100], ["#9", "#70"], false)
            + &occurrence(201, [100, 101], ["#9", "#70"], false)),
    );
    let found = read(&text).unwrap_or_else(|e| panic!("{e}")).model;
    assert_eq!((found.instances.len(), found.unread.len()), (1, 1));
    assert!(found.unread[0].reason.contains("in itself") && !found.is_complete());
}
