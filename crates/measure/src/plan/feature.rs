//! The features of a plan.

use super::checker::Checker;
use crate::cad_faces::FaceChoice;
use crate::requirement::{Extract, Feature, Source};
use std::ops::Range;
use trueness_document::plan::{
    At, Class, DerivedWord, ExtractText, FaceText, FeatureText, MethodWord, NominalText, PlanError, PlanText,
    ShapeWord, unknown,
};
use trueness_geom::feature::{Nearness, Nominal};
use trueness_geom::fit::Method;
use trueness_geom::space::{Point, Vector, unit};

/// Classes that faces of the reference may have.
const SOUGHT: [Class; 4] = [Class::Plane, Class::Cylinder, Class::Cone, Class::Sphere];
/// Classes of which it may have to be said whether the material is around them or within.
const ROUND: [Class; 3] = [Class::Cylinder, Class::Cone, Class::Sphere];

/// Angle between normals within which facets belong to a feature, where the plan says nothing.
const DEFAULT_FACING_DEGREES: f64 = 15.0;
/// Least share of the nominal area that must have been measured, where the plan says nothing.
pub(crate) const DEFAULT_MIN_COVERAGE: f64 = 0.25;

pub(super) fn features(checker: &Checker, written: &PlanText) -> Result<Vec<Feature>, PlanError> {
    let mut all: Vec<Feature> = Vec::new();
    for At { value, span } in &written.feature {
        checker.id(&value.id)?;
        if let Some(other) = all.iter().find(|f| f.id == value.id.value) {
            return checker.wrong(
                &value.id.span,
                format!("there are two features \"{}\"; give each its own id", other.id),
            );
        }
        all.push(feature(checker, value, span, &all, written)?);
    }
    Ok(all)
}

/// The number of a feature by its name.
pub(super) fn named(
    checker: &Checker,
    name: &str,
    span: &Range<usize>,
    features: &[Feature],
) -> Result<usize, PlanError> {
    let known: Vec<&str> = features.iter().map(|f| f.id.as_str()).collect();
    features
        .iter()
        .position(|f| f.id == name)
        .map_or_else(|| checker.wrong(span, unknown("feature", name, &known)), Ok)
}

fn feature(
    checker: &Checker,
    written: &FeatureText,
    whole: &Range<usize>,
    before: &[Feature],
    plan: &PlanText,
) -> Result<Feature, PlanError> {
    let id = &written.id.value;
    let method = match written.method.as_ref().map(|m| m.value) {
        None | Some(MethodWord::Gaussian) => Method::Gaussian,
        Some(MethodWord::MinimumZone) => Method::MinimumZone,
        Some(MethodWord::MinimumCircumscribed) => Method::MinimumCircumscribed,
        Some(MethodWord::MaximumInscribed) => Method::MaximumInscribed,
        Some(MethodWord::Robust) => Method::Robust,
    };
    let outward = match &written.outward {
        Some(v) if unit(v.value).is_none() => {
            return checker.wrong(&v.span, "`outward` has no length; give a direction out of the material");
        }
        other => other.as_ref().map(|v| v.value),
    };
    let mut made = Feature {
        id: id.clone(),
        span: written.id.span.clone(),
        class: Class::Point,
        source: Source::Nominal,
        nominal: None,
        extract: extract(checker, written.extract.as_ref())?,
        method,
        outward,
        internal: written.internal.as_ref().map(|i| i.value),
    };
    if let Some(derived) = &written.derived {
        if let Some(shape) = &written.shape {
            return checker
                .wrong(&shape.span, "a derived feature takes no shape; it follows from its features");
        }
        if let Some(internal) = &written.internal {
            return checker
                .wrong(&internal.span, "`internal` is for cylinders, cones and spheres: bores and shafts");
        }
        (made.class, made.source) = self::derived(checker, derived, written.of.as_ref(), before)?;
        return Ok(made);
    }
    let Some(shape) = &written.shape else {
        return checker.wrong(whole, format!("feature \"{id}\" needs `shape`, or `derived` with `of`"));
    };
    made.class = class(checker, shape)?;
    if let Some(internal) = written.internal.as_ref().filter(|_| !ROUND.contains(&made.class)) {
        return checker
            .wrong(&internal.span, "`internal` is for cylinders, cones and spheres: bores and shafts");
    }
    if let Some(nominal) = &written.nominal {
        made.nominal = Some(self::nominal(checker, shape.value, nominal)?);
    }
    one_source(checker, written)?;
    if let Some(seed) = &written.seed {
        if plan.reference.is_none() {
            let what = "a seed lies on the reference, but the plan names none; add `reference`";
            return checker.wrong(&seed.span, what);
        }
        made.source = seeded(checker, seed, made.class)?;
    } else if let Some(points) = &written.points {
        made.source = Source::Points(points.clone());
    } else if let Some(choice) = chosen_faces(checker, written, plan, made.class)? {
        made.source = Source::Faces(choice);
    } else if made.nominal.is_none() {
        let what = format!("feature \"{id}\" has no points: give `points`, `nominal`, `seed` or `face`");
        return checker.wrong(whole, what);
    }
    if !matches!(made.source, Source::Points(_)) && plan.measured.is_none() {
        let what = format!(
            "feature \"{id}\" is to be found in the measured data, but the plan names none; add `measured`"
        );
        return checker.wrong(&written.id.span, what);
    }
    Ok(made)
}

