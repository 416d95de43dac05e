//! What is known of a face.

use super::element::{self, Sense};
use trueness_cad::brep::Face;
use trueness_cad::surface::{Surface, SurfaceKind};
use trueness_cad::trim::{Trim, TrimError};
use trueness_geom::shape::Shape;
use trueness_geom::space::Point;

/// What is known of a face.
#[derive(Clone, Debug)]
pub struct CadFace {
    /// The number of its entity in the file.
    pub entity: u64,
    /// Its name; may be empty.
    pub name: String,
    /// The instance that it is of.
    pub instance: u32,
    /// What its surface is.
    pub kind: SurfaceKind,
    /// Its surface.
    pub surface: Surface,
    /// Whether its outward normal is opposite to `∂u × ∂v`.
    pub is_reversed: bool,
    /// The element that its surface is; `None` for free forms. The normal of a plane points out of the material.
    pub shape: Option<Shape>,
    /// Of a cylinder, cone, sphere or torus, whether its outward normal looks towards the axis or center.
    pub inward: Option<bool>,
    /// Why it has no inside, where it has none.
    pub missing: Option<String>,
    /// Of a cylinder or cone, the places on the axis where the face begins and ends.
    pub(super) ends: Option<[Point; 2]>,
    /// Places all over the surface, where it is an element.
    pub(super) places: Vec<Point>,
}

/// Places along each parameter at which a surface is held against another.
const COMPARED_PLACES: usize = 5;

impl CadFace {
    pub(super) fn new(face: &Face, trim: Result<&Trim, &TrimError>) -> CadFace {
        let window = trim.ok().map(|trim| trim.window);
        let found = window.and_then(|window| element::of(&face.surface, face.reversed, window));
        let places = |window| places(&face.surface, window);
        CadFace {
            entity: face.entity,
            name: face.name.trim().to_string(),
            instance: face.instance,
            kind: face.surface.kind(),
            surface: face.surface.clone(),
            is_reversed: face.reversed,
            shape: found.map(|f| f.shape),
            inward: found.and_then(|f| match f.sense {
                Sense::Flat => None,
                Sense::Inward => Some(true),
                Sense::Outward => Some(false),
            }),
            missing: trim.err().map(ToString::to_string),
            ends: found.and_then(|f| f.ends),
            places: window.filter(|_| found.is_some()).map(places).unwrap_or_default(),
        }
    }

    /// What it is called in messages.
    pub fn title(&self) -> String {
        match self.name.as_str() {
            "" => format!("face {}", self.entity),
            name => format!("face {} \"{name}\"", self.entity),
        }
    }

    /// What its surface is, in words.
    pub fn kind_name(&self) -> &'static str {
        match self.kind {
            SurfaceKind::Plane => "plane",
            SurfaceKind::Cylinder => "cylinder",
            SurfaceKind::Cone => "cone",
            SurfaceKind::Sphere => "sphere",
            SurfaceKind::Torus => "torus",
            SurfaceKind::Spline => "B-spline surface",
            SurfaceKind::Extrusion => "extruded curve",
            SurfaceKind::Revolution => "turned curve",
            SurfaceKind::Offset => "offset of another surface",
        }
    }
}

fn places(surface: &Surface, window: [[f64; 2]; 2]) -> Vec<Point> {
    let at = |k: usize, i: usize| {
        let [from, to] = window[k];
        from + (to - from) * i as f64 / (COMPARED_PLACES - 1) as f64
    };
    let all = (0..COMPARED_PLACES).flat_map(|i| (0..COMPARED_PLACES).map(move |j| (i, j)));
    all.map(|(i, j)| surface.at(at(0, i), at(1, j))).collect()
}
