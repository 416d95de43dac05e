//! The items of a representation: solids, shells, surfaces without topology, wires.

use super::super::part21::{Entity, Record, Wrong};
use super::face::Faces;
use super::item::{Item, item};
use super::links::names_shapes;
use super::placement::operator;
use super::surface::Oriented;
use super::topology::Topology;
use crate::formats::brep::{MAX_BASES, WITHOUT_ENDS, look_inward};
use trueness_cad::brep::{Bounds, Brep, Color, Face, Solid};
use trueness_cad::model::Part;

/// The boundary of a part, item by item.
pub(super) struct Shapes<'f> {
    pub faces: Faces<'f>,
    pub wires: u64,
    /// Sets within sets.
    depth: usize,
}

impl<'f> Shapes<'f> {
    pub fn new(faces: Faces<'f>) -> Shapes<'f> {
        Shapes { faces, wires: 0, depth: 0 }
    }

    fn brep(&mut self) -> &mut Brep {
        &mut self.faces.topology.brep
    }

    /// Adds what an item has.
    pub fn add(&mut self, number: u64, color: Option<Color>) {
        let added = self.faces.topology.geometry.file.entity(number).and_then(|entity| {
            let color = self.faces.looks.color(number).or(color);
            self.add_item(&entity, color)
        });
        if let Err(wrong) = added {
            // A surface without ends is no face: programs leave such ones beside their solids.
            self.faces.tell(number, &wrong, wrong.reason != WITHOUT_ENDS);
        }
    }

    fn add_item(&mut self, entity: &Entity, color: Option<Color>) -> Result<(), Wrong> {
        let record = entity.main(&["MANIFOLD_SOLID_BREP", "SHELL_BASED_SURFACE_MODEL"]);
        match item(entity) {
            Item::Solid => self.solid(entity, color),
            Item::Replica => self.replica(entity, &record, color),
            Item::Model => {
                for shell in record.entities(1)? {
                    self.faces.shell(shell, false, color);
                }
                Ok(())
            }
            Item::Shell => {
                self.faces.shell(entity.number(), false, color);
                Ok(())
            }
            Item::Face => {
                self.faces.face(entity.number(), false, color);
                Ok(())
            }
            Item::Set if self.depth < MAX_BASES => {
                let members = record.entities(1)?;
                self.faces.topology.geometry.budget.spend(members.len(), entity)?;
                self.depth += 1;
                members.for_each(|member| self.add(member, color));
                self.depth -= 1;
                Ok(())
            }
            Item::Set => Err(record.wrong("rests on itself")),
            Item::Surface => self.surface(entity, color),
            Item::Wire => {
                self.wires += 1;
                Ok(())
            }
            Item::Mapped | Item::Placement => Ok(()),
            Item::Other if !names_shapes(self.faces.topology.geometry.file, entity) => Ok(()),
            Item::Other => Err(record.wrong("is of a kind that is not known, and names shapes")),
            Item::Unknown => Err(record.wrong(explained(record.keyword))),
        }
    }

    /// A solid: its outer shell and those around its hollows.
    fn solid(&mut self, entity: &Entity, color: Option<Color>) -> Result<(), Wrong> {
        let simple = entity.is_simple();
        let main = entity.main(&["MANIFOLD_SOLID_BREP"]);
        let outer = main.entity(usize::from(simple))?;
        let voids = match entity.record("BREP_WITH_VOIDS") {
            Some(record) => record.entities(if simple { 2 } else { 0 })?.collect(),
            None => vec![],
        };
        let name = match entity.record("REPRESENTATION_ITEM") {
            Some(item) => item.text(0),
            None => main.text(0),
        };
        let outer = self.faces.shell(outer, false, color);
        let voids: Vec<u32> = voids.into_iter().filter_map(|v| self.faces.shell(v, false, color)).collect();
        let (tolerance, progress) = (self.faces.topology.geometry.tolerance, self.faces.progress);
        for shell in &voids {
            look_inward(self.brep(), *shell, tolerance, progress);
        }
        // What is wrong with the outer shell is told already; hollows alone are no solid.
        if let Some(outer) = outer {
            self.brep().solids.push(Solid { outer, voids, name });
        }
        Ok(())
    }

    /// A solid that is another one, placed.
    fn replica(&mut self, entity: &Entity, record: &Record, color: Option<Color>) -> Result<(), Wrong> {
        let geometry = self.faces.topology.geometry;
        let (mut parent, mut at) =
            (record.entity(1)?, operator(geometry.file, geometry.units, record.entity(2)?)?);
        for _ in 0..MAX_BASES {
            let original = geometry.file.entity(parent)?;
            let Some(next) = original.record("SOLID_REPLICA") else { break };
            at = at.after(&operator(geometry.file, geometry.units, next.entity(2)?)?);
            parent = next.entity(1)?;
        }
        let original = geometry.file.entity(parent)?;
        if item(&original) != Item::Solid {
            return Err(record.wrong("is a replica of what is no solid that is read"));
        }
        let faces =
            Faces::new(Topology::new(geometry), self.faces.looks, self.faces.progress, self.faces.reached);
        let mut inner = Shapes::new(faces);
        inner.solid(&original, color)?;
        let made = &inner.faces.topology.brep;
        geometry.budget.spend(made.faces.len() + made.edges.len(), entity)?;
        self.brep().add(made, &at, 0);
        self.faces.unread.append(&mut inner.faces.unread);
        Ok(())
    }

    /// A surface with bounds of its own: a rectangle of its parameters, curves, or its ends.
    fn surface(&mut self, entity: &Entity, color: Option<Color>) -> Result<(), Wrong> {
        let geometry = self.faces.topology.geometry;
        let Oriented { surface, is_flipped } = geometry.surface(entity.number(), 0)?;
        let main = entity.main(&[]);
        let bounds = match main.keyword {
            "RECTANGULAR_TRIMMED_SURFACE" => Bounds::Rectangle(geometry.rectangle(&main, &surface)?),
            "CURVE_BOUNDED_SURFACE" if !main.truth(3)? => self.faces.topology.boundaries(&main)?,
            "CURVE_BOUNDED_SURFACE" => return Err(main.wrong("is bounded by the ends of its basis")),
            _ => Bounds::Rectangle(surface.domain()),
        };
        let finite = |sides: &[[f64; 2]; 2]| sides.as_flattened().iter().all(|x| x.is_finite());
        if matches!(&bounds, Bounds::Rectangle(sides) if !finite(sides)) {
            return Err(main.wrong(WITHOUT_ENDS));
        }
        geometry.budget.spend(1, entity)?;
        let (name, entity) = (main.text(0), entity.number());
        let face = Face { surface, reversed: is_flipped, bounds, entity, name, color, instance: 0 };
        self.brep().faces.push(face);
        Ok(())
    }

    /// The part that was made.
    pub fn part(self, name: String) -> Part {
        Part { name, brep: self.faces.topology.brep, wires: self.wires }
    }
}

/// Why a shape is not read.
fn explained(keyword: &str) -> String {
    let what = match keyword {
        k if k.contains("TESSELLATED") || k.contains("TRIANGULATED") => "triangles, not exact surfaces",
        "CSG_SOLID" | "BOOLEAN_RESULT" => "a solid made of other solids",
        "EXTRUDED_AREA_SOLID" | "REVOLVED_AREA_SOLID" => "a swept solid",
        "EXTRUDED_FACE_SOLID" | "REVOLVED_FACE_SOLID" => "a swept solid",
        _ => "a shape without faces of its own",
    };
    format!("is {what}, which is not read")
}
