//! Sizes: ISO 14405-1:2016, 3.6 and 3.7 (local and global linear sizes).

use super::kind::{Allowed, Characteristic, Measuring, Question, Refusal, refuse};
use super::reason::NotMeasured;
use super::value::{Missing, Value};
use trueness_document::plan::{Class, SizeWord};
use trueness_document::tolerance_class::Table;
use trueness_geom::fit::Method;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::zone::{
    TwoPoint, ZoneError, mean, opposite_planes, parallel_planes, two_point_diameters, two_point_distances,
};

/// The diameter of the associated cylinder, sphere or circle (of points in space, in their least-squares plane): least squares (GG), minimum circumscribed (GN), maximum
/// inscribed (GX) or minimax (GC); of two opposite planes, the distance of the two parallel planes that are so. Two-point
/// sizes (LP) of cylinders, circles and two planes are many: the value is the one farthest from the middle of what is allowed.
#[derive(Debug)]
pub struct Size;

impl Characteristic for Size {
    fn word(&self) -> &'static str {
        "size"
    }
    fn standard(&self) -> &'static str {
        "ISO 14405-1:2016, 3.6, 3.7"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["nominal", "upper", "lower", "size", "class"]
    }
    fn allowed(&self) -> Allowed {
        Allowed::Between
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Size)
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        let Some(size) = q.spec.size else {
            return refuse("kind", "it needs `size`: \"LP\" (two-point), \"GG\", \"GN\", \"GX\" or \"GC\"");
        };
        if let [a, b] = q.spec.features.as_slice() {
            if [a, b].iter().any(|f| q.features[**f].class != Class::Plane) {
                return refuse("feature", "the size of two features is that of two opposite planes");
            }
            return Ok(());
        }
        if size == SizeWord::Lp && q.class(&[Class::Cylinder, Class::Circle]).is_err() {
            return refuse("size", "two-point sizes (LP) are of a cylinder, a circle or two planes");
        }
        q.class(&[Class::Cylinder, Class::Sphere, Class::Circle]).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        if m.spec.size == Some(SizeWord::Lp) {
            return two_point(m);
        }
        let method = match m.spec.size {
            Some(SizeWord::Gn) => Method::MinimumCircumscribed,
            Some(SizeWord::Gx) => Method::MaximumInscribed,
            Some(SizeWord::Gc) => Method::MinimumZone,
            _ => Method::Gaussian,
        };
        if let [a, b] = m.features {
            let (first, second) = (a.own_points()?, b.own_points()?);
            let pair = opposite_planes(first, second, method, m.progress)?;
            let witness = vec![mean(first), mean(second)];
            return Ok(Value { value: pair.distance, witness, ..Value::default() });
        }
        let feature = m.feature();
        let fit = match feature.class {
            Class::Sphere => feature.refitted(Kind::Sphere, method, m.progress)?,
            Class::Circle => feature.profile(method, m.progress)?,
            Class::Cylinder => feature.refitted(Kind::Cylinder, method, m.progress)?,
            Class::Point | Class::Line | Class::Plane | Class::Cone | Class::Torus => {
                return Err(NotMeasured::NoDiameter.into());
            }
        };
        let radius = match fit.shape {
            Shape::Cylinder { radius, .. } | Shape::Sphere { radius, .. } | Shape::Circle2 { radius, .. } => {
                radius
            }
            _ => return Err(NotMeasured::NoDiameter.into()),
        };
        let witness = feature.form(&fit).witness;
        Ok(Value { value: 2.0 * radius, witness, ..Value::default() })
    }
}

/// The two-point size that is farthest from the middle of what is allowed, with the least, greatest and number of all.
fn two_point(m: &Measuring) -> Result<Value, Missing> {
    let sizes = match m.features {
        [a, b] => {
            let (first, second) = (a.own_points()?, b.own_points()?);
            let Some((normal, _)) = parallel_planes(first, second) else {
                return Err(ZoneError::NoPlanes.into());
            };
            two_point_distances([first, second], normal, m.progress)
        }
        _ => {
            let feature = m.feature();
            let kind = if feature.class == Class::Circle { Kind::Circle } else { Kind::Cylinder };
            match feature.refitted(kind, Method::Gaussian, m.progress)?.shape {
                Shape::Cylinder { point, direction, .. }
                | Shape::Circle { center: point, normal: direction, .. } => {
                    two_point_diameters(feature.own_points()?, point, direction, m.progress)
                }
                _ => return Err(NotMeasured::NoDiameter.into()),
            }
        }
    };
    let sizes = sizes.map_err(|_| Missing::Cancelled)?;
    let (lower, upper) = m.spec.limits.range();
    let middle = lower.map_or(upper, |lower| 0.5 * (lower + upper));
    let away = |t: &&TwoPoint| (t.size - middle).abs();
    let Some(worst) = sizes.iter().max_by(|a, b| away(a).total_cmp(&away(b))) else {
        return Err(NotMeasured::NoOppositePlace.into());
    };
    let (least, greatest) =
        sizes.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, g), t| (l.min(t.size), g.max(t.size)));
    Ok(Value {
        value: worst.size,
        witness: worst.ends.to_vec(),
        parts: vec![("least", least), ("greatest", greatest), ("count", sizes.len() as f64)],
        ..Value::default()
    })
}
