//! Faces of small models.

use super::{CadFaces, FaceChoice};
use trueness_cad::brep::{Bounds, Brep, Face};
use trueness_cad::frame::{Frame, Placement};
use trueness_cad::model::{Instance, Model, Part, Unread};
use trueness_cad::surface::Surface;
use trueness_cad::trimmed::Trimmed;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Silent;
use trueness_geom::shape::Shape;
use trueness_geom::space::norm;

fn face(entity: u64, surface: Surface, sides: [[f64; 2]; 2], reversed: bool) -> Face {
    Face {
        surface,
        reversed,
        bounds: Bounds::Rectangle(sides),
        entity,
        name: format!("F{entity} "),
        color: None,
        instance: 0,
    }
}

/// The faces of a part at some places of an assembly.
fn faces(faces: Vec<Face>, instances: Vec<Instance>) -> CadFaces {
    let part = Part { brep: Brep { faces, ..Brep::default() }, ..Part::default() };
    let unread = Unread {
        entity: 90,
        keyword: "ADVANCED_FACE".into(),
        reason: "it is bent".into(),
        holds_faces: true,
    };
    let model = Model { parts: vec![part], instances, unread: vec![unread], ..Model::default() };
    CadFaces::new(&model, Trimmed::of(&model, &Silent).unwrap(), (&Mesh::default(), vec![]), 0.0, &Silent)
        .unwrap()
}

fn frame() -> Frame {
    Frame::new([1.0, 2.0, 3.0], [0.0, 0.6, 0.8], None).unwrap()
}

fn mirror() -> Placement {
    Placement { rows: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], ..Placement::IDENTITY }
}

/// Of each kind the places of the face lie on the element, and its normals tell the sense, mirrored or not.
#[test]
fn elements_are_those_of_the_surfaces() {
    let frame = frame();
    let turn = [0.3, 1.4];
    let all = [
        (Surface::Plane(frame), [[0.0, 2.0], [1.0, 4.0]]),
        (Surface::Cylinder { frame, radius: 2.0 }, [turn, [-1.0, 3.0]]),
        (Surface::Cone { frame, radius: 2.0, half_angle: 0.4 }, [turn, [0.5, 3.0]]),
        (Surface::Cone { frame, radius: 2.0, half_angle: 0.4 }, [turn, [-9.0, -6.0]]),
        (Surface::Cone { frame, radius: 2.0, half_angle: -0.4 }, [turn, [-3.0, 1.0]]),
        (Surface::Sphere { frame, radius: 2.0 }, [turn, [-0.4, 0.9]]),
        (Surface::Torus { frame, major: 5.0, minor: 2.0 }, [turn, [0.2, 1.0]]),
    ];
    for (number, (surface, sides)) in all.into_iter().enumerate() {
        for (reversed, at) in
            [false, true].into_iter().flat_map(|r| [(r, Placement::IDENTITY), (r, mirror())])
        {
            let own = faces(vec![face(7, surface.clone(), sides, reversed)], vec![Instance::of(0, at)]);
            let found = &own.faces[0];
            let shape = found.shape.unwrap();
            let [u, v] = sides.map(|[a, b]| a + 0.3 * (b - a));
            let (place, normal) = (found.surface.at(u, v), found.surface.normal(u, v).unwrap());
            let outward = if found.is_reversed { normal.map(|x| -x) } else { normal };
            assert!(shape.distance(place).abs() < 1e-12, "{number}: {shape:?}");
            let beyond = std::array::from_fn(|k| place[k] + 1e-3 * outward[k]);
            let sign = shape.distance(beyond);
            match found.inward {
                None => assert!(matches!(shape, Shape::Plane { .. }) && sign > 0.0, "{number}"),
                Some(inward) => assert_eq!(inward, sign < 0.0, "{number} {reversed} {at:?}"),
            }
            if let Some(ends) = found.ends {
                let length = norm(std::array::from_fn(|k| ends[1][k] - ends[0][k]));
                assert!((length - (sides[1][1] - sides[1][0])).abs() < 1e-9, "{number}");
            }
        }
    }
}

#[test]
fn a_number_of_several_instances_needs_one() {
    let sphere = || face(7, Surface::Sphere { frame: frame(), radius: 2.0 }, [[0.0, 1.0], [0.0, 1.0]], false);
    let named = |path: &str| Instance {
        path: vec!["root".into(), path.into()],
        ..Instance::of(0, Placement::IDENTITY)
    };
    let all = faces(vec![sphere()], vec![named("left"), named("right")]);
    let choice = |instance: Option<&str>| FaceChoice {
        numbers: vec![7],
        name: None,
        instance: instance.map(String::from),
    };
    let several = all.chosen(&choice(None)).unwrap_err().to_string();
    assert_eq!(
        several,
        "face 7 occurs in 2 instances; say which by `instance`: \"root/left\", \"root/right\""
    );
    assert_eq!(all.chosen(&choice(Some("root/right"))), Ok(vec![1]));
    assert_eq!(all.record(1).instance.as_deref(), Some("root/right"));
    let wrong = all.chosen(&choice(Some("root/rigt"))).unwrap_err().to_string();
    assert!(wrong.contains("did you mean \"root/right\"?"), "{wrong}");
    let unread = all.chosen(&FaceChoice { numbers: vec![90], ..FaceChoice::default() });
    assert_eq!(unread.unwrap_err().to_string(), "face 90 of the reference could not be read: it is bent");
    let name = all.chosen(&FaceChoice {
        name: Some("F7".into()),
        instance: Some("root/left".into()),
        numbers: vec![],
    });
    assert_eq!(name, Ok(vec![0]));
}
