//! Small texts of each kind of tolerance, sound and broken.

use super::super::part21::parse;
use crate::formats::brep::Budget;
use trueness_cad::tolerances::{DatumPart, DatumReference, Tolerances};
use trueness_geom::progress::Silent;

/// Inches, millimeters and degrees; an aspect of one face, `#10`, and a product, `#9`.
const BASE: &str = "#1=(CONVERSION_BASED_UNIT('INCH',#2)LENGTH_UNIT()NAMED_UNIT(*));\n#2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4000001),#3);\n\
    #3=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#4=(CONVERSION_BASED_UNIT('DEGREE',#5)NAMED_UNIT(*)PLANE_ANGLE_UNIT());\n\
    #5=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.01745329),#6);\n#6=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n\
    #9=PRODUCT_DEFINITION_SHAPE('','',$);\n#10=SHAPE_ASPECT('bore \\X2\\00D8\\X0\\5','',#9,.T.);\n\
    #11=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#10,$,#12);\n#12=ADVANCED_FACE('',(),$,.T.);\n#13=ADVANCED_FACE('',(),$,.T.);\n\
    #14=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.01),#1);\n#15=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.5),#3);\n\
    #16=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(-0.1),#3);\n#20=DATUM('',$,#9,.F.,'A');\n#21=DATUM('',$,#9,.F.,'B');\n\
    #22=DATUM_FEATURE('','',#9,.T.);\n#23=SHAPE_ASPECT_RELATIONSHIP('','',#22,#20);\n\
    #24=ITEM_IDENTIFIED_REPRESENTATION_USAGE('','',#22,$,SET_REPRESENTATION_ITEM((#13,#12)));\n";

fn read(entities: &str) -> Tolerances {
    let text =
        format!("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n{BASE}{entities}\nENDSEC;\nEND-ISO-10303-21;\n");
    let file = parse(text.as_bytes(), &Silent).unwrap();
    super::read(&file, &Budget::of(file.count()))
}

fn plain(letter: &str) -> DatumReference {
    DatumReference { parts: vec![DatumPart { letter: letter.into(), modifiers: vec![] }] }
}

#[test]
fn a_tolerance_has_width_place_and_name() {
    let all = read("#30=FLATNESS_TOLERANCE('flat','',#14,#10);");
    let [flat] = all.geometric.as_slice() else { panic!("{all:?}") };
    assert_eq!((&flat.kind[..], &flat.name[..], flat.entity), ("flatness", "flat", 30));
    // An inch is 25.4 mm, whatever digits the file has.
    assert!((flat.width.unwrap() - 0.254).abs() < 1e-15);
    assert_eq!((&flat.of.faces[..], &flat.of.name[..]), (&[12][..], "bore Ø5"));
    assert!(flat.datums.is_empty() && flat.notes.is_empty(), "{flat:?}");
    let [a, b] = all.datums.as_slice() else { panic!("{all:?}") };
    assert_eq!((&a.letter[..], &a.features[0].faces[..], b.features.len()), ("A", &[12, 13][..], 0));
}

