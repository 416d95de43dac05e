//! Areal texture of a feature's residuals: ISO 25178-2:2021, height parameters.
//!
//! The form that is taken off is the associated element (the F-operator). No filter is applied: the scan's own resolution
//! bounds the scale.

use super::kind::{Characteristic, Measuring, Question, Refusal};
use super::reason::NotMeasured;
use super::value::{Missing, Value};
use trueness_document::plan::{Class, TextureWord};
use trueness_geom::zone::texture::texture;

/// Sa, Sq, Sz, Ssk and Sku of the distances of the feature's points from its element. On a mesh each point stands for a
/// third of the area of the feature's facets about it, in a cloud all points count alike.
#[derive(Debug)]
pub struct Texture;

impl Characteristic for Texture {
    fn word(&self) -> &'static str {
        "texture"
    }
    fn standard(&self) -> &'static str {
        "ISO 25178-2:2021, height parameters"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "parameter"]
    }
    fn unit(&self, parameter: TextureWord) -> &'static str {
        if parameter.is_length() { "mm" } else { "1" }
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        q.class(&[Class::Plane, Class::Sphere, Class::Cylinder, Class::Cone, Class::Torus]).map(|_| ())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let feature = m.feature();
        let shape = feature.shape()?;
        let heights: Vec<f64> = feature.points.iter().map(|p| shape.distance(*p)).collect();
        let Some(t) = texture(&heights, &feature.areas) else {
            return Err(NotMeasured::NoHeights.into());
        };
        let flat = NotMeasured::Flat;
        let value = match m.spec.parameter {
            TextureWord::Sa => t.sa,
            TextureWord::Sq => t.sq,
            TextureWord::Sz => t.sz,
            TextureWord::Ssk => t.ssk.ok_or(flat)?,
            TextureWord::Sku => t.sku.ok_or(flat)?,
        };
        let mut parts = vec![("Sa", t.sa), ("Sq", t.sq), ("Sz", t.sz)];
        parts.extend(t.ssk.map(|x| ("Ssk", x)));
        parts.extend(t.sku.map(|x| ("Sku", x)));
        Ok(Value { value, parts, ..Value::default() })
    }
}
