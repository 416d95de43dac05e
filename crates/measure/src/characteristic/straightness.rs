//! Straightness: ISO 1101:2017, 17.2; ISO 12780-1. ASME Y14.5-2018, 8.4.1 agrees.

use super::kind::{Characteristic, Measuring, Question, Refusal, refuse};
use super::material::straight;
use super::measured_feature::form;
use super::reason::{Lack, NotMeasured};
use super::value::{Missing, Value};
use trueness_document::plan::Class;
use trueness_document::tolerance_class::Table;
use trueness_geom::fit::{Method, Options, fit};
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::zone::median_line;

/// Of a cylinder: the diameter of the thinnest cylinder that holds its extracted median line, the centers of its sections; with
/// a material requirement its surface must keep the virtual condition (see the module of material requirements). Of points in
/// space: that of the line which they are. Of points of two columns: the distance of the two nearest parallel lines in the
/// plane that hold an extracted line.
#[derive(Debug)]
pub struct Straightness;

impl Characteristic for Straightness {
    fn word(&self) -> &'static str {
        "straightness"
    }
    fn symbol(&self) -> &'static str {
        "⏤"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.2; ISO 12780-1:2011"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "class", "length", "method", "material"]
    }
    fn class_table(&self) -> Option<Table> {
        Some(Table::Form)
    }
    fn diametral(&self, _: &Question, planar: bool) -> bool {
        !planar
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        if q.class(&[Class::Line, Class::Cylinder])? == Class::Line && q.spec.material.is_some() {
            return refuse("material", "a material requirement is evaluated for the axis of a cylinder");
        }
        Ok(())
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let feature = m.feature();
        if feature.class == Class::Cylinder {
            return match m.spec.material {
                Some(_) => straight(m),
                None => of_axis(m),
            };
        }
        let kind = if feature.planar { Kind::Line2 } else { Kind::Line };
        let fit = feature.refitted(kind, m.spec.form, m.progress)?;
        Ok(of_line(m, feature.form(&fit), feature.planar))
    }
}

/// The straightness of the median line of a cylinder.
fn of_axis(m: &Measuring) -> Result<Value, Missing> {
    let feature = m.feature();
    let Shape::Cylinder { point, direction, .. } =
        feature.refitted(Kind::Cylinder, Method::Gaussian, m.progress)?.shape
    else {
        return Err(NotMeasured::NoAxis.into());
    };
    let line =
        median_line(feature.own_points()?, point, direction, m.progress).map_err(|_| Missing::Cancelled)?;
    if line.centers.len() < 3 {
        return Err(feature.lacks(Lack::Sections { found: line.centers.len() }));
    }
    let options = Options { method: m.spec.form, ..Options::default() };
    let fit = fit(&line.centers, Kind::Line, &options, m.progress)?;
    let mut value = of_line(m, form(&line.centers, &fit), false);
    value.parts.push(("sections", line.centers.len() as f64));
    if line.excluded > 0 {
        value.notes.push(format!("{} sections have too few points around the axis", line.excluded));
    }
    Ok(value)
}

/// The value of a line, in space or in a plane.
fn of_line(m: &Measuring, mut value: Value, planar: bool) -> Value {
    // A least-squares line in space has no least cylinder: twice the greatest distance from it.
    if m.spec.form == Method::Gaussian && !planar {
        value.notes.push("twice the greatest distance from the least-squares line".into());
    }
    value
}
