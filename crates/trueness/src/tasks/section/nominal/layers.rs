//! Which layers of a drawing are of which plane.

use crate::task::TaskError;
use std::collections::BTreeMap;
use trueness_document::section::{NominalWarning, NominalWarningKind};
use trueness_files::drawing::Drawing;

/// How a drawing is divided among planes.
#[derive(Default)]
pub struct Layers {
    /// Each plane has a layer of its own; else the drawing is of one plane as a whole.
    divided: bool,
    /// What lies on layers of no plane.
    pub passed_over: Option<NominalWarning>,
}

/// Layers that are named of those passed over.
const MAX_NAMED_LAYERS: usize = 8;

impl Layers {
    /// Of a drawing that so many planes are compared with. Of several planes, and of a drawing with several sections as `--dxf` writes them,
    /// the layers `section-1`, `section-2`, … are those of the planes in their order.
    pub fn of(drawing: &Drawing, planes: usize, shown: &str) -> Result<Layers, TaskError> {
        let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
        drawing.entities.iter().for_each(|e| *counts.entry(e.layer.as_str()).or_default() += 1);
        let sections = counts.keys().filter(|layer| is_of_a_section(layer)).count();
        if planes > 1 && sections == 0 {
            return Err(TaskError::usage(format!(
                "--nominal {shown}: a drawing is of one plane, unless its layers are named section-1, section-2, …; give one --plane"
            )));
        }
        let divided = planes > 1 || sections > 1;
        if !divided {
            return Ok(Layers::default());
        }
        if planes == 1 && !counts.contains_key(&*name(0)) {
            return Err(TaskError::usage(format!(
                "--nominal {shown}: its layers are of several planes, and none is named {}, which is that of a single plane",
                name(0)
            )));
        }
        (0..planes).for_each(|n| _ = counts.remove(&*name(n)));
        Ok(Layers { divided, passed_over: passed_over(&counts) })
    }

    /// The layer of a plane; `None` where the whole drawing is.
    pub fn own(&self, plane: usize) -> Option<String> {
        self.divided.then(|| name(plane))
    }
}

fn name(plane: usize) -> String {
    format!("section-{}", plane + 1)
}

fn is_of_a_section(layer: &str) -> bool {
    layer.strip_prefix("section-").is_some_and(|n| n.parse::<u32>().is_ok())
}

fn passed_over(counts: &BTreeMap<&str, u64>) -> Option<NominalWarning> {
    let total: u64 = counts.values().sum();
    let mut named: Vec<String> = counts.iter().map(|(layer, count)| format!("{layer} ({count})")).collect();
    if named.len() > MAX_NAMED_LAYERS {
        let more = format!("{} more", named.len() - MAX_NAMED_LAYERS);
        named.truncate(MAX_NAMED_LAYERS);
        named.push(more);
    }
    let text = format!(
        "the drawing has a layer for each plane, section-1, section-2, …; those of no plane were passed over, with their entities: {}",
        named.join(", ")
    );
    (total > 0).then_some(NominalWarning {
        kind: NominalWarningKind::LayersPassedOver,
        value: total as f64,
        text,
    })
}