#[test]
fn modifiers_datums_and_zones_are_read() {
    let all = read(
        "#30=(GEOMETRIC_TOLERANCE('','',#15,#10)GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((#31))\
         GEOMETRIC_TOLERANCE_WITH_MODIFIERS((.MAXIMUM_MATERIAL_REQUIREMENT.,.FREE_STATE.))POSITION_TOLERANCE());\n\
         #31=DATUM_SYSTEM('',$,#9,.F.,(#32,#33,#34));\n#32=DATUM_REFERENCE_COMPARTMENT('',$,#9,.F.,#20,$);\n\
         #33=DATUM_REFERENCE_COMPARTMENT('',$,#9,.F.,#21,(SIMPLE_DATUM_REFERENCE_MODIFIER(.LEAST_MATERIAL_REQUIREMENT.)));\n\
         #34=DATUM_REFERENCE_COMPARTMENT('',$,#9,.F.,COMMON_DATUM_LIST((#35,#36)),(.TRANSLATION.,#37));\n\
         #35=DATUM_REFERENCE_ELEMENT('',$,#9,.F.,#20,$);\n#36=DATUM_REFERENCE_ELEMENT('',$,#9,.F.,#21,$);\n\
         #37=DATUM_REFERENCE_MODIFIER_WITH_VALUE(.DISTANCE.,#15);\n\
         #40=TOLERANCE_ZONE('',$,#9,.F.,(#30),#41);\n#41=TOLERANCE_ZONE_FORM('cylindrical or circular');\n\
         #42=PROJECTED_ZONE_DEFINITION(#40,(),#10,#15);\n\
         #50=PERPENDICULARITY_TOLERANCE('','',#15,#10,(#52,#51));\n#51=DATUM_REFERENCE(1,#20);\n#52=DATUM_REFERENCE(2,#21);\n\
         #53=GEOMETRIC_TOLERANCE_RELATIONSHIP('composite','',#30,#50);",
    );
    let [position, square] = all.geometric.as_slice() else { panic!("{all:?}") };
    assert_eq!(position.modifiers, ["maximum material requirement", "free state"]);
    assert_eq!(position.zone.as_deref(), Some("cylindrical or circular"));
    assert_eq!(position.notes, ["projected by 0.5 mm", "composite with #50 below it"]);
    assert_eq!(position.datums[0], plain("A"));
    assert_eq!(position.datums[1].parts[0].modifiers, ["least material requirement"]);
    let common: Vec<&str> = position.datums[2].parts.iter().map(|p| &p.letter[..]).collect();
    assert_eq!(common, ["A", "B"]);
    assert_eq!(position.datums[2].parts[1].modifiers, ["translation", "distance 0.5 mm"]);
    // In the order of their precedence, not of the list.
    assert_eq!(square.datums, [plain("A"), plain("B")]);
    assert_eq!(square.notes, ["composite with #30 above it"]);
}

#[test]
fn dimensions_have_values_and_limits() {
    let measured = |number: u32, name: &str, value: &str, unit: u32| {
        let kind = if unit == 4 { "PLANE_ANGLE" } else { "LENGTH" };
        format!(
            "#{number}=({kind}_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT({kind}_MEASURE({value}),#{unit})\
             REPRESENTATION_ITEM('{name}'));\n"
        )
    };
    let shown = |dimension: u32, first: u32, items: &str| {
        format!(
            "#{first}=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#{dimension},#{});\n#{}=SHAPE_DIMENSION_REPRESENTATION('',({items}),$);\n",
            first + 1,
            first + 1
        )
    };
    let text = [
        "#30=DIMENSIONAL_SIZE(#10,'diameter');\n#31=PLUS_MINUS_TOLERANCE(#32,#30);\n#32=TOLERANCE_VALUE(#16,#15);\n".to_string(),
        shown(30, 33, "#35,#36"),
        measured(35, "nominal value", "2.", 1),
        "#36=DESCRIPTIVE_REPRESENTATION_ITEM('dimensional note','statistical');\n".into(),
        "#40=DIMENSIONAL_LOCATION('linear distance','',#22,#10);\n".into(),
        shown(40, 41, "#43"),
        "#43=VALUE_RANGE('',SET_REPRESENTATION_ITEM((#44,#45)));\n".into(),
        measured(44, "lower limit", "9.", 3),
        measured(45, "upper limit", "10.", 3),
        "#50=ANGULAR_LOCATION('angle','',#22,#10,.EQUAL.);\n".into(),
        shown(50, 51, "#53"),
        measured(53, "nominal value", "60.", 4),
        "#60=DIMENSIONAL_SIZE(#10,'diameter');\n#61=PLUS_MINUS_TOLERANCE(#62,#60);\n#62=LIMITS_AND_FITS('H','','7','');\n".into(),
    ];
    let all = read(&text.concat());
    let [size, distance, angle, fit] = all.dimensions.as_slice() else { panic!("{all:?}") };
    assert_eq!((size.nominal, size.deviations), (Some(50.8), Some([-0.1, 0.5])));
    assert_eq!((&size.notes[..], &size.of[0].faces[..]), (&["statistical".to_string()][..], &[12][..]));
    assert_eq!((distance.nominal, distance.limits), (None, Some([9.0, 10.0])));
    assert_eq!((&distance.of[0].faces[..], &distance.of[1].faces[..]), (&[12, 13][..], &[12][..]));
    assert_eq!(distance.range(), Some((9.5, [-0.5, 0.5])));
    assert!(angle.is_angle && (angle.nominal.unwrap().to_degrees() - 60.0).abs() < 1e-12, "{angle:?}");
    assert_eq!((fit.class.as_deref(), fit.range()), (Some("H7"), None));
}

