//! The shapes of a part: solids, shells, faces.

use super::super::record::Record;
use super::boundary::Bounded;
use super::geometry::Geometry;
use super::kinds::name;
use super::looks::Looks;
use super::loose::{Loose, edges_of};
use super::surface::SURFACE_KINDS;
use super::topology::Topology;
use super::{orient, sew, sheets};
use crate::formats::brep::{WITHOUT_ENDS, Wrong, look_inward};
use trueness_cad::brep::{Bounds, Brep, Color, Face, Shell, Solid};
use trueness_cad::frame::Placement;
use trueness_cad::model::{Part, Unread};
use trueness_geom::progress::Progress;

/// The shapes of a part, one after another.
pub(super) struct Shapes<'f> {
    geometry: Geometry<'f>,
    looks: &'f Looks,
    progress: &'f dyn Progress,
    brep: Brep,
    loose: Vec<Loose>,
    pub unread: Vec<Unread>,
    pub wires: u64,
}

impl<'f> Shapes<'f> {
    pub fn new(geometry: Geometry<'f>, looks: &'f Looks, progress: &'f dyn Progress) -> Shapes<'f> {
        Shapes { geometry, looks, progress, brep: Brep::default(), loose: vec![], unread: vec![], wires: 0 }
    }

    /// Remembers what could not be read.
    pub fn tell(&mut self, number: u64, wrong: &Wrong, holds_faces: bool) {
        let entity = self.geometry.file.entities.get(&number);
        // Its own fault needs no number again.
        let reason = match wrong.entity == number && wrong.line > 0 {
            true => format!("line {}: {}", wrong.line, wrong.reason),
            false => wrong.to_string(),
        };
        let keyword = entity.map_or_else(String::new, |e| name(e.kind));
        self.unread.push(Unread { entity: number, keyword, reason, holds_faces });
    }

    /// Adds what an entity has.
    pub fn add(&mut self, number: u64) {
        if self.progress.cancelled() {
            return;
        }
        if let Err(wrong) = self.add_entity(number) {
            // A surface without ends is no face: programs leave such ones beside their faces.
            self.tell(number, &wrong, wrong.reason != WITHOUT_ENDS);
        }
    }

    fn add_entity(&mut self, number: u64) -> Result<(), Wrong> {
        let record = self.geometry.file.record(number)?;
        // Its matrix places all that it is made of.
        let at = match record.entity.kind {
            186 | 514 | 510 | 144 | 143 => self.geometry.placed(&record)?,
            _ => Placement::IDENTITY,
        };
        if at == Placement::IDENTITY {
            return self.add_at_home(&record);
        }
        let mut inner = Shapes::new(self.geometry, self.looks, self.progress);
        let done = inner.add_at_home(&record);
        let first = self.brep.faces.len() as u32;
        self.brep.add(&inner.brep, &at, 0);
        self.loose.extend(inner.loose.into_iter().map(|l| Loose { face: l.face + first, ..l }));
        self.unread.append(&mut inner.unread);
        done
    }

    fn add_at_home(&mut self, record: &Record<'f>) -> Result<(), Wrong> {
        match record.entity.kind {
            186 => self.solid(record),
            514 => self.shell(record, false, None, &mut Topology::new(self.geometry)).map(|_| ()),
            510 => {
                self.face(record, false, None, &mut Topology::new(self.geometry));
                Ok(())
            }
            144 | 143 => self.loose(record),
            kind if SURFACE_KINDS.contains(&kind) => self.loose(record),
            _ => Err(record.wrong(explained(record.entity.kind))),
        }
    }

    /// A solid (186): its outer shell with its sense, and those around its hollows.
    fn solid(&mut self, record: &Record<'f>) -> Result<(), Wrong> {
        let color = self.looks.color(record.entity);
        let mut topology = Topology::new(self.geometry);
        let turned = |k: usize| Ok::<bool, Wrong>(!record.is_absent(k) && record.integer(k)? == 0);
        let outer = self.geometry.file.record(record.pointer(0)?)?;
        let outer = self.shell(&outer, turned(1)?, color, &mut topology)?;
        let mut voids = vec![];
        for k in 0..record.count(2)? {
            let shell = self.geometry.file.record(record.pointer(3 + 2 * k)?)?;
            voids.push(self.shell(&shell, turned(4 + 2 * k)?, color, &mut topology)?);
        }
        for shell in &voids {
            look_inward(&mut self.brep, *shell, self.geometry.tolerance, self.progress);
        }
        if self.has_border(outer) {
            if let Some(shell) = self.brep.shells.get_mut(outer as usize) {
                shell.closed = false;
            }
            let wrong = record.wrong("has a border: its faces are surfaces of no solid");
            self.tell(record.entity.number, &wrong, false);
            return Ok(());
        }
        self.brep.solids.push(Solid { outer, voids, name: self.looks.name(record.entity) });
        Ok(())
    }

    /// Whether an edge of a shell is used once. What faces that could not be read had there is not known: such a shell may be whole.
    fn has_border(&self, shell: u32) -> bool {
        let Some(shell) = self.brep.shells.get(shell as usize) else { return false };
        let faces = shell.faces.iter().filter_map(|f| self.brep.faces.get(*f as usize));
        let mut edges: Vec<u32> = faces.flat_map(edges_of).collect();
        edges.sort_unstable();
        let is_whole = !self.unread.iter().any(|u| u.holds_faces);
        is_whole && edges.chunk_by(|a, b| a == b).any(|uses| uses.len() == 1)
    }

    /// A shell (514): its faces, each with whether it looks along the normal of its surface.
    fn shell(
        &mut self,
        record: &Record<'f>,
        turned: bool,
        color: Option<Color>,
        topology: &mut Topology<'f>,
    ) -> Result<u32, Wrong> {
        if record.entity.kind != 514 {
            return Err(record.wrong(format!("is no shell but of the kind {}", record.entity.kind)));
        }
        let count = record.count(0)?;
        self.geometry.budget.spend(1 + count, record)?;
        let color = self.looks.color(record.entity).or(color);
        let mut faces = vec![];
        for k in 0..count {
            let face = self.geometry.file.record(record.pointer(1 + 2 * k)?)?;
            let along = record.is_absent(2 + 2 * k) || record.integer(2 + 2 * k)? != 0;
            faces.extend(self.face(&face, along == turned, color, topology));
        }
        self.brep.shells.push(Shell { faces, closed: record.entity.form != 2 });
        Ok(self.brep.shells.len() as u32 - 1)
    }

    /// A face (510); `None` where it cannot be read, which is told.
    fn face(
        &mut self,
        record: &Record<'f>,
        turned: bool,
        color: Option<Color>,
        topology: &mut Topology<'f>,
    ) -> Option<u32> {
        let made = match record.entity.kind {
            510 => topology.face(record, turned, &mut self.brep),
            kind => Err(record.wrong(format!("is no face but of the kind {kind}"))),
        };
        self.progress.advance(1);
        match made {
            Ok((patch, bounds)) => {
                let reversed = patch.is_flipped != turned;
                let color = self.looks.color(record.entity).or(color);
                Some(self.push(record, patch.surface, reversed, bounds, color))
            }
            Err(wrong) => {
                self.tell(record.entity.number, &wrong, true);
                None
            }
        }
    }

    /// A face without topology.
    fn loose(&mut self, record: &Record<'f>) -> Result<(), Wrong> {
        let Bounded { patch, bounds, outer, in_parameters } =
            self.geometry.bounded(record, &mut self.brep)?;
        let is_bounded = match &bounds {
            Bounds::Rectangle(sides) => sides.as_flattened().iter().all(|x| x.is_finite()),
            Bounds::Loops(_) => true,
        };
        if !is_bounded {
            return Err(record.wrong(WITHOUT_ENDS));
        }
        self.progress.advance(1);
        for number in in_parameters {
            let curve = self.geometry.file.record(number)?;
            self.tell(
                number,
                &curve.wrong("prefers its curve in parameters; that in space was taken"),
                false,
            );
        }
        let color = self.looks.color(record.entity);
        let face = self.push(record, patch.surface, patch.is_flipped, bounds, color);
        self.loose.push(Loose { face, outer });
        Ok(())
    }

    fn push(
        &mut self,
        record: &Record,
        surface: trueness_cad::surface::Surface,
        reversed: bool,
        bounds: Bounds,
        color: Option<Color>,
    ) -> u32 {
        let (entity, name) = (record.entity.number, self.looks.name(record.entity));
        self.brep.faces.push(Face { surface, reversed, bounds, entity, name, color, instance: 0 });
        self.brep.faces.len() as u32 - 1
    }

    /// The part that was made: faces without topology are sewn, and their loops and normals get a sense.
    pub fn part(mut self, name: String) -> (Part, sheets::Sheets, Vec<Unread>) {
        sew::sew(&mut self.brep, &self.loose, self.geometry.tolerance);
        for loose in &self.loose {
            if self.progress.cancelled() {
                break;
            }
            orient::orient(&mut self.brep, loose, self.geometry.tolerance);
        }
        let told = sheets::agree(&mut self.brep, &self.loose, self.geometry.tolerance);
        (Part { name, brep: self.brep, wires: self.wires }, told, self.unread)
    }
}

/// Why a shape is not read.
fn explained(kind: u64) -> String {
    let what = match kind {
        150 | 152 | 154 | 156 | 158 | 160 | 168 => "a solid without faces of its own",
        162 | 164 => "a swept solid",
        180 | 182 | 184 => "a solid made of other solids",
        _ => "a shape without faces of its own",
    };
    format!("is {what}, which is not read")
}
