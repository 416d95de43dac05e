//! Faces without topology that share edges: their normals are made to agree.
//!
//! Such files do not say where material is. Neighbors look to one side of their sheet; that of most of them. Where a sheet closes, they look out of it.

use super::loose::Loose;
use crate::formats::brep::reversed;
use trueness_cad::brep::{Bounds, Brep, Loop, Shell};
use trueness_cad::measure::Integrals;
use trueness_cad::trim::Trim;

/// What was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sheets {
    /// Faces in no solid.
    pub faces: u64,
    /// Sheets that have no border.
    pub closed: u64,
    /// Faces that were turned.
    pub turned: u64,
}

/// A use of an edge: the place of its face in the list, and whether it runs backwards.
type Use = (usize, bool);

/// Turns faces so that neighbors agree, and makes a shell of each sheet of several faces.
pub(super) fn agree(brep: &mut Brep, loose: &[Loose], tolerance: f64) -> Sheets {
    let faces: Vec<u32> = loose.iter().map(|l| l.face).collect();
    let mut uses: Vec<Vec<Use>> = vec![vec![]; brep.edges.len()];
    let mut own: Vec<Vec<u32>> = vec![vec![]; faces.len()];
    for (k, face) in faces.iter().enumerate() {
        let Some(face) = brep.faces.get(*face as usize) else { continue };
        let Bounds::Loops(loops) = &face.bounds else { continue };
        for used in
            loops.iter().filter_map(|l| if let Loop::Edges(all) = l { Some(all) } else { None }).flatten()
        {
            own[k].push(used.edge);
            if let Some(all) = uses.get_mut(used.edge as usize) {
                all.push((k, used.reversed));
            }
        }
    }
    let mut found = Sheets { faces: faces.len() as u64, ..Sheets::default() };
    let mut is_turned: Vec<Option<bool>> = vec![None; faces.len()];
    for first in 0..faces.len() {
        if is_turned[first].is_some() {
            continue;
        }
        let Sheet { members, agrees, closed } = sheet(first, &own, &uses, &mut is_turned);
        if members.len() < 2 && !closed {
            continue;
        }
        found.closed += u64::from(closed);
        if agrees {
            let share = members.iter().filter(|k| is_turned[**k] == Some(true)).count();
            let mut turn_all = 2 * share > members.len();
            if closed {
                let volume = volume(brep, &faces, &members, &is_turned, tolerance);
                turn_all = volume.map_or(turn_all, |v| v < 0.0);
            }
            for k in &members {
                if is_turned[*k].is_some_and(|turned| turned != turn_all) {
                    turn(brep, faces[*k]);
                    found.turned += 1;
                }
            }
        }
        let faces = members.iter().map(|k| faces[*k]).collect();
        brep.shells.push(Shell { faces, closed: false });
    }
    found
}

/// Faces that edges join.
struct Sheet {
    members: Vec<usize>,
    /// Whether all can look to one side.
    agrees: bool,
    /// Whether it has no border.
    closed: bool,
}

/// The sheet of a face. Each member is marked with whether it must be turned to agree with the first one.
fn sheet(first: usize, own: &[Vec<u32>], uses: &[Vec<Use>], is_turned: &mut [Option<bool>]) -> Sheet {
    is_turned[first] = Some(false);
    let mut found = Sheet { members: vec![first], agrees: true, closed: !own[first].is_empty() };
    let mut next = 0;
    while let Some(k) = found.members.get(next).copied() {
        next += 1;
        for edge in &own[k] {
            let [a, b] = uses[*edge as usize][..] else {
                found.closed = false;
                continue;
            };
            let (near, far) = if a.0 == k { (a, b) } else { (b, a) };
            // Neighbors that agree use their edge both ways.
            let turned = is_turned[k].unwrap_or(false) != (near.1 == far.1);
            match is_turned[far.0] {
                None => {
                    is_turned[far.0] = Some(turned);
                    found.members.push(far.0);
                }
                Some(known) => found.agrees &= far.0 == k || known == turned,
            }
        }
    }
    found
}

/// The volume that the faces look out of, as they are to be turned; `None` where one of them has no trim.
fn volume(
    brep: &Brep,
    faces: &[u32],
    members: &[usize],
    is_turned: &[Option<bool>],
    tolerance: f64,
) -> Option<f64> {
    let mut sum = 0.0;
    for k in members {
        let face = brep.faces.get(faces[*k] as usize)?;
        let trim = Trim::new(brep, face, tolerance).ok()?;
        let own = Integrals::of(&trim, [0.0; 3]).volume;
        sum += if is_turned[*k] == Some(true) { -own } else { own };
    }
    Some(sum)
}

/// Lets a face look the other way.
fn turn(brep: &mut Brep, face: u32) {
    let Some(face) = brep.faces.get_mut(face as usize) else { return };
    face.reversed = !face.reversed;
    if let Bounds::Loops(loops) = &mut face.bounds {
        *loops = std::mem::take(loops).into_iter().map(reversed).collect();
    }
}

impl Sheets {
    /// Those of another part as well.
    pub fn add(&mut self, other: &Sheets) {
        self.faces += other.faces;
        self.closed += other.closed;
        self.turned += other.turned;
    }
}
