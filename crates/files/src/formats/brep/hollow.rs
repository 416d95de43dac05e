//! The sense of shells around hollows.
//!
//! Their normals look into the hollow, out of the material. Programs say so in two ways: some turn a shell that looks outward, others name a
//! turned shell whose faces look inward already. The volume that the normals look out of decides.

use super::edge::reversed;
use trueness_cad::brep::{Bounds, Brep};
use trueness_cad::measure::Integrals;
use trueness_cad::trim::Trim;
use trueness_geom::progress::Progress;

/// Turns the faces of a shell around a hollow where they look outward. Faces that cannot be trimmed leave it as the file says.
pub(crate) fn look_inward(brep: &mut Brep, shell: u32, uncertainty: f64, progress: &dyn Progress) {
    let faces = brep.shells.get(shell as usize).map_or(vec![], |s| s.faces.clone());
    let mut volume = 0.0;
    for number in &faces {
        let Some(face) = brep.faces.get(*number as usize) else { return };
        match Trim::new(brep, face, uncertainty) {
            Ok(trim) if !progress.cancelled() => volume += Integrals::of(&trim, [0.0; 3]).volume,
            _ => return,
        }
    }
    if volume <= 0.0 {
        return;
    }
    for number in faces {
        let Some(face) = brep.faces.get_mut(number as usize) else { continue };
        face.reversed = !face.reversed;
        if let Bounds::Loops(loops) = &mut face.bounds {
            *loops = std::mem::take(loops).into_iter().map(reversed).collect();
        }
    }
}
