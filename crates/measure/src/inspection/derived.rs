//! Features that are derived from others: median planes, intersections, midpoints, projections.

use crate::characteristic::{Element, MeasuredFeature, NoElement};
use trueness_document::plan::{Class, DerivedWord};
use trueness_geom::shape::derived::{Ray, line_plane, median_plane, midpoint, plane_plane, point_plane};
use trueness_geom::space::{Point, minus, plus, times};
use trueness_geom::zone::datum::Datum;

/// The element of a feature that others are made of.
fn element(taken: &MeasuredFeature) -> Result<&Element, NoElement> {
    let wrapped =
        |reason: &NoElement| NoElement::Source { id: taken.id.clone(), reason: Box::new(reason.clone()) };
    taken.element.as_ref().map_err(wrapped)
}

/// A plane or axis of a feature.
fn ray(taken: &MeasuredFeature) -> Result<Ray, NoElement> {
    let none = || NoElement::SourceWithoutAxis { id: taken.id.clone() };
    match element(taken)? {
        Element::Derived(Datum::Plane { point, normal }) => Ok(Ray { point: *point, direction: *normal }),
        Element::Derived(Datum::Axis { point, direction }) => {
            Ok(Ray { point: *point, direction: *direction })
        }
        Element::Fit(fit) => {
            let (point, direction) = (fit.shape.foot(), fit.shape.direction());
            Ok(Ray { point: point.ok_or_else(none)?, direction: direction.ok_or_else(none)? })
        }
        Element::Point(_) | Element::Derived(Datum::Point(_)) => Err(none()),
    }
}

fn center(taken: &MeasuredFeature) -> Result<Point, NoElement> {
    element(taken)?;
    let points = taken.zoned().unwrap_or_default();
    points.first().copied().ok_or_else(|| NoElement::SourceWithoutCenter { id: taken.id.clone() })
}

/// A feature that is made of two others; `taken` is what it is without them.
pub(super) fn derived(
    mut taken: MeasuredFeature,
    how: DerivedWord,
    a: &MeasuredFeature,
    b: &MeasuredFeature,
) -> MeasuredFeature {
    let made = match how {
        DerivedWord::MedianPlane => median(&mut taken, a, b),
        DerivedWord::Intersection => intersection(a, b),
        DerivedWord::Midpoint => center(a).and_then(|p| center(b).map(|q| Element::Point(midpoint(p, q)))),
        DerivedWord::Projection => center(a).and_then(|p| {
            let plane = ray(b)?;
            Ok(Element::Point(minus(p, times(point_plane(p, plane), plane.direction))))
        }),
    };
    taken.element = made;
    taken
}

/// The plane half way between two, and their points projected onto it: its extent.
fn median(
    taken: &mut MeasuredFeature,
    a: &MeasuredFeature,
    b: &MeasuredFeature,
) -> Result<Element, NoElement> {
    let (first, second) = (ray(a)?, ray(b)?);
    let plane = median_plane(first, second).ok_or(NoElement::Perpendicular)?;
    let onto = |p: &Point| plus(*p, times(-point_plane(*p, plane), plane.direction));
    taken.points = a.points.iter().chain(&b.points).map(onto).collect();
    taken.areas = vec![1.0; taken.points.len()];
    Ok(Element::Derived(Datum::Plane { point: plane.point, normal: plane.direction }))
}

fn intersection(a: &MeasuredFeature, b: &MeasuredFeature) -> Result<Element, NoElement> {
    let (first, second) = (ray(a)?, ray(b)?);
    let parallel = NoElement::Parallel;
    match (a.class, b.class) {
        (Class::Plane, Class::Plane) => {
            let line = plane_plane(first, second, midpoint(first.point, second.point)).ok_or(parallel)?;
            Ok(Element::Derived(Datum::Axis { point: line.point, direction: line.direction }))
        }
        (Class::Plane, _) => line_plane(second, first).map(Element::Point).ok_or(parallel),
        _ => line_plane(first, second).map(Element::Point).ok_or(parallel),
    }
}