/// A feature by the region of the reference around a place.
fn seeded(checker: &Checker, seed: &At<[f64; 3]>, class: Class) -> Result<Source, PlanError> {
    if !SOUGHT.contains(&class) {
        let what = format!("regions are planes, cylinders, cones and spheres; a {} has none", class.word());
        return checker.wrong(&seed.span, what);
    }
    if !seed.value.iter().all(|x| x.is_finite()) {
        return checker.wrong(&seed.span, "the seed is a place of three finite numbers");
    }
    Ok(Source::Seed(At { value: checker.place(seed.value), span: seed.span.clone() }))
}

/// Refuses a feature that comes from several places.
fn one_source(checker: &Checker, written: &FeatureText) -> Result<(), PlanError> {
    let others = written.nominal.is_some() || written.points.is_some();
    let faces = written.face.as_ref().map(|f| &f.span).or(written.name.as_ref().map(|n| &n.span));
    match (&written.seed, faces) {
        (Some(seed), None) if others => {
            checker.wrong(&seed.span, "give one of `seed`, `nominal` and `points`")
        }
        (seed, Some(span))
            if others || seed.is_some() || (written.face.is_some() && written.name.is_some()) =>
        {
            checker.wrong(span, "give one of `face`, `name`, `seed`, `nominal` and `points`")
        }
        (_, None) if written.instance.is_some() => {
            let span = written.instance.as_ref().map_or(0..0, |i| i.span.clone());
            checker.wrong(&span, "`instance` says of which instance a `face` or `name` is; give one of them")
        }
        _ => Ok(()),
    }
}

/// The faces of the reference that a feature is, where it names some.
fn chosen_faces(
    checker: &Checker,
    written: &FeatureText,
    plan: &PlanText,
    class: Class,
) -> Result<Option<At<FaceChoice>>, PlanError> {
    let (numbers, span) = match (&written.face, &written.name) {
        (Some(face), _) => match &face.value {
            FaceText::One(number) => (vec![*number], face.span.clone()),
            FaceText::Several(numbers) => (numbers.clone(), face.span.clone()),
        },
        (None, Some(name)) => (vec![], name.span.clone()),
        (None, None) => return Ok(None),
    };
    if plan.reference.is_none() {
        let what = "faces are those of the reference, but the plan names none; add `reference`";
        return checker.wrong(&span, what);
    }
    if written.name.is_none() && numbers.is_empty() {
        return checker.wrong(&span, "the list of faces is empty; give the number of one at least");
    }
    if written.name.as_ref().is_some_and(|name| name.value.trim().is_empty()) {
        return checker.wrong(
            &span,
            "the name is empty; give the one that the file has for the faces, or their numbers by `face`",
        );
    }
    if !SOUGHT.contains(&class) {
        let what =
            format!("faces are sought as planes, cylinders, cones and spheres; a {} is not", class.word());
        return checker.wrong(&span, what);
    }
    let text = |at: &Option<At<String>>| at.as_ref().map(|at| at.value.trim().to_string());
    let value = FaceChoice { numbers, name: text(&written.name), instance: text(&written.instance) };
    Ok(Some(At { value, span }))
}

fn class(checker: &Checker, shape: &At<ShapeWord>) -> Result<Class, PlanError> {
    Ok(match shape.value {
        ShapeWord::Point => Class::Point,
        ShapeWord::Line | ShapeWord::Edge => Class::Line,
        ShapeWord::Plane => Class::Plane,
        ShapeWord::Circle => Class::Circle,
        ShapeWord::Sphere => Class::Sphere,
        ShapeWord::Cylinder => Class::Cylinder,
        ShapeWord::Cone => Class::Cone,
        ShapeWord::Torus => Class::Torus,
        ShapeWord::Surface => {
            return checker.wrong(
                &shape.span,
                "surfaces of any form are not built into `inspect` yet; `trueness compare` measures them",
            );
        }
    })
}

