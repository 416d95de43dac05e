//! Faces and shells.

use super::super::part21::{Entity, Record, Wrong};
use super::looks::Looks;
use super::placement::plane_of;
use super::surface::Oriented;
use super::topology::{MAX_ORIENTED, Topology};
use crate::formats::brep::reversed;
use crate::formats::brep::span::MAX_GAP;
use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};
use trueness_cad::brep::{Bounds, Color, Face, Loop, Shell};
use trueness_cad::model::Unread;
use trueness_cad::surface::Surface;
use trueness_geom::progress::Progress;
use trueness_geom::space::Aabb;

/// All sides without an end: the whole surface.
const WHOLE: [[f64; 2]; 2] = [[f64::NEG_INFINITY, f64::INFINITY]; 2];

/// What is made of the faces of a part, and what is wrong with some.
pub(super) struct Faces<'f> {
    pub topology: Topology<'f>,
    pub looks: &'f Looks,
    pub progress: &'f dyn Progress,
    pub unread: Vec<Unread>,
    /// The entities of all faces that were come to, whether they could be read or not.
    pub reached: &'f RefCell<BTreeSet<u64>>,
    /// By the number of the entity and whether it is turned.
    faces: HashMap<(u64, bool), Option<u32>>,
    shells: HashMap<(u64, bool), Option<u32>>,
}

