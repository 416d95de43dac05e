//! Reflection lines: what a surface shows of straight lamps far away.
//!
//! The eye looks from far along the mean normal, and the lamps are parallel lines far behind it, along an axis of the base. A
//! place shows the lamp at the angle in which the mirrored line of sight goes, seen along the lamps; so reflection lines are the lines of equal
//! such angles (Klass 1980, here with eye and lamps at infinity). Where they have a corner the surface has a bend in its curvature,
//! where they break off it has an edge.

use crate::Mark;
use std::f64::consts::PI;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// Lamps over the range of the angles.
const LAMPS: usize = 24;

/// The reflection lines through facets, from the normals at their vertices; of vertices without one there are none. Lamps
/// run along the first of `axes` that the eye does not look along. None where the normals have no mean, or all places show the same.
pub(super) fn reflection_lines(mesh: &Mesh, normals: &[Option<Vector>], axes: [Vector; 3]) -> Mark {
    let mut mark = Mark::default();
    let sum = normals.iter().flatten().fold([0.0; 3], |sum, n| plus(sum, *n));
    let Some((eye, _)) = unit(sum) else { return mark };
    let across = |axis: &Vector| minus(*axis, times(dot(*axis, eye), eye));
    let Some((lamp, _)) = axes.iter().map(across).find(|a| norm(*a) > 0.5).and_then(unit) else {
        return mark;
    };
    let beside = cross(eye, lamp);
    let angle = |n: &Vector| {
        let mirrored = minus(times(2.0 * dot(*n, eye), *n), eye);
        libm::atan2(dot(mirrored, beside), dot(mirrored, eye))
    };
    let angles: Vec<f64> = normals.iter().map(|n| n.as_ref().map_or(f64::NAN, angle)).collect();
    let of_facets = mesh.faces.iter().flatten().map(|v| angles[*v as usize]).filter(|a| a.is_finite());
    let (low, high) = of_facets.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), a| (l.min(a), h.max(a)));
    // The first and the last lamp are seen half a step from the ends.
    let step = (high - low) / LAMPS as f64;
    if step.is_nan() || step <= 0.0 {
        return mark;
    }
    for face in &mesh.faces {
        let own = face.map(|v| angles[v as usize]);
        let (least, most) =
            own.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), a| (l.min(*a), h.max(*a)));
        // A facet where angles jump by a turn, or that has a vertex without, shows none.
        if own.iter().any(|a| a.is_nan()) || most - least > PI {
            continue;
        }
        let first = ((least - low) / step - 0.5).ceil().max(0.0) as usize;
        for k in first..LAMPS {
            let level = low + (k as f64 + 0.5) * step;
            if level > most {
                break;
            }
            let crossing = |i: usize| -> Option<Point> {
                let j = (i + 1) % 3;
                let share = (level - own[i]) / (own[j] - own[i]);
                let [a, b] = [i, j].map(|c| mesh.positions[face[c] as usize]);
                ((own[i] < level) != (own[j] < level)).then(|| plus(a, times(share, minus(b, a))))
            };
            let ends: Vec<Point> = (0..3).filter_map(crossing).collect();
            mark.add_line(&ends, false);
        }
    }
    mark
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a sphere seen from above, lamps along x are seen on planes through that axis: all places of a line have the same angle there.
    #[test]
    fn lines_of_a_sphere_lie_in_planes() {
        let steps = 60;
        let at = |k: usize| 0.012 * (k as f64 - 0.5 * f64::from(steps));
        let normal = |x: f64, y: f64| [x, y, (1.0 - x * x - y * y).sqrt()];
        let n = steps as usize + 1;
        let normals: Vec<Vector> = (0..n * n).map(|k| normal(at(k / n), at(k % n))).collect();
        let mesh = Mesh {
            positions: normals.iter().map(|p| times(50.0, *p)).collect(),
            faces: (0..(n - 1) * (n - 1))
                .map(|k| (k / (n - 1) * n + k % (n - 1)) as u32)
                .flat_map(|a| [[a, a + n as u32, a + n as u32 + 1], [a, a + n as u32 + 1, a + 1]])
                .collect(),
        };
        let seen: Vec<Option<Vector>> = normals.iter().copied().map(Some).collect();
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mark = reflection_lines(&mesh, &seen, axes);
        // The mirrored line of sight of a place with normal (x, y, z) goes along (2xz, 2yz, 2z² − 1).
        let angle = |p: &Point| {
            let [_, y, z] = times(1.0 / norm(*p), *p);
            libm::atan2(2.0 * y * z, 2.0 * z * z - 1.0)
        };
        let range = normals
            .iter()
            .map(&angle)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], a| [l.min(a), h.max(a)]);
        let step = (range[1] - range[0]) / LAMPS as f64;
        let mut seen = [false; LAMPS];
        for p in mark.segments.iter().flatten() {
            let lamp = (angle(p) - range[0]) / step - 0.5;
            assert!((lamp - lamp.round()).abs() < 0.02, "{p:?}: {lamp}");
            seen[lamp.round() as usize] = true;
        }
        assert!(seen.iter().all(|s| *s));
        // A plane shows one lamp, or none.
        let flat = vec![Some([0.0, 0.0, 1.0]); n * n];
        assert!(reflection_lines(&mesh, &flat, axes).segments.is_empty());
    }
}
