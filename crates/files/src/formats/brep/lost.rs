//! Models in which nothing is left.

use crate::error::{Fault, Result};
use trueness_cad::model::{Model, Unread};

/// A file without a face and without a wire is no model.
pub(crate) fn holds_anything(model: &Model) -> Result<()> {
    let faces: usize = model.parts.iter().map(|p| p.brep.faces.len()).sum();
    if faces > 0 || model.parts.iter().any(|p| p.wires > 0) && !model.unread.iter().any(|u| u.holds_faces) {
        return Ok(());
    }
    let lost: Vec<&Unread> = model.unread.iter().filter(|u| u.holds_faces).collect();
    let what = match lost.first() {
        None => "the file holds no shape: neither faces nor curves".to_string(),
        Some(first) => {
            let name = if first.keyword.is_empty() { "" } else { &first.keyword };
            let others = lost.len() - 1;
            let more = if others > 0 { format!(" (and {others} more)") } else { String::new() };
            format!("none of its faces can be read: {name} #{}: {}{more}", first.entity, first.reason)
        }
    };
    Err(Fault::Unsupported {
        what,
        remedy: "export it as a model with exact faces (boundary representation)",
    }
    .into())
}
