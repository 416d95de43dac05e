//! Position: ISO 1101:2017, 17.13; ISO 5458. ASME Y14.5-2018, section 10 agrees where no material requirement is stated.

use super::exact::{COORDINATES, compared_place, from_place, largest, place_of};
use super::kind::{Characteristic, Measuring, Question, Refusal, is_axis, refuse};
use super::located::frame;
use super::reason::{Impossible, NotMeasured};
use super::value::{Missing, Value};
use crate::characteristic::Spec;
use crate::requirement::Basic;
use trueness_document::plan::Class;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;
use trueness_geom::zone::datum::Freedom;
use trueness_geom::zone::motion::{Search, placed};

/// A plane is across an axis if the cosine of the angle of its normal to that is at least this, 45°.
const MIN_ALONG_NORMAL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Twice the greatest distance of the feature from its theoretically exact place in the datum system. It is the least over the motions
/// that the datums leave free.
///
/// Of a cylinder or cone: of both ends of the associated axis, over the extent of the points. Of a line: of all its points.
/// Of a plane: of all its points. Of a sphere, circle or point: of its center. Coordinates that `basic` does not give do not
/// count: the two across an axis place it (zone ∅), one of them alone, with `diametral = false`, holds it between two planes. Without
/// `basic` the place is that of the model. With a material requirement it is the surface that is looked at, as `material.rs` says.
#[derive(Debug)]
pub struct Position;

impl Characteristic for Position {
    fn word(&self) -> &'static str {
        "position"
    }
    fn symbol(&self) -> &'static str {
        "⌖"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.13; ISO 5458:2018"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "datums", "datum_method", "frame", "basic", "diametral", "material"]
    }
    fn material_datums(&self) -> bool {
        true
    }
    fn diametral(&self, q: &Question, _: bool) -> bool {
        match q.spec.basic.place.iter().flatten().count() {
            0 => q.feature().is_ok_and(|f| f.class != Class::Plane),
            count => count > 1,
        }
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        let class = q.class(&[
            Class::Point,
            Class::Line,
            Class::Plane,
            Class::Circle,
            Class::Sphere,
            Class::Cylinder,
            Class::Cone,
        ])?;
        if q.spec.datums.is_empty() && q.spec.frame.is_none() {
            return refuse("kind", "it needs a datum system: give `datums` or `frame`");
        }
        if q.datums().first() == Some(&Class::Sphere) {
            return refuse("datums", "a center as the first datum is not built yet");
        }
        if q.datums().contains(&Class::Point) {
            return refuse("datums", "a point is no datum; take a sphere");
        }
        if q.spec.basic.angle.is_some() {
            return refuse("basic", "it takes x, y and z, not an angle");
        }
        let given = q.spec.basic.place.map(|x| x.is_some());
        let count = given.iter().filter(|g| **g).count();
        if count == 0 && q.spec.basic_span.is_none() && q.is_of_model() {
            marked_datum(q)?;
            return match q.spec.diametral {
                Some(false) if class != Class::Plane => refuse(
                    "diametral",
                    "a zone between two planes is about one coordinate: basic = { x = 10 }",
                ),
                _ => Ok(()),
            };
        }
        if count == 0 {
            let what = "it needs the theoretically exact place: basic = { x = 10, y = 20 }; without, that of the model holds, where the \
                        feature and its datums have a `nominal` or `seed`";
            return refuse("kind", what);
        }
        if is_axis(class) && count == 3 {
            return refuse(
                "basic",
                "an axis is placed by the two coordinates across it: x and y if it runs along z",
            );
        }
        if class == Class::Plane && count != 1 {
            return refuse("basic", "a plane across an axis of the datum system is placed by one coordinate");
        }
        material(q, class, given)?;
        if class != Class::Plane && count == 1 && q.spec.diametral.is_none() {
            return refuse("basic", one_coordinate(class, given));
        }
        match q.spec.diametral {
            Some(true) if count == 1 => {
                refuse("diametral", "a zone about one coordinate lies between planes")
            }
            Some(false) if count > 1 => {
                refuse("diametral", "a zone between planes is given by one coordinate")
            }
            _ => Ok(()),
        }
    }
    fn exact(&self, model: &Measuring) -> Option<Result<Basic, Missing>> {
        Some(place_of(model))
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let (start, free) = frame(m)?;
        let points = m.feature().zoned()?;
        let (basic, class) = (&m.spec.basic, m.feature().class);
        let place = basic.place;
        match class {
            _ if basic.oblique.is_some() => (),
            Class::Plane => across(m, &start, free, place)?,
            class if is_axis(class) => along(m, &start, free, place)?,
            _ => (),
        }
        let start = if free.turn[2] { turned(m, start)? } else { start };
        let distance = |_: usize, p: Point| Some(from_place(p, basic, class));
        let search = Search { start, free, middle: 0.0, floating: false, outer: false };
        let found = placed(&points, &distance, &search, m.progress)?;
        if required(m.spec) {
            let [Some(x), Some(y), None] = place else {
                return Err(NotMeasured::NotAlongZ.into());
            };
            let value = super::material::located(m, [x, y])?;
            return Ok(Value { place: compared_place(m, found.motion), ..value });
        }
        let far = if found.max.0.abs() >= found.min.0.abs() { found.max.1 } else { found.min.1 };
        let place_found = compared_place(m, found.motion);
        let witness = vec![points[far]];
        let mut value = Value { value: 2.0 * found.half, witness, place: place_found, ..Value::default() };
        if let [only] = points.as_slice() {
            let at = found.motion.point(*only);
            value.parts = (0..3).filter(|k| place[*k].is_some()).map(|k| (COORDINATES[k], at[k])).collect();
        }
        Ok(value)
    }
}

