//! Faces of a closed shell whose normals contradict each other.
//!
//! Neighbors that look to one side run along their common edge in opposite directions. Where they do not, or where the loops of a face
//! contradict its normal, the file says both of a face; a shell that can look to one side looks out of what it encloses.

use crate::brep::{Bounds, Brep, Loop};
use crate::measure::Integrals;
use crate::trim::{Trim, TrimError};

/// A use of an edge: the place of its face in the shell, and whether its border runs backwards.
type Use = (usize, bool);

/// Turns the faces of closed shells that contradict each other so that they agree; the faces that now look the other way, ascending. The
/// loops of all faces run along with their normals then.
pub(crate) fn agree(brep: &mut Brep, trims: &mut [Result<Trim, TrimError>]) -> Vec<u32> {
    let mut was_turned = vec![false; brep.faces.len()];
    for (face, trim) in trims.iter().enumerate() {
        if trim.as_ref().is_ok_and(|t| t.turned) {
            was_turned[face] = true;
            reverse_loops(brep, face);
        }
    }
    let voids: Vec<u32> = brep.solids.iter().flat_map(|s| s.voids.iter().copied()).collect();
    let mut turned = vec![];
    for (number, shell) in brep.shells.iter().enumerate().filter(|(_, s)| s.closed) {
        let sense = if voids.contains(&(number as u32)) { -1.0 } else { 1.0 };
        turned.extend(contradicting(brep, trims, &shell.faces, &was_turned, sense));
    }
    turned.sort_unstable();
    turned.dedup();
    for face in &turned {
        let face = *face as usize;
        reverse_loops(brep, face);
        brep.faces[face].reversed ^= true;
        if let Ok(trim) = &mut trims[face] {
            trim.reversed ^= true;
        }
    }
    turned
}

fn reverse_loops(brep: &mut Brep, face: usize) {
    let Bounds::Loops(loops) = &mut brep.faces[face].bounds else { return };
    for around in loops {
        if let Loop::Edges(uses) = around {
            uses.reverse();
            uses.iter_mut().for_each(|u| u.reversed ^= true);
        }
    }
}

/// The faces of a shell that are to be turned; none where it has a border, or no side that all can look to.
fn contradicting(
    brep: &Brep,
    trims: &[Result<Trim, TrimError>],
    faces: &[u32],
    was_turned: &[bool],
    sense: f64,
) -> Vec<u32> {
    let mut uses: Vec<(u32, Use)> = vec![];
    for (k, face) in faces.iter().enumerate() {
        let Some(Bounds::Loops(loops)) = brep.faces.get(*face as usize).map(|f| &f.bounds) else { continue };
        let edges = loops.iter().filter_map(|l| if let Loop::Edges(uses) = l { Some(uses) } else { None });
        uses.extend(edges.flatten().map(|u| (u.edge, (k, u.reversed))));
    }
    uses.sort_unstable();
    // Pairs of neighbors, and whether one of them is to be turned.
    let mut neighbors: Vec<Vec<(usize, bool)>> = vec![vec![]; faces.len()];
    let mut is_open = vec![false; faces.len()];
    for same in uses.chunk_by(|a, b| a.0 == b.0) {
        match same {
            [(_, a)] => is_open[a.0] = true,
            [(_, a), (_, b)] if a.0 != b.0 => {
                neighbors[a.0].push((b.0, a.1 == b.1));
                neighbors[b.0].push((a.0, a.1 == b.1));
            }
            _ => {}
        }
    }
    let mut flags: Vec<Option<bool>> = vec![None; faces.len()];
    let mut all = vec![];
    for first in 0..faces.len() {
        if flags[first].is_some() {
            continue;
        }
        let Some(members) = sheet(first, &neighbors, &mut flags) else { continue };
        let of = |k: &usize| faces[*k] as usize;
        let contradicts = members.iter().any(|k| flags[*k] == Some(true) || was_turned[of(k)]);
        if !contradicts || members.iter().any(|k| is_open[*k]) {
            continue;
        }
        let Some(volume) = volume(trims, members.iter().map(|k| (of(k), flags[*k] == Some(true)))) else {
            continue;
        };
        let turn_all = sense * volume < 0.0;
        all.extend(members.iter().filter(|k| (flags[**k] == Some(true)) != turn_all).map(|k| faces[*k]));
    }
    all
}

/// The faces that edges join to a first one, marked with whether each must be turned to agree with it; `None` where they cannot agree.
fn sheet(first: usize, neighbors: &[Vec<(usize, bool)>], flags: &mut [Option<bool>]) -> Option<Vec<usize>> {
    flags[first] = Some(false);
    let (mut members, mut agrees, mut next) = (vec![first], true, 0);
    while let Some(k) = members.get(next).copied() {
        next += 1;
        for (far, differs) in &neighbors[k] {
            let turned = (flags[k] == Some(true)) != *differs;
            match flags[*far] {
                None => {
                    flags[*far] = Some(turned);
                    members.push(*far);
                }
                Some(known) => agrees &= known == turned,
            }
        }
    }
    agrees.then_some(members)
}

/// The volume that faces look out of, some of them turned; `None` where one has no trim.
fn volume(trims: &[Result<Trim, TrimError>], faces: impl Iterator<Item = (usize, bool)>) -> Option<f64> {
    let mut sum = 0.0;
    for (face, turned) in faces {
        let own = Integrals::of(trims.get(face)?.as_ref().ok()?, [0.0; 3]).volume;
        sum += if turned { -own } else { own };
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::super::brep::{Bounds, Loop, Shell, Solid};
    use super::super::trim::tests::{drum, frame};
    use super::super::trimmed::Trimmed;
    use std::f64::consts::PI;
    use trueness_geom::progress::Silent;

    /// Each face of a drum as it should be, turned as a whole, with its loops turned, or with its normal turned: it is the same drum, unless
    /// all faces look inward and agree.
    #[test]
    fn what_contradicts_itself_looks_outward() {
        for damage in 0..64u32 {
            let of_face = [damage & 3, damage >> 2 & 3, damage >> 4];
            let mut brep = drum(&frame(3), 2.0, 5.0, 0.4).brep;
            brep.shells.push(Shell { faces: vec![0, 1, 2], closed: true });
            brep.solids.push(Solid { outer: 0, voids: vec![], name: String::new() });
            for (face, damage) in brep.faces.iter_mut().zip(of_face) {
                face.reversed ^= damage & 1 == 1;
                let Bounds::Loops(loops) = &mut face.bounds else { continue };
                for around in loops {
                    if let (Loop::Edges(uses), 2..) = (around, damage) {
                        uses.iter_mut().for_each(|u| u.reversed ^= true);
                    }
                }
            }
            let (shape, turned) = Trimmed::new(brep, 0.0, &Silent).unwrap().agreed();
            let integrals = shape.integrals(&Silent).unwrap();
            let volume = shape.volume(&shape.brep.solids[0], &integrals).unwrap();
            let sense = if of_face == [3; 3] { -1.0 } else { 1.0 };
            assert!((volume - sense * 20.0 * PI).abs() < 1e-9, "{of_face:?} {volume} {turned:?}");
        }
    }
}
