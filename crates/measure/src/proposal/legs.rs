//! The lengths that general tolerances go by: sides of planes, and legs of angles.

use trueness_geom::feature::Nominal;
use trueness_geom::space::{Point, Vector, cross, dot, minus, unit};

/// How far places go along a direction.
fn extent(places: &[Point], way: Vector) -> f64 {
    let along = places.iter().map(|p| dot(*p, way));
    let [from, to] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    (to - from).max(0.0)
}

/// The longer side of the least rectangle around the border of a plane; of a circle its diameter.
pub(super) fn longer_side(boundary: &[Point], normal: Vector) -> f64 {
    let n = boundary.len();
    let sides = (0..n).filter_map(|k| {
        let (way, _) = unit(minus(boundary[(k + 1) % n], boundary[k]))?;
        let [a, b] = [way, cross(normal, way)].map(|way| extent(boundary, way));
        Some((a * b, a.max(b)))
    });
    sides.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, longer)| longer)
}

/// Signed distance of a place from a plane; 0 of what is none.
pub(super) fn within(plane: &Nominal, place: Point) -> f64 {
    match plane {
        Nominal::Plane { point, normal, .. } => dot(minus(place, *point), *normal),
        _ => 0.0,
    }
}

/// The shorter leg of the angle that a feature makes with a plane: how far each goes across the line where they meet.
pub(super) fn legs(own: &Nominal, datum: &Nominal) -> f64 {
    let Nominal::Plane { normal, boundary, .. } = datum else { return 0.0 };
    match own {
        Nominal::Plane { normal: other, boundary: border, .. } => {
            let edge = cross(*normal, *other);
            let leg = |border: &[Point], normal: Vector| {
                unit(cross(edge, normal)).map_or(0.0, |(way, _)| extent(border, way))
            };
            leg(boundary, *normal).min(leg(border, *other))
        }
        Nominal::Cylinder { length, .. } => length.min(longer_side(boundary, *normal)),
        Nominal::Cone { between: [from, to], .. } => (to - from).min(longer_side(boundary, *normal)),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::{legs, longer_side};
    use trueness_geom::feature::Nominal;

    fn plane(normal: [f64; 3], boundary: Vec<[f64; 3]>) -> Nominal {
        Nominal::Plane { point: boundary[0], normal, boundary }
    }

    /// A floor of 50 by 20 and a wall 8 high on its longer side; seen askew the floor has the same sides.
    #[test]
    fn sides_and_legs_are_those_of_a_box() {
        let floor = vec![[0.0, 0.0, 0.0], [50.0, 0.0, 0.0], [50.0, 20.0, 0.0], [0.0, 20.0, 0.0]];
        let wall = vec![[0.0, 0.0, 0.0], [50.0, 0.0, 0.0], [50.0, 0.0, 8.0], [0.0, 0.0, 8.0]];
        assert_eq!(longer_side(&floor, [0.0, 0.0, 1.0]), 50.0);
        let turned: Vec<[f64; 3]> =
            floor.iter().map(|[x, y, _]| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, 0.0]).collect();
        assert!((longer_side(&turned, [0.0, 0.0, 1.0]) - 50.0).abs() < 1e-12);
        let floor = plane([0.0, 0.0, -1.0], floor);
        assert_eq!(legs(&plane([0.0, -1.0, 0.0], wall), &floor), 8.0);
        let pin =
            |length| Nominal::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 1.0], radius: 1.0, length };
        assert_eq!([legs(&pin(4.0), &floor), legs(&pin(400.0), &floor)], [4.0, 50.0]);
    }
}
