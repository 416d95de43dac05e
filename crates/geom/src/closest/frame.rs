//! Filling the leaves: each triangle in a frame of its own (see the module `tree`), and the corners in leaf order.

use crate::closest::block::LENGTH_UP;
use crate::closest::layout::{
    AB_LENGTH, AC_FIELD, BC_FIELD, CORNER_A, FIELDS_PER_TRIANGLE, FRAME_AXES, Leaf, UNUSED_LANE_HEIGHT,
};
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::space::{Point, Vector, cross, dot, least_axis, minus, times, unit};

/// Triangles in slot order, vertices in order of first use. Ends early where `progress` says that it is cancelled.
pub fn renumber(mesh: &Mesh, face: &[u32], progress: &dyn Progress) -> (Vec<[u32; 3]>, Vec<Point>) {
    /// Faces after which it is asked whether to go on.
    const FACES_PER_QUESTION: usize = 1 << 16;
    let mut new = vec![u32::MAX; mesh.positions.len()];
    let mut used = Vec::with_capacity(mesh.positions.len());
    let mut slots = Vec::with_capacity(face.len());
    for part in face.chunks(FACES_PER_QUESTION).take_while(|_| !progress.cancelled()) {
        slots.extend(part.iter().map(|&f| {
            mesh.faces[f as usize].map(|v| {
                let n = &mut new[v as usize];
                if *n == u32::MAX {
                    *n = used.len() as u32;
                    used.push(mesh.positions[v as usize]);
                }
                *n
            })
        }));
    }
    (slots, used)
}

/// Fills one leaf with the frames of these faces, at most eight.
pub fn leaf(mesh: &Mesh, faces: &[u32], first: u32, scale: f64) -> Leaf {
    let mut out = Leaf { field: [[0.0; 8]; FIELDS_PER_TRIANGLE], origin: [0.0; 3], first, radius: 0.0 };
    let mut triangles = [[[0.0; 3]; 3]; 8];
    let (mut lo, mut hi) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for (t, &face) in triangles.iter_mut().zip(faces) {
        *t = mesh.corners(face);
        for v in t {
            for k in 0..3 {
                lo[k] = if v[k] < lo[k] { v[k] } else { lo[k] };
                hi[k] = if v[k] > hi[k] { v[k] } else { hi[k] };
            }
        }
    }
    out.origin = std::array::from_fn(|k| 0.5 * lo[k] + 0.5 * hi[k]);
    let mut radius2 = 0.0;
    for (j, t) in triangles[..faces.len()].iter().enumerate() {
        let t = t.map(|v| times(scale, minus(v, out.origin)));
        radius2 = t.iter().map(|&c| dot(c, c)).fold(radius2, |m, d| if d > m { d } else { m });
        frame(t, |field, x| out.field[field][j] = x as f32);
    }
    out.radius = radius2.sqrt() as f32 * LENGTH_UP;
    for j in faces.len()..8 {
        for axis in 0..3 {
            out.field[FRAME_AXES + 4 * axis][j] = 1.0;
        }
        out.field[CORNER_A + 2][j] = -UNUSED_LANE_HEIGHT;
    }
    out
}

/// `a` without its part along the unit vector `e`.
fn reject(a: Vector, e: Vector) -> Vector {
    minus(a, times(dot(a, e), e))
}

/// Some unit vector perpendicular to the unit vector `x`.
fn any_perpendicular(x: Vector) -> Vector {
    unit(reject(least_axis(x), x)).map_or([0.0, 1.0, 0.0], |(y, _)| y)
}

/// The direction of the part of `ac` perpendicular to the unit vector `x`, `base` being about as long as `ac`.
///
/// The rest of a needle is mostly rounding and not yet perpendicular: it is taken again. If little is left once more, the
/// rounding pointed along `x`; then the three corners lie on a line, and any perpendicular will do.
fn perpendicular(ac: Vector, base: f64, x: Vector) -> Vector {
    /// Height over the base below which rounding decides the direction of the height.
    const MIN_CLEAR_HEIGHT: f64 = 1e-3;
    match unit(reject(ac, x)) {
        Some((y, h)) if h > MIN_CLEAR_HEIGHT * base => y,
        Some((y, _)) => match unit(reject(y, x)) {
            Some((y, h)) if h > MIN_CLEAR_HEIGHT => y,
            _ => any_perpendicular(x),
        },
        None => any_perpendicular(x),
    }
}

/// The frame of one triangle, field by field.
fn frame(v: [Point; 3], mut put: impl FnMut(usize, f64)) {
    let length2 = |i: usize| {
        let e = minus(v[(i + 1) % 3], v[i]);
        dot(e, e)
    };
    let i = (0..3).max_by(|&i, &j| length2(i).total_cmp(&length2(j))).unwrap_or(0);
    let (a, b, c) = (v[i], v[(i + 1) % 3], v[(i + 2) % 3]);
    let (ab, ac) = (minus(b, a), minus(c, a));
    let (x, base) = unit(ab).unwrap_or(([1.0, 0.0, 0.0], 0.0));
    let y = perpendicular(ac, base, x);
    let z = cross(x, y);
    let (cx, cy) = (dot(ac, x), dot(ac, y));
    for (axis, e) in [x, y, z].into_iter().enumerate() {
        for (k, x) in e.into_iter().enumerate() {
            put(FRAME_AXES + 3 * axis + k, x);
        }
        put(CORNER_A + axis, dot(a, e));
    }
    put(AB_LENGTH, base);
    for (at, px) in [(AC_FIELD, cx), (BC_FIELD, cx - base)] {
        let l = (px * px + cy * cy).sqrt();
        let r = 1.0 / l;
        let (ux, uy) = if l > 0.0 { (px * r, cy * r) } else { (1.0, 0.0) };
        put(at, ux);
        put(at + 1, uy);
        put(at + 2, l);
    }
}
