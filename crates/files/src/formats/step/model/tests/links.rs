//! Entities renamed, left out or broken: the model is the same, or what it lacks is told.

use super::assembly::{base, occurrence, product};
use super::hostile::FACES;
use super::{model, part, read, whole};
use crate::cad::CadFile;
use trueness_cad::model::Model;

/// What a model is, whatever the order and the names.
fn described(model: &Model) -> Vec<String> {
    let brep = model.assembled();
    let faces = brep.faces.iter().map(|f| format!("{:?} {}", f.surface, f.reversed));
    let edges = brep.edges.iter().map(|e| format!("{:?}", e.span));
    let mut all: Vec<String> = faces.chain(edges).collect();
    all.sort_unstable();
    all.push(format!("{} solids, {} shells", brep.solids.len(), brep.shells.len()));
    all
}

fn is_told(file: &CadFile) -> bool {
    !file.model.is_complete() || !file.warnings.is_empty()
}

/// Each way in which one entity of a text is damaged.
fn damages(text: &str) -> Vec<(String, String)> {
    let start = text.find("DATA;").unwrap();
    let end = text.rfind("ENDSEC;").unwrap();
    let mut all = vec![];
    let mut at = start + 6;
    while let Some(length) = text[at..end].find(";\n") {
        let next = at + length + 2;
        let (before, entity, after) = (&text[..at], &text[at..next], &text[next..]);
        let own = entity.find('=').unwrap();
        let mut change = |changed: String| all.push((changed.clone(), format!("{before}{changed}{after}")));
        change(format!("/*{}*/\n", entity.trim_end()));
        let mut begins_word = true;
        let letters: Vec<(usize, char)> = entity.char_indices().skip(own).collect();
        for (k, c) in &letters {
            let starts = c.is_ascii_uppercase() && begins_word;
            begins_word = !c.is_ascii_alphanumeric() && !"_.\'".contains(*c);
            let word: String =
                entity[*k..].chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
            if starts && entity[k + word.len()..].starts_with('(') {
                for wrong in [format!("Q{word}"), format!("{}X", &word[..word.len() - 1])] {
                    change(format!("{}{wrong}{}", &entity[..*k], &entity[k + word.len()..]));
                }
            }
            if *c == '#' {
                let digits = entity[k + 1..].chars().take_while(char::is_ascii_digit).count();
                change(format!("{}#99999{}", &entity[..*k], &entity[k + 1 + digits..]));
            }
        }
        at = next;
    }
    all
}

/// Of a torus between two seams, a B-spline with weights, and a solid with a hollow.
fn models() -> Vec<String> {
    let assembly = product(100, "ball", "#9,#80")
        + &product(101, "sub", "#9,#70")
        + &product(102, "top", "#9,#70")
        + &occurrence(200, [101, 100], ["#9", "#70"], false)
        + &occurrence(201, [102, 101], ["#9", "#70"], false)
        + &occurrence(202, [102, 100], ["#70", "#70"], true);
    // The shape of the product in a representation of its own.
    let apart = product(100, "ball", "#9")
        + &product(102, "top", "#9,#70")
        + "#60=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#9,#80),#4);\n#61=SHAPE_REPRESENTATION_RELATIONSHIP('','',#1004,#60);\n"
        + &occurrence(200, [102, 100], ["#9", "#70"], false);
    let mapped = product(100, "top", "#9,#60,#61")
        + "#60=MAPPED_ITEM('first',#62,#63);\n#61=MAPPED_ITEM('',#62,#70);\n#62=REPRESENTATION_MAP(#9,#64);\n\
           #64=SHAPE_REPRESENTATION('mapped',(#9,#80),#4);\n#63=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',$,#65,#7,#71,2.,#8);\n\
           #65=DIRECTION('',(-1.,0.,0.));\n";
    let replica = product(100, "two", "#80,#60")
        + "#60=SOLID_REPLICA('',#80,#62);\n#62=CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,$,$,$,#71,2.,$);\n";
    let hollow = product(100, "hollow", "#60")
        + "#60=BREP_WITH_VOIDS('',#81,(#61));\n#61=ORIENTED_CLOSED_SHELL('',*,#62,.F.);\n#62=CLOSED_SHELL('',(#63));\n\
           #63=ADVANCED_FACE('',(#64),#66,.T.);\n#64=FACE_BOUND('',#65,.T.);\n#65=VERTEX_LOOP('',#67);\n#67=VERTEX_POINT('',#68);\n\
           #66=SPHERICAL_SURFACE('',#88,0.5);\n#68=CARTESIAN_POINT('',(5.,0.,0.5));\n";
    let spline = "#50=ADVANCED_FACE('',(),#51,.T.);\n\
        #51=(BOUNDED_SURFACE()B_SPLINE_SURFACE(1,2,((#60,#61,#62),(#63,#64,#65)),.UNSPECIFIED.,.F.,.F.,.F.)\
        B_SPLINE_SURFACE_WITH_KNOTS((2,2),(3,3),(0.,1.),(0.,1.),.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM()\
        RATIONAL_B_SPLINE_SURFACE(((1.,0.7,1.),(1.,0.7,1.)))REPRESENTATION_ITEM('')SURFACE());\n\
        #60=CARTESIAN_POINT('',(1.,0.,0.));\n#61=CARTESIAN_POINT('',(1.,1.,0.));\n#62=CARTESIAN_POINT('',(0.,1.,0.));\n\
        #63=CARTESIAN_POINT('',(1.,0.,2.));\n#64=CARTESIAN_POINT('',(1.,1.,2.));\n#65=CARTESIAN_POINT('',(0.,1.,2.));\n";
    let products = [assembly, apart, mapped, replica, hollow];
    let mut all: Vec<String> = products.iter().map(|p| whole(&(base() + p))).collect();
    all.push(part("#50", &FACES.replace("\n    ", "\n").replace(";#", ";\n#")));
    all.push(part("#50", spline));
    all
}

#[test]
fn what_is_lost_is_told() {
    let (mut count, mut silent) = (0, vec![]);
    for (number, text) in models().iter().enumerate() {
        let wanted = described(&model(text));
        for (changed, damaged) in damages(text) {
            count += 1;
            let Ok(found) = read(&damaged) else { continue };
            if !is_told(&found) && described(&found.model) != wanted {
                silent.push(format!("model {number}: {changed}"));
            }
        }
    }
    assert!(silent.is_empty(), "of {count}: {silent:#?}");
}

#[test]
fn files_without_a_shape_are_refused() {
    for entities in ["", "#1=CARTESIAN_POINT('',(0.,0.,0.));\n", "#1=PRODUCT('','','',());\n"] {
        let text = whole(entities);
        assert!(read(&text).is_err());
        let mut sources = crate::MemorySources::new();
        sources.insert("model.step", text.into_bytes());
        let opened =
            crate::open_from(&sources, std::path::Path::new("model.step"), &crate::ReadOptions::default());
        let told = opened.err().map(|e| e.to_string()).unwrap_or_default();
        assert!(told.contains("holds no shape"), "{told}");
    }
}
