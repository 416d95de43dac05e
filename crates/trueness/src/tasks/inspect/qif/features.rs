//! Features as they were measured.

use super::xml::{Value, Xml, decimal, three};
use trueness_document::Named;
use trueness_document::fit::Number;
use trueness_document::inspect::FeatureRecord;
use trueness_document::plan::Class;

/// Writes a feature under `id`, of the part `component`.
pub fn measured(x: &mut Xml, f: &FeatureRecord, id: u32, component: u32) {
    let name = match *f.shape {
        Class::Plane => "PlaneFeatureMeasurement",
        Class::Cylinder => "CylinderFeatureMeasurement",
        Class::Cone => "ConeFeatureMeasurement",
        Class::Sphere => "SphereFeatureMeasurement",
        Class::Torus => "TorusFeatureMeasurement",
        Class::Circle => "CircleFeatureMeasurement",
        Class::Line => "LineFeatureMeasurement",
        Class::Point => "PointFeatureMeasurement",
    };
    x.element(name, &[("id", id.to_string())], |x| {
        x.attributes(&attributes(f));
        x.leaf("FeatureName", &f.id);
        x.leaf("ActualComponentId", &component.to_string());
        geometry(x, f);
    });
}

fn one(f: &FeatureRecord, name: &str) -> Option<f64> {
    match f.parameters.as_ref()?.get(name)? {
        Number::One(value) => Some(*value),
        Number::Three(_) => None,
    }
}

fn place(f: &FeatureRecord, name: &str) -> Option<String> {
    match f.parameters.as_ref()?.get(name)? {
        Number::Three(p) => Some(three(*p)),
        Number::One(_) => None,
    }
}

/// The element; lengths are diameters and angles degrees, as QIF has them.
fn geometry(x: &mut Xml, f: &FeatureRecord) {
    let leaf = |x: &mut Xml, name: &str, text: Option<String>| {
        if let Some(text) = text {
            x.leaf(name, &text);
        }
    };
    let axis = |x: &mut Xml, point: &str| {
        if let (Some(point), Some(direction)) = (place(f, point), place(f, "direction")) {
            x.element("Axis", &[], |x| {
                x.leaf("AxisPoint", &point);
                x.leaf("Direction", &direction);
            });
        }
    };
    let twice = |name: &str| one(f, name).map(|r| decimal(2.0 * r));
    let form = f.form_error.map(decimal);
    match *f.shape {
        Class::Plane => {
            leaf(x, "Location", place(f, "point"));
            leaf(x, "Normal", place(f, "normal"));
            leaf(x, "Form", form);
        }
        Class::Cylinder => {
            axis(x, "point");
            leaf(x, "Diameter", twice("radius"));
            leaf(x, "Form", form);
        }
        Class::Cone => {
            // The diameter is that at the axis point.
            axis(x, "point");
            leaf(x, "Diameter", twice("radius"));
            leaf(x, "HalfAngle", one(f, "half_angle").map(|a| decimal(a.to_degrees())));
            leaf(x, "Form", form);
        }
        Class::Sphere => {
            leaf(x, "Location", place(f, "center"));
            leaf(x, "Diameter", twice("radius"));
            leaf(x, "Form", form);
        }
        Class::Torus => {
            leaf(x, "Location", place(f, "center"));
            leaf(x, "AxisVector", place(f, "direction"));
            leaf(x, "MinorDiameter", twice("minor_radius"));
            leaf(x, "MajorDiameter", twice("major_radius"));
        }
        Class::Circle => {
            leaf(x, "Location", place(f, "center"));
            leaf(x, "Normal", place(f, "normal").or_else(|| place(f, "direction")));
            leaf(x, "Diameter", twice("radius"));
            leaf(x, "Form", form);
        }
        Class::Line => {
            leaf(x, "Location", place(f, "point"));
            leaf(x, "Direction", place(f, "direction"));
            leaf(x, "Form", form);
        }
        Class::Point => leaf(x, "Location", place(f, "point").or_else(|| place(f, "center"))),
    }
}

/// What QIF has no element for.
fn attributes(f: &FeatureRecord) -> Vec<(&'static str, Value)> {
    let mut all: Vec<(&'static str, Value)> = vec![
        ("shape", f.shape.name().into()),
        ("source", f.source.name().into()),
        ("method", f.method.name().into()),
        ("points", (f.points as f64).into()),
    ];
    let numbers = [("form_error", f.form_error), ("rms", f.rms), ("coverage", f.coverage)];
    all.extend(numbers.into_iter().filter_map(|(name, x)| Some((name, x?.into()))));
    let texts = [("reason", &f.reason), ("uncertainty_reason", &f.uncertainty_reason)];
    all.extend(texts.into_iter().filter_map(|(name, t)| Some((name, t.as_deref()?.into()))));
    for (name, set) in [("parameters", &f.parameters), ("uncertainty", &f.uncertainty)] {
        if let Some(set) = set {
            all.push((name, serde_json::to_string(set).unwrap_or_default().into()));
        }
    }
    if let Some(left) = &f.left_out {
        all.push(("left_out", serde_json::to_string(left).unwrap_or_default().into()));
    }
    all
}
