//! What a CAD file holds: parts, where their instances stand, and what could not be read.

use crate::brep::{Brep, Color};
use crate::frame::Placement;
use crate::tolerances::Tolerances;

/// A part: its boundary in its own coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// The name of its product; may be empty.
    pub name: String,
    /// Its faces, edges, vertices, millimeters.
    pub brep: Brep,
    /// Number of curves and points that bound no face.
    pub wires: u64,
}

/// A part where it stands in the assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// The part.
    pub part: u32,
    /// Names from the root of the assembly down to it.
    pub path: Vec<String>,
    /// Where it stands.
    pub placement: Placement,
    /// The color that the file gives to all faces of this instance.
    pub color: Option<Color>,
}

impl Instance {
    /// A part that stands somewhere, without names.
    pub fn of(part: u32, placement: Placement) -> Instance {
        Instance { part, path: vec![], placement, color: None }
    }
}

/// A face, or another entity, that could not be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Unread {
    /// The number of its entity.
    pub entity: u64,
    /// Its keyword, for instance `ADVANCED_FACE`.
    pub keyword: String,
    /// Why.
    pub reason: String,
    /// Whether it is a face, or holds faces: a verdict over the model is then incomplete.
    pub holds_faces: bool,
}

/// A CAD model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Each part once.
    pub parts: Vec<Part>,
    /// Each part as often as it stands in the assembly, in the order of the file.
    pub instances: Vec<Instance>,
    /// Levels of the assembly: 0 where parts stand alone.
    pub depth: u32,
    /// The uncertainty that the file states for its lengths, millimeters.
    pub uncertainty: Option<f64>,
    /// Numbers of the entities that the file says are not shown: faces, shells, solids, instances. They are read all the same.
    pub hidden: Vec<u64>,
    /// Names of its layers.
    pub layers: Vec<String>,
    /// What its designer allows.
    pub tolerances: Tolerances,
    /// What could not be read.
    pub unread: Vec<Unread>,
}

impl Model {
    /// All instances where they stand, as one boundary.
    pub fn assembled(&self) -> Brep {
        let mut all = Brep::default();
        for (number, instance) in self.instances.iter().enumerate() {
            if let Some(part) = self.parts.get(instance.part as usize) {
                all.add(&part.brep, &instance.placement, number as u32);
            }
        }
        all
    }

    /// Up to where places may have been meant as one, millimeters: the stated uncertainty, but no more than a hundredth. Some files
    /// state a millimeter, at which faces of a thin part would be one.
    pub fn same_within(&self) -> Option<f64> {
        const MOST_UNCERTAIN: f64 = 1e-2;
        self.uncertainty.map(|u| u.min(MOST_UNCERTAIN))
    }

    /// Whether all faces of the file were read.
    pub fn is_complete(&self) -> bool {
        !self.unread.iter().any(|u| u.holds_faces)
    }
}
