//! Solids, shells, faces and their senses.

use super::{faces, model, near, part, read};
use trueness_cad::brep::{Bounds, Brep, EdgeUse, Loop};
use trueness_cad::surface::Surface;

/// A tetrahedron of polygons, its faces counter-clockwise from outside.
const TETRAHEDRON: &str = "#51=CLOSED_SHELL('',(#60,#61,#62,#63));\n#60=FACE_SURFACE('',(#64),#68,.T.);\n#61=FACE_SURFACE('',(#65),#68,.T.);\n\
    #62=FACE_SURFACE('',(#66),#68,.T.);\n#63=FACE('',(#67));\n#64=FACE_OUTER_BOUND('',#70,.T.);\n#65=FACE_OUTER_BOUND('',#71,.F.);\n\
    #66=FACE_OUTER_BOUND('',#72,.T.);\n#67=FACE_OUTER_BOUND('',#73,.T.);\n#68=PLANE('',#9);\n#70=POLY_LOOP('',(#5,#81,#80));\n\
    #71=POLY_LOOP('',(#5,#82,#80));\n#72=POLY_LOOP('',(#5,#82,#81));\n#73=POLY_LOOP('',(#80,#81,#82));\n#80=CARTESIAN_POINT('',(1.,0.,0.));\n\
    #81=CARTESIAN_POINT('',(0.,1.,0.));\n#82=CARTESIAN_POINT('',(0.,0.,1.));\n";

/// Six times the volume within faces of planes and straight edges, by their outward normals and loops.
fn six_volumes(brep: &Brep) -> f64 {
    let corner = |u: &EdgeUse| {
        let edge = &brep.edges[u.edge as usize];
        brep.vertices[edge.vertices[usize::from(u.reversed)] as usize].place
    };
    let mut sum = 0.0;
    for face in &brep.faces {
        let Bounds::Loops(loops) = &face.bounds else { panic!("loops") };
        for around in loops {
            let Loop::Edges(uses) = around else { panic!("edges") };
            let p: Vec<_> = uses.iter().map(corner).collect();
            for k in 1..p.len() - 1 {
                let c = trueness_geom::space::cross(p[k], p[k + 1]);
                sum += trueness_geom::space::dot(p[0], c);
            }
        }
    }
    sum
}