fn derived(
    checker: &Checker,
    how: &At<DerivedWord>,
    of: Option<&At<Vec<At<String>>>>,
    before: &[Feature],
) -> Result<(Class, Source), PlanError> {
    let Some(of) = of else {
        return checker.wrong(&how.span, "a derived feature needs `of`, a list of two features");
    };
    let [a, b] = of.value.as_slice() else {
        return checker.wrong(&of.span, "a derived feature is made of two features");
    };
    let number = |name: &At<String>| {
        let known: Vec<&str> = before.iter().map(|f| f.id.as_str()).collect();
        before.iter().position(|f| f.id == name.value).map_or_else(
            || {
                checker.wrong(
                    &name.span,
                    format!(
                        "{}; features stand before those made of them",
                        unknown("feature", &name.value, &known)
                    ),
                )
            },
            Ok,
        )
    };
    let of_two = [number(a)?, number(b)?];
    let classes = of_two.map(|n| before[n].class);
    let axis = |c: Class| matches!(c, Class::Line | Class::Cylinder | Class::Cone);
    let place = |c: Class| matches!(c, Class::Point | Class::Sphere | Class::Circle);
    let class = match (how.value, classes) {
        (DerivedWord::MedianPlane, [Class::Plane, Class::Plane]) => Class::Plane,
        (DerivedWord::Intersection, [Class::Plane, Class::Plane]) => Class::Line,
        (DerivedWord::Intersection, [x, Class::Plane] | [Class::Plane, x]) if axis(x) => Class::Point,
        (DerivedWord::Midpoint, [x, y]) if place(x) && place(y) => Class::Point,
        (DerivedWord::Projection, [x, Class::Plane]) if place(x) => Class::Point,
        (_, [x, y]) => {
            let what = format!("this cannot be made of a {} and a {}", x.word(), y.word());
            return checker.wrong(&of.span, what);
        }
    };
    Ok((class, Source::Derived { how: how.value, of: of_two }))
}

fn nominal(checker: &Checker, shape: ShapeWord, at: &At<NominalText>) -> Result<Nominal, PlanError> {
    let NominalText {
        point,
        normal,
        direction,
        boundary,
        radius,
        length,
        center,
        apex,
        half_angle,
        between,
        normals,
    } = at.value.clone();
    let missing = |key: &str| -> PlanError {
        PlanError::at(checker.text, &at.span, format!("the nominal feature needs `{key}`"))
    };
    let place = |p: Option<Point>, key| p.map(|p| checker.place(p)).ok_or_else(|| missing(key));
    let way = |v: Option<Vector>, key| v.ok_or_else(|| missing(key));
    let size = |x: Option<f64>, key| x.map(|x| x * checker.unit).ok_or_else(|| missing(key));
    let made = match shape {
        ShapeWord::Plane => Nominal::Plane {
            point: place(point, "point")?,
            normal: way(normal, "normal")?,
            boundary: boundary
                .ok_or_else(|| missing("boundary"))?
                .into_iter()
                .map(|p| checker.place(p))
                .collect(),
        },
        ShapeWord::Cylinder => Nominal::Cylinder {
            point: place(point, "point")?,
            direction: way(direction, "direction")?,
            radius: size(radius, "radius")?,
            length: size(length, "length")?,
        },
        ShapeWord::Cone => Nominal::Cone {
            apex: place(apex, "apex")?,
            direction: way(direction, "direction")?,
            half_angle: half_angle.ok_or_else(|| missing("half_angle"))?.to_radians(),
            between: between.ok_or_else(|| missing("between"))?.map(|x| x * checker.unit),
        },
        ShapeWord::Sphere => {
            Nominal::Sphere { center: place(center, "center")?, radius: size(radius, "radius")? }
        }
        ShapeWord::Edge => Nominal::Edge {
            point: place(point, "point")?,
            direction: way(direction, "direction")?,
            length: size(length, "length")?,
            normals: normals.ok_or_else(|| missing("normals"))?,
        },
        ShapeWord::Point | ShapeWord::Line | ShapeWord::Circle | ShapeWord::Torus | ShapeWord::Surface => {
            return checker.wrong(
                &at.span,
                "a nominal is for planes, cylinders, cones, spheres and edges; give `points`",
            );
        }
    };
    // The same rules as when the feature is sought, before any file is read.
    let probe = Nearness { distance: 1.0, angle: 0.1, margin: 0.0, rim: true, inward: None };
    match trueness_geom::feature::in_cloud(&[], &made, &probe) {
        Ok(_) => Ok(made),
        Err(e) => checker.wrong(&at.span, e.to_string()),
    }
}

/// How near measured facets must be, as the plan has it.
fn extract(checker: &Checker, written: Option<&ExtractText>) -> Result<Extract, PlanError> {
    let none = ExtractText::default();
    let written = written.unwrap_or(&none);
    let coverage = match &written.coverage {
        Some(n) if !(0.0..=1.0).contains(&n.value) => {
            return checker.wrong(&n.span, format!("the coverage is {}; it is a share from 0 to 1", n.value));
        }
        other => other.as_ref().map_or(DEFAULT_MIN_COVERAGE, |n| n.value),
    };
    let angle = match &written.angle {
        Some(a) if !(a.value > 0.0 && a.value < 90.0) => {
            return checker
                .wrong(&a.span, format!("the angle is {}; give degrees between 0 and 90", a.value));
        }
        other => other.as_ref().map_or(DEFAULT_FACING_DEGREES, |a| a.value).to_radians(),
    };
    Ok(Extract {
        distance: written.distance.as_ref().map(|d| checker.positive(d, "the distance")).transpose()?,
        margin: written.margin.as_ref().map(|m| checker.length(m, "the margin")).transpose()?,
        angle,
        rim: written.rim.unwrap_or(true),
        outliers: written.outliers.unwrap_or(false),
        coverage,
    })
}