impl<'f> Faces<'f> {
    pub fn new(
        topology: Topology<'f>,
        looks: &'f Looks,
        progress: &'f dyn Progress,
        reached: &'f RefCell<BTreeSet<u64>>,
    ) -> Faces<'f> {
        let (faces, shells) = (HashMap::new(), HashMap::new());
        Faces { topology, looks, progress, unread: vec![], reached, faces, shells }
    }

    /// Forgets which entity became what: another representation has other units.
    pub fn forget(&mut self) {
        self.topology.forget();
        self.faces.clear();
        self.shells.clear();
    }

    /// Remembers what could not be read.
    pub fn tell(&mut self, number: u64, wrong: &Wrong, holds_faces: bool) {
        let file = self.topology.geometry.file;
        let entity = file.entity(number);
        let keyword = entity.as_ref().map_or("", |e| e.main(&[]).keyword).to_string();
        // Its own fault needs no number again.
        let reason = match wrong.entity == number && entity.is_ok() {
            true => format!("line {}: {}", wrong.line, wrong.reason),
            false => wrong.to_string(),
        };
        self.unread.push(Unread { entity: number, keyword, reason, holds_faces });
    }

    /// A shell; turned where its faces are to look the other way. `color` is for faces without their own.
    pub fn shell(&mut self, number: u64, turned: bool, color: Option<Color>) -> Option<u32> {
        if let Some(known) = self.shells.get(&(number, turned)) {
            return *known;
        }
        let made = match self.make_shell(number, turned, color) {
            Ok(shell) => Some(shell),
            Err(wrong) => {
                self.tell(number, &wrong, true);
                None
            }
        };
        self.shells.insert((number, turned), made);
        made
    }

    fn make_shell(&mut self, number: u64, turned: bool, color: Option<Color>) -> Result<u32, Wrong> {
        let (mut number, mut turned) = (number, turned);
        let file = self.topology.geometry.file;
        for _ in 0..MAX_ORIENTED {
            let entity = file.entity(number)?;
            let record = entity.main(&["CLOSED_SHELL", "OPEN_SHELL", "CONNECTED_FACE_SET"]);
            match record.keyword {
                "ORIENTED_CLOSED_SHELL" | "ORIENTED_OPEN_SHELL" => {
                    turned ^= !record.truth(3)?;
                    number = record.entity(2)?;
                }
                "CLOSED_SHELL" | "OPEN_SHELL" | "CONNECTED_FACE_SET" => {
                    let index = record.values.len().saturating_sub(1);
                    let index = if entity.is_simple() { 1 } else { index };
                    let numbers = record.entities(index)?;
                    self.topology.geometry.budget.spend(numbers.len(), &entity)?;
                    let color = self.looks.color(number).or(color);
                    let faces = numbers.filter_map(|n| self.face(n, turned, color)).collect();
                    self.topology.brep.shells.push(Shell { faces, closed: record.keyword == "CLOSED_SHELL" });
                    return Ok(self.topology.brep.shells.len() as u32 - 1);
                }
                keyword => return Err(record.wrong(format!("is no shell but {keyword}"))),
            }
        }
        Err(file.entity(number)?.wrong("rests on itself"))
    }

    /// A face, each made once.
    pub fn face(&mut self, number: u64, turned: bool, color: Option<Color>) -> Option<u32> {
        if let Some(known) = self.faces.get(&(number, turned)) {
            return *known;
        }
        if self.progress.cancelled() {
            return None;
        }
        let made = match self.make_face(number, turned, color) {
            Ok(face) => {
                self.topology.brep.faces.push(face);
                Some(self.topology.brep.faces.len() as u32 - 1)
            }
            Err(wrong) => {
                self.tell(number, &wrong, true);
                None
            }
        };
        self.progress.advance(1);
        self.faces.insert((number, turned), made);
        made
    }

    fn make_face(&mut self, number: u64, turned: bool, color: Option<Color>) -> Result<Face, Wrong> {
        let (own, mut number, mut turned) = (number, number, turned);
        let file = self.topology.geometry.file;
        for _ in 0..MAX_ORIENTED {
            self.reached.borrow_mut().insert(number);
            let entity = file.entity(number)?;
            let record = entity.main(&["ADVANCED_FACE", "FACE_SURFACE", "FACE"]);
            match record.keyword {
                "ORIENTED_FACE" => {
                    turned ^= !record.truth(3)?;
                    number = record.entity(2)?;
                }
                "ADVANCED_FACE" | "FACE_SURFACE" | "FACE" => {
                    let color = self.looks.color(own).or_else(|| self.looks.color(number)).or(color);
                    return Ok(Face { color, ..self.of_record(&entity, &record, turned)? });
                }
                keyword => return Err(record.wrong(format!("is no face that is read but {keyword}"))),
            }
        }
        Err(file.entity(number)?.wrong("rests on itself"))
    }

    fn of_record(&mut self, entity: &Entity, record: &Record, turned: bool) -> Result<Face, Wrong> {
        let bounds = record.entities(1)?;
        self.topology.geometry.budget.spend(1 + bounds.len(), entity)?;
        let (mut loops, mut polygons) = (vec![], 0);
        for number in bounds {
            let bound = self.topology.geometry.file.entity(number)?;
            let bound = bound.main(&["FACE_BOUND", "FACE_OUTER_BOUND"]);
            if !matches!(bound.keyword, "FACE_BOUND" | "FACE_OUTER_BOUND") {
                return Err(bound.wrong(format!("is no FACE_BOUND but {}", bound.keyword)));
            }
            let ring = bound.entity(1)?;
            let file = self.topology.geometry.file;
            polygons += usize::from(file.entity(ring)?.record("POLY_LOOP").is_some());
            let around = self.topology.read_loop(ring)?;
            loops.push(if bound.truth(2)? != turned { around } else { reversed(around) });
        }
        let (surface, same) = match polygons > 0 && polygons == loops.len() {
            true => (self.plane(record, &loops)?.into(), true),
            false => (self.topology.geometry.surface(record.entity(2)?, 0)?, record.truth(3)? != turned),
        };
        let Oriented { surface, is_flipped } = surface;
        let bounds = match loops.is_empty() {
            false => Bounds::Loops(loops),
            true if surface.domain().as_flattened().iter().all(|x| x.is_finite()) => Bounds::Rectangle(WHOLE),
            true => return Err(record.wrong("has no bounds, and its surface has no end")),
        };
        let (entity, name) = (entity.number(), record.text(0));
        Ok(Face { surface, reversed: same == is_flipped, bounds, entity, name, color: None, instance: 0 })
    }

    /// The plane of a face whose loops are polygons: that of the largest. What the file says of it may belong to another face.
    fn plane(&self, record: &Record, loops: &[Loop]) -> Result<Surface, Wrong> {
        let corners = loops.iter().map(|l| self.topology.corners(l));
        let size = |points: &Vec<_>| Aabb::of(points.iter()).diagonal();
        let largest = corners.max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or_default();
        let plane = plane_of(&largest).ok_or_else(|| record.wrong("has all its corners on one line"))?;
        let off = loops.iter().flat_map(|l| self.topology.corners(l)).map(|p| plane.local(p)[2].abs());
        let off = off.fold(0.0, f64::max);
        match off <= self.topology.geometry.tolerance.max(MAX_GAP * size(&largest)) {
            true => Ok(Surface::Plane(plane)),
            false => Err(record.wrong(format!("has corners that lie {off:.3e} mm off their plane"))),
        }
    }
}
