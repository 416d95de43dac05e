//! Some faces as the nominal of a feature: the element that they are together, and how far they go.

use super::CadFaces;
use super::one_surface::Apart;
use std::collections::BTreeMap;
use trueness_geom::feature::Nominal;
use trueness_geom::mesh::Mesh;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{Point, Vector, cross, dot, least_axis, minus, norm, unit};

/// Why faces are no nominal of a feature.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoNominal {
    /// They are of another kind.
    #[error("{face} of the reference is a {is}, not a {wanted}")]
    Kind {
        /// Which.
        face: String,
        /// What it is.
        is: String,
        /// What is asked for.
        wanted: &'static str,
    },
    /// They are not one surface.
    #[error(
        "{first} and {second} of the reference are not one surface: they are {off:.6} mm apart, and the file takes {within:.6} mm for the same"
    )]
    Apart {
        /// The first.
        first: String,
        /// Another one.
        second: String,
        /// How far it is off the surface of the first, mm.
        off: f64,
        /// Up to where it would be the same, mm.
        within: f64,
    },
    /// They look opposite ways.
    #[error("{first} and {second} of the reference are not one surface: they look opposite ways out of the material")]
    Turned {
        /// The first.
        first: String,
        /// Another one.
        second: String,
    },
    /// Nothing of them was drawn.
    #[error("{face} of the reference has no facets")]
    NoFacets {
        /// The first.
        face: String,
    },
}

impl CadFaces {
    /// The nominal of some faces, which are one surface of this kind. `mesh` draws the faces.
    ///
    /// The boundary of a plane is that of its facets, their convex hull where several lie apart. Cylinders and cones go as far along their axes as
    /// their faces do.
    ///
    /// # Errors
    /// [`NoNominal`].
    pub fn nominal(&self, faces: &[u32], kind: Kind, mesh: &Mesh) -> Result<Nominal, NoNominal> {
        let title = |face: u32| self.faces[face as usize].title();
        let wrong_kind = |face: u32| {
            let own = &self.faces[face as usize];
            let is = own.shape.map_or_else(|| own.kind_name().to_string(), |s| s.kind().name().to_string());
            NoNominal::Kind { face: own.title(), is, wanted: kind.name() }
        };
        let [first, others @ ..] = faces else { return Err(NoNominal::NoFacets { face: String::new() }) };
        for face in faces {
            if self.faces[*face as usize].shape.is_none_or(|s| s.kind() != kind) {
                return Err(wrong_kind(*face));
            }
        }
        for other in others {
            let (own, name) = (title(*first), title(*other));
            match self.apart(*first, *other) {
                Apart::By(off) if off <= self.same_within(*first) => {}
                Apart::By(off) => {
                    let within = self.same_within(*first);
                    return Err(NoNominal::Apart { first: own, second: name, off, within });
                }
                Apart::Turned => return Err(NoNominal::Turned { first: own, second: name }),
                Apart::Kinds => return Err(wrong_kind(*other)),
            }
        }
        let facets = self.facets(faces);
        if facets.is_empty() {
            return Err(NoNominal::NoFacets { face: title(*first) });
        }
        self.extent(faces, &facets, mesh).ok_or_else(|| wrong_kind(*first))
    }

    /// `None` of what has no nominal form.
    fn extent(&self, faces: &[u32], facets: &[u32], mesh: &Mesh) -> Option<Nominal> {
        let shape = self.faces[*faces.first()? as usize].shape?;
        let range = |origin: Point, way: Vector| {
            let ends = faces.iter().filter_map(|f| self.faces[*f as usize].ends).flatten();
            ends.map(|p| dot(minus(p, origin), way))
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], t| [a.min(t), b.max(t)])
        };
        Some(match shape {
            Shape::Plane { point, normal } => {
                Nominal::Plane { point, normal, boundary: boundary(mesh, facets, normal) }
            }
            Shape::Cylinder { point, direction, radius } => {
                let [from, to] = range(point, direction);
                let point = std::array::from_fn(|k| point[k] + from * direction[k]);
                Nominal::Cylinder { point, direction, radius, length: to - from }
            }
            Shape::Cone { apex, direction, half_angle, .. } => {
                let [from, to] = range(apex, direction);
                Nominal::Cone { apex, direction, half_angle, between: [from.max(0.0), to] }
            }
            Shape::Sphere { center, radius } => Nominal::Sphere { center, radius },
            _ => return None,
        })
    }
}