/// Whether the coordinates that place an axis are those across it.
fn along(m: &Measuring, start: &Rigid, free: Freedom, place: [Option<f64>; 3]) -> Result<(), Missing> {
    let direction = start.vector(m.feature().direction()?);
    let most = largest(direction);
    // Within the plane x, y a turn about z may bring it anywhere.
    let is_turned = most < 2 && free.turn[2] && !(place[0].is_some() && place[1].is_some());
    if place[most].is_none() || is_turned {
        return Ok(());
    }
    let across = [["y", "z"], ["x", "z"], ["x", "y"]][most];
    Err(NotMeasured::AlongCoordinate { along: COORDINATES[most], across }.into())
}

/// Where a turn about z is free, the frame turned so that the feature stands in the direction of its true place: the search for the best turn
/// goes to the nearest one.
fn turned(m: &Measuring, start: Rigid) -> Result<Rigid, Missing> {
    let place = m.spec.basic.oblique.map_or(m.spec.basic.place, |[point, _]| point.map(Some));
    let [Some(x), Some(y), _] = place else { return Ok(start) };
    let at = start.point(m.feature().middle()?);
    let turn = libm::atan2(y, x) - libm::atan2(at[1], at[0]);
    Ok(Rigid::rotation_about([0.0; 3], [0.0, 0.0, turn]).after(&start))
}

/// Why one coordinate does not place an axis or a center.
fn one_coordinate(class: Class, given: [bool; 3]) -> String {
    let k = given.iter().position(|g| *g).unwrap_or(0);
    let (name, others) = (COORDINATES[k], [["y", "z"], ["x", "z"], ["x", "y"]][k]);
    let is = if is_axis(class) {
        "an axis is placed by the two coordinates across it"
    } else {
        "a center is placed by two or three"
    };
    let likely = if k == 2 { others[0] } else { ["y", "x"][k] };
    format!(
        "`basic` gives {name} alone, and {is}: add {likely} ({} where it runs along {likely}), or leave `basic` out where the model has the place; \
         for a zone between two planes across {name} write diametral = false",
        if others[0] == likely { others[1] } else { others[0] }
    )
}

/// Whether the coordinate that places a plane is the one along its normal, and held by the datums: others place nothing.
fn across(m: &Measuring, start: &Rigid, free: Freedom, place: [Option<f64>; 3]) -> Result<(), Missing> {
    let normal = start.vector(m.feature().direction()?);
    let Some(given) = place.iter().position(Option::is_some) else { return Ok(()) };
    // Within the plane x, y a turn about z may bring it anywhere.
    let along = match (given, free.turn[2]) {
        (2, _) => normal[2].abs(),
        (_, true) => libm::hypot(normal[0], normal[1]),
        (k, false) => normal[k].abs(),
    };
    if along < MIN_ALONG_NORMAL {
        let across = COORDINATES[largest(normal)];
        return Err(Impossible::PlaneAcross { across, given: COORDINATES[given] }.into());
    }
    if free.shift[given] {
        return Err(Impossible::FreeShift { along: COORDINATES[given] }.into());
    }
    Ok(())
}

/// Whether the tolerance or a datum has a material requirement.
fn required(spec: &Spec) -> bool {
    spec.material.is_some() || spec.datums.iter().any(|d| d.material.is_some())
}

/// Refuses material requirements that are not evaluated.
fn material(q: &Question, class: Class, given: [bool; 3]) -> Result<(), Refusal> {
    let spec = q.spec;
    if !required(spec) {
        return Ok(());
    }
    let key = if spec.material.is_some() { "material" } else { "datums" };
    if !is_axis(class) || given != [true, true, false] {
        return refuse(key, NotMeasured::NotAlongZ.to_string());
    }
    marked_datum(q)
}

/// Refuses a material requirement on a datum that leaves more freedom than is evaluated.
fn marked_datum(q: &Question) -> Result<(), Refusal> {
    let spec = q.spec;
    let marked = spec.datums.iter().position(|d| d.material.is_some());
    let first = q.datums().first().copied();
    match (marked, spec.datums.len()) {
        (None, _) | (Some(0), 1) => Ok(()),
        (Some(1), 2) if first == Some(Class::Plane) => Ok(()),
        _ => refuse(
            "datums",
            "a material requirement is evaluated on the only datum, or on the second and last one after a plane",
        ),
    }
}