#[test]
fn faceted_solids_have_the_planes_of_their_polygons() {
    let text = part("#50", &format!("#50=FACETED_BREP('tetra',#51);\n{TETRAHEDRON}"));
    let brep = model(&text).parts.remove(0).brep;
    assert_eq!((brep.vertices.len(), brep.edges.len(), brep.faces.len()), (4, 6, 4));
    assert_eq!((brep.solids.len(), &brep.solids[0].name[..], brep.shells[0].closed), (1, "tetra", true));
    assert!((six_volumes(&brep) - 1.0).abs() < 1e-15);
    let normals: Vec<_> = brep.faces.iter().map(|f| f.surface.normal(0.0, 0.0).unwrap()).collect();
    let s = 1.0 / 3f64.sqrt();
    for (normal, wanted) in
        normals.iter().zip([[0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [s, s, s]])
    {
        assert!(near(*normal, wanted), "{normal:?}");
    }
}

/// A ball around a tetrahedron whose polygons look outward or inward, and whose shell is turned or not.
#[test]
fn a_hollow_looks_into_itself_however_the_file_says_so() {
    for (word, inward) in [(".F.", false), (".T.", false), (".F.", true), (".T.", true)] {
        let shell = match inward {
            false => TETRAHEDRON.to_string(),
            // All polygons the other way around.
            true => {
                let turned =
                    TETRAHEDRON.replace("',#70,.T.)", "',#70,.F.)").replace("',#71,.F.)", "',#71,.T.)");
                turned.replace("',#72,.T.)", "',#72,.F.)").replace("',#73,.T.)", "',#73,.F.)")
            }
        };
        let text = part(
            "#50",
            &format!(
                "#50=BREP_WITH_VOIDS('',#49,(#52));\n#49=CLOSED_SHELL('',(#48));\n#48=ADVANCED_FACE('',(),#47,.T.);\n\
                #47=SPHERICAL_SURFACE('',#9,4.);\n#52=ORIENTED_CLOSED_SHELL('',*,#51,{word});\n{shell}"
            ),
        );
        let brep = model(&text).parts.remove(0).brep;
        assert_eq!((brep.solids[0].outer, &brep.solids[0].voids[..]), (0, &[1][..]));
        assert_eq!((brep.faces.len(), brep.edges.len()), (5, 6));
        let hollow = Brep { faces: brep.faces[1..].to_vec(), ..brep };
        assert!((six_volumes(&hollow) + 1.0).abs() < 1e-15, "{word} {inward}: {}", six_volumes(&hollow));
    }
}

/// A disk in the plane z = 0 with a hole, in every combination of senses.
#[test]
fn the_face_lies_on_the_left_of_its_loops() {
    for (sense, bound) in [(".T.", ".T."), (".F.", ".T."), (".T.", ".F."), (".F.", ".F.")] {
        let text = part(
            "#50",
            &format!(
                "#50=SHELL_BASED_SURFACE_MODEL('',(#51));\n#51=OPEN_SHELL('',(#52));\n#52=ADVANCED_FACE('',(#53),#54,{sense});\n\
                 #53=FACE_OUTER_BOUND('',#55,{bound});\n#54=PLANE('',#9);\n#55=EDGE_LOOP('',(#56));\n#56=ORIENTED_EDGE('',*,*,#57,.T.);\n\
                 #57=EDGE_CURVE('',#58,#58,#59,.T.);\n#58=VERTEX_POINT('',#60);\n#59=CIRCLE('',#9,2.);\n#60=CARTESIAN_POINT('',(2.,0.,0.));"
            ),
        );
        let found = faces(&text);
        assert_eq!(found[0].reversed, sense == ".F.");
        let reversed = bound == ".F.";
        assert_eq!(found[0].bounds, Bounds::Loops(vec![Loop::Edges(vec![EdgeUse { edge: 0, reversed }])]));
    }
}

#[test]
fn a_turned_face_has_normal_and_loops_turned() {
    let text = part(
        "#49",
        "#49=CONNECTED_FACE_SET('',(#50));\n#50=ORIENTED_FACE('',*,#52,.F.);\n#52=ADVANCED_FACE('',(#53),#54,.T.);\n\
         #53=FACE_OUTER_BOUND('',#55,.T.);\n#54=PLANE('',#9);\n#55=EDGE_LOOP('',(#56));\n#56=ORIENTED_EDGE('',*,*,#57,.T.);\n\
         #57=EDGE_CURVE('',#58,#58,#59,.T.);\n#58=VERTEX_POINT('',#60);\n#59=CIRCLE('',#9,2.);\n#60=CARTESIAN_POINT('',(2.,0.,0.));",
    );
    let found = faces(&text);
    assert!(found[0].reversed);
    assert_eq!(found[0].bounds, Bounds::Loops(vec![Loop::Edges(vec![EdgeUse { edge: 0, reversed: true }])]));
}

#[test]
fn surfaces_without_topology_have_their_own_bounds() {
    let square = "#100=COMPOSITE_CURVE('',(#101,#102),.F.);\n#101=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#103);\n\
        #102=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#104);\n#103=POLYLINE('',(#5,#105,#106));\n#104=POLYLINE('',(#106,#107,#5));\n\
        #105=CARTESIAN_POINT('',(1.,0.,0.));\n#106=CARTESIAN_POINT('',(1.,1.,0.));\n#107=CARTESIAN_POINT('',(0.,1.,0.));\n";
    let text = part(
        "#50",
        &format!(
            "#50=GEOMETRIC_SET('',(#51,#52,#53,#5,#54));\n#51=SPHERICAL_SURFACE('',#9,3.);\n#52=CURVE_BOUNDED_SURFACE('',#55,(#56),.F.);\n\
             #53=RECTANGULAR_TRIMMED_SURFACE('',#57,1.,2.,-1.,4.,.T.,.T.);\n#54=CIRCLE('',#9,3.);\n#55=PLANE('',#9);\n\
             #56=BOUNDARY_CURVE('',(#101,#102),.F.);\n#57=CYLINDRICAL_SURFACE('',#9,1.);\n{square}"
        ),
    );
    let part = model(&text).parts.remove(0);
    assert_eq!(
        (part.wires, part.brep.faces.len(), part.brep.edges.len(), part.brep.vertices.len()),
        (2, 3, 2, 2)
    );
    assert!(matches!(part.brep.faces[0].surface, Surface::Sphere { radius: 3.0, .. }));
    let uses = [0, 1].map(|edge| EdgeUse { edge, reversed: false }).to_vec();
    assert_eq!(part.brep.faces[1].bounds, Bounds::Loops(vec![Loop::Edges(uses)]));
    assert_eq!(part.brep.faces[2].bounds, Bounds::Rectangle([[1.0, 2.0], [-1.0, 4.0]]));
}

/// What is not read, and why; whether faces are missing then.
#[test]
fn what_is_not_read_is_told() {
    let cases = [
        ("#51=CSG_SOLID('',#52);", "other solids", true),
        ("#51=EXTRUDED_AREA_SOLID('',#52,#9,#8,2.);", "swept solid", true),
        ("#51=(TESSELLATED_ITEM()TESSELLATED_SOLID((#52),$));", "triangles", false),
        ("#51=PLANE('',#9);", "without ends", false),
        ("#51=ADVANCED_FACE('',(),#52,.T.);\n#52=PLANE('',#9);", "has no end", true),
        ("#51=ADVANCED_FACE('',(#53),#52,.T.);\n#52=PLANE('',#9);", "#53 is not in the file", true),
        (
            "#51=ADVANCED_FACE('',(#53),#52,.T.);\n#52=PLANE('',#9);\n#53=FACE_BOUND('',#54,.T.);\n#54=EDGE_LOOP('',());",
            "no edges",
            true,
        ),
        ("#51=SPHERICAL_SURFACE('',#9,-1.);", "not above 0", true),
        (
            "#51=SPHERICAL_SURFACE('',#52,1.);\n#52=AXIS2_PLACEMENT_3D('',#5,#53,$);\n#53=DIRECTION('',(0.,0.,0.));",
            "without length",
            true,
        ),
        ("#51=OFFSET_SURFACE('',#51,1.,.F.);", "rests on itself", true),
        ("#51=SURFACE_OF_REVOLUTION('',#52,#9);\n#52=PCURVE('',#51,#9);", "parameters of a surface", true),
        (
            "#51=B_SPLINE_SURFACE_WITH_KNOTS('',1,1,((#5,#5),(#5,#5)),.U.,.F.,.F.,.U.,(2,3),(2,2),(0.,1.),(0.,1.),.U.);",
            "knots",
            true,
        ),
    ];
    for (entities, reason, holds_faces) in cases {
        let text = part(
            "#50,#51",
            &format!(
                "#50=FACETED_BREP('tetra',#40);\n{}\n{entities}",
                TETRAHEDRON.replace("#51=", "#40=").replace("#53", "#530").replace("#52", "#520")
            ),
        );
        let found = read(&text).unwrap_or_else(|e| panic!("{e}")).model;
        assert_eq!(
            (found.parts[0].brep.faces.len(), found.unread.len()),
            (4, 1),
            "{entities}: {:?}",
            found.unread
        );
        let told = &found.unread[0];
        assert!(told.reason.contains(reason), "{entities}: {}", told.reason);
        assert_eq!(
            (told.entity, told.holds_faces, found.is_complete()),
            (51, holds_faces, !holds_faces),
            "{entities}"
        );
        assert!(told.reason.contains("line") || reason.contains("not in the file"), "{}", told.reason);
    }
    let said = read(&part("#51", "#51=CSG_SOLID('',#52);")).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(said.contains("none of its faces") && said.contains("other solids"), "{said}");
    let said = read(&part("#9", "")).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(said.contains("no shape"), "{said}");
}