/// The border of facets of a plane: of several rings the one around all others, else their convex hull.
fn boundary(mesh: &Mesh, facets: &[u32], normal: Vector) -> Vec<Point> {
    let mut rings = rings(mesh, facets);
    let area = |ring: &Vec<u32>| {
        let at = |v: u32| mesh.positions[v as usize];
        let sides = (0..ring.len()).map(|k| cross(at(ring[k]), at(ring[(k + 1) % ring.len()])));
        0.5 * sides.map(|c| dot(c, normal)).sum::<f64>()
    };
    // Holes go round the other way.
    rings.retain(|ring| area(ring) > 0.0);
    let corners: Vec<Point> = rings.iter().flatten().map(|v| mesh.positions[*v as usize]).collect();
    match rings.len() {
        1 => without_straight(corners),
        _ => hull(&corners, normal),
    }
}

/// The rings of sides that one facet alone has, along the facets. A vertex where rings touch leaves none that closes there.
fn rings(mesh: &Mesh, facets: &[u32]) -> Vec<Vec<u32>> {
    let mut count: BTreeMap<(u32, u32), i32> = BTreeMap::new();
    for f in facets.iter().map(|f| mesh.faces[*f as usize]) {
        for k in 0..3 {
            let (a, b) = (f[k], f[(k + 1) % 3]);
            *count.entry((a, b)).or_default() += 1;
            *count.entry((b, a)).or_default() -= 1;
        }
    }
    let mut next: BTreeMap<u32, u32> = count.iter().filter(|c| *c.1 > 0).map(|c| *c.0).collect();
    let mut rings = vec![];
    while let Some((start, mut at)) = next.pop_first() {
        let mut ring = vec![start];
        while at != start {
            ring.push(at);
            match next.remove(&at) {
                Some(to) => at = to,
                None => break,
            }
        }
        if at == start {
            rings.push(ring);
        }
    }
    rings
}

/// Sine of the angle up to which a border goes straight on: a polyline on a straight edge bends by rounding.
const STRAIGHT_SINE: f64 = 1e-9;

/// Corners without those between which a border goes straight on.
fn without_straight(corners: Vec<Point>) -> Vec<Point> {
    let n = corners.len();
    let bends = |k: &usize| {
        let [a, b, c] = [(k + n - 1) % n, *k, (k + 1) % n].map(|i| corners[i]);
        let ways = [minus(b, a), minus(c, b)].map(|v| unit(v).map(|u| u.0));
        let [Some(u), Some(v)] = ways else { return true };
        norm(cross(u, v)) > STRAIGHT_SINE || dot(u, v) < 0.0
    };
    let kept: Vec<Point> = (0..n).filter(bends).map(|k| corners[k]).collect();
    if kept.len() < 3 { corners } else { kept }
}

/// The convex hull of places of a plane, counter-clockwise about its normal (A. M. Andrew, Another efficient algorithm for convex hulls in two
/// dimensions, 1979).
fn hull(places: &[Point], normal: Vector) -> Vec<Point> {
    let least = least_axis(normal);
    let Some((u, _)) = unit(cross(least, normal)) else { return places.to_vec() };
    let v = cross(normal, u);
    let mut flat: Vec<([f64; 2], Point)> = places.iter().map(|p| ([dot(*p, u), dot(*p, v)], *p)).collect();
    flat.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.0[1].total_cmp(&b.0[1])));
    let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let chain = |flat: &mut dyn Iterator<Item = ([f64; 2], Point)>| {
        let mut out: Vec<([f64; 2], Point)> = vec![];
        for p in flat {
            while let [.., a, b] = out.as_slice()
                && turn(a.0, b.0, p.0) <= 0.0
            {
                out.pop();
            }
            out.push(p);
        }
        out.pop();
        out
    };
    let lower = chain(&mut flat.iter().copied());
    let upper = chain(&mut flat.iter().rev().copied());
    lower.into_iter().chain(upper).map(|p| p.1).collect()
}