#[test]
fn parts_of_an_aspect_lead_to_its_faces() {
    // Two parts that lead back to the whole, and a property that has a face.
    let all = read(
        "#30=ALL_AROUND_SHAPE_ASPECT('','',#9,.T.);\n#31=SHAPE_ASPECT_RELATIONSHIP('','',#30,#10);\n#32=SHAPE_ASPECT_RELATIONSHIP('','',#10,#30);\n\
         #33=SHAPE_ASPECT_RELATIONSHIP('','',#30,#34);\n#34=SHAPE_ASPECT('','',#9,.T.);\n#35=PROPERTY_DEFINITION('','',#34);\n\
         #36=SHAPE_DEFINITION_REPRESENTATION(#35,#37);\n#37=SHAPE_REPRESENTATION('',(#13,#16),$);\n#38=SURFACE_PROFILE_TOLERANCE('','',#15,#30);",
    );
    let of = &all.geometric[0].of;
    assert_eq!((&of.faces[..], &of.notes[..]), (&[12, 13][..], &["all around".to_string()][..]));
    assert_eq!(of.others, [(16, "LENGTH_MEASURE_WITH_UNIT".to_string())]);
}

#[test]
fn what_is_broken_is_told_and_stops_nothing() {
    let all = read(
        "#30=FLATNESS_TOLERANCE('','',#99,#98);\n#31=FLATNESS_TOLERANCE('','',#12,#10);\n#32=FLATNESS_TOLERANCE();\n\
         #33=POSITION_TOLERANCE('','',#15,#10,(#34,#97));\n#34=DATUM_SYSTEM('',$,#9,.F.,(#35));\n\
         #35=DATUM_REFERENCE_COMPARTMENT('',$,#9,.F.,#35,(#96));\n#36=DIMENSIONAL_SIZE(#95,$);\n#37=PLUS_MINUS_TOLERANCE(#94,#36);\n\
         #38=PLUS_MINUS_TOLERANCE(#39,#36);\n#39=TOLERANCE_VALUE(#12,$);\n#40=DIMENSIONAL_LOCATION('','',$,'x');\n#50=FLATNESS_TOLERANCE('','',#14,#10);",
    );
    let widths: Vec<Option<f64>> =
        all.geometric.iter().map(|t| t.width.map(|w| (w * 1e6).round() / 1e6)).collect();
    assert_eq!(widths, [None, None, None, Some(0.5), Some(0.254)]);
    assert!(all.geometric[0].notes[0].contains("#99 is not in the file"), "{:?}", all.geometric[0]);
    assert!(all.geometric[..4].iter().all(|t| !t.notes.is_empty()), "{all:?}");
    assert!(
        all.geometric[3].notes.iter().any(|n| n.contains("rests on itself")),
        "{:?}",
        all.geometric[3].notes
    );
    assert!(all.dimensions.iter().all(|d| !d.notes.is_empty() || !d.of[0].notes.is_empty()), "{all:?}");
    assert!(all.geometric[4].notes.is_empty());
}

#[test]
fn aspects_that_share_all_their_parts_cost_little() {
    // Each of 40 levels twice has the level below: 2^40 ways, 41 aspects.
    let mut text = String::from(
        "#100=SHAPE_ASPECT('','',#9,.T.);\n#99=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#100,$,#12);\n",
    );
    for level in 1..=40 {
        let (own, below) = (100 + 3 * level, 97 + 3 * level);
        text.push_str(&format!("#{own}=SHAPE_ASPECT('','',#9,.T.);\n"));
        for k in 1..=2 {
            text.push_str(&format!("#{}=SHAPE_ASPECT_RELATIONSHIP('','',#{own},#{below});\n", own + k));
        }
    }
    let all = read(&(text + "#30=FLATNESS_TOLERANCE('','',#14,#220);"));
    assert_eq!(all.geometric[0].of.faces, [12]);
}
