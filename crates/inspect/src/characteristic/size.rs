//! Sizes: ISO 14405-1:2016, 3.7 (global linear sizes).

use super::kind::{Allowed, Characteristic, Measuring, Question, Refusal, refuse};
use super::value::{Missing, Value};
use crate::plan::Class;
use crate::plan::text::SizeWord;
use crate::tolerance_class::Table;
use trueness_geom::fit::Method;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::zone::datum::mean;
use trueness_geom::zone::parallel_planes;

/// The diameter of the associated cylinder, sphere or circle (of points in space, in their least-squares plane): least squares (GG), minimum circumscribed (GN), maximum
/// inscribed (GX) or minimax (GC); of two opposite planes, the distance of the two parallel planes with least squares (GG).
#[derive(Debug)]
pub struct Size;

impl Characteristic for Size {
    fn word(&self) -> &'static str {
        "size"
    }
    fn standard(&self) -> &'static str {
        "ISO 14405-1:2016, 3.7"
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
        let size = match q.spec.size {
            None => {
                return refuse(
                    "kind",
                    "it needs `size`: \"GG\", \"GN\", \"GX\" or \"GC\" (two-point sizes, LP, are not built yet)",
                );
            }
            Some(SizeWord::Lp) => {
                return refuse("size", "two-point sizes (LP) are not built yet; choose GG, GN, GX or GC");
            }
            Some(size) => size,
        };
        if let [a, b] = q.spec.features.as_slice() {
            if [a, b].iter().any(|f| q.features[**f].class != Class::Plane) {
                return refuse("feature", "the size of two features is that of two opposite planes");
            }
            return match size {
                SizeWord::Gg => Ok(()),
                _ => refuse("size", "of two planes only the least-squares size (GG) is built yet"),
            };
        }
        q.class(&[Class::Cylinder, Class::Sphere, Class::Circle]).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        if let [a, b] = m.features {
            let (first, second) = (a.taken()?, b.taken()?);
            let Some((_, distance)) = parallel_planes(first, second) else {
                return Err(Missing::NotMeasured(
                    "the points of the two planes determine no parallel planes".into(),
                ));
            };
            return Ok(Value {
                value: distance,
                witness: vec![mean(first), mean(second)],
                ..Value::default()
            });
        }
        let method = match m.spec.size {
            Some(SizeWord::Gn) => Method::MinimumCircumscribed,
            Some(SizeWord::Gx) => Method::MaximumInscribed,
            Some(SizeWord::Gc) => Method::MinimumZone,
            _ => Method::Gaussian,
        };
        let feature = m.feature();
        let fit = match feature.class {
            Class::Sphere => feature.refitted(Kind::Sphere, method, m.progress)?,
            Class::Circle => feature.profile(method, m.progress)?,
            _ => feature.refitted(Kind::Cylinder, method, m.progress)?,
        };
        let radius = match fit.shape {
            Shape::Cylinder { radius, .. } | Shape::Sphere { radius, .. } | Shape::Circle2 { radius, .. } => {
                radius
            }
            _ => return Err(Missing::NotMeasured("the element has no diameter".into())),
        };
        let witness = feature.form(&fit).witness;
        Ok(Value { value: 2.0 * radius, diametral: true, witness, ..Value::default() })
    }
}
