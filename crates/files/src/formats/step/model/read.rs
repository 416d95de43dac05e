//! The whole of a file.

use super::super::part21::{File, parse};
use super::assembly::Assembly;
use super::links::{places_shapes, unreached};
use super::looks::Looks;
use super::part::Reading;
use super::placement::Units;
use super::representation::{Representation, aspects, representations};
use crate::content::cad_file::{CadContent, LengthUnit};
use crate::error::{Fault, Located, Result};
use crate::format::ReadOptions;
use crate::formats::brep::tree::{Node, instances};
use crate::formats::brep::{Budget, MAX_TOLD};
use crate::source::Source;
use crate::{UnitFrom, Warning};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use trueness_cad::frame::Placement;
use trueness_cad::model::{Instance, Model, Unread};
use trueness_geom::progress::Progress;

/// Uncertainties that files state are taken between these, millimeters: what lies nearer together is one place.
const UNCERTAINTIES: [f64; 2] = [1e-6, 1e-2];
/// The uncertainty of a file that states none, millimeters: what most programs state.
const USUAL_UNCERTAINTY: f64 = 1e-3;

/// Reads the model of a file; whether it holds any shape is another question: [`holds_anything`].
pub(crate) fn read(
    source: &mut Source,
    options: &ReadOptions,
    progress: &dyn Progress,
) -> Result<CadContent> {
    let stopped = |_| Located::from(Fault::Cancelled);
    let file = parse(source.feed.all()?, progress).map_err(stopped)?;
    let looks = Looks::of(&file);
    let aspects = aspects(&file);
    let shapes = representations(&file, &aspects);
    let unit = unit(&shapes, options);
    let angle = shapes.values().find_map(|r| r.context.as_ref().ok()?.angle).unwrap_or(1.0);
    let uncertainty = shapes.values().filter_map(|r| r.context.as_ref().ok()?.uncertainty).reduce(f64::max);
    let fallback = Units { length: unit.millimeters, angle };
    let warnings = warnings(&shapes, &unit, options);
    let budget = Budget::of(file.count());
    let tolerance = uncertainty.unwrap_or(USUAL_UNCERTAINTY).clamp(UNCERTAINTIES[0], UNCERTAINTIES[1]);
    let (shown, reached) = (Default::default(), RefCell::default());
    let reading = Reading {
        file: &file,
        budget: &budget,
        looks: &looks,
        progress,
        tolerance,
        shown,
        reached: &reached,
    };
    let mut model = Model { uncertainty, ..Model::default() };
    let mut assembly = Assembly::of(&file, shapes, fallback);
    let mut parts = vec![None; assembly.nodes.len()];
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by_key(|node| !assembly.nodes[*node].is_product);
    for node in order {
        let (part, mut unread) = reading.part(&assembly, node);
        model.unread.append(&mut unread);
        // Views of products hold curves and planes beside the faces of the product.
        let is_view = !assembly.nodes[node].is_product && !model.parts.is_empty();
        if let Some(part) = part.filter(|p| !is_view || !p.brep.faces.is_empty()) {
            parts[node] = Some((model.parts.len() as u32, part.brep.faces.len() as u64));
            model.parts.push(part);
        }
        if progress.cancelled() {
            return Err(Fault::Cancelled.into());
        }
    }
    let mut tree: Vec<Node> = assembly.nodes.iter_mut().map(|node| std::mem::take(&mut node.tree)).collect();
    assembly.unread.extend(homeless(&assembly, &tree, &file, |node| {
        let part = parts[node].and_then(|(part, _)| model.parts.get(part as usize));
        part.is_some_and(|part| !part.brep.faces.is_empty())
    }));
    let made = instances(&mut tree, &parts, |entity| looks.color(entity))?;
    (model.instances, model.depth) = (made.instances, made.levels);
    assembly.unread.extend(made.cut.into_iter().map(cut));
    if model.parts.is_empty() && model.unread.is_empty() {
        let (part, mut unread) = reading.loose(fallback);
        model.unread.append(&mut unread);
        model.instances.extend(part.as_ref().map(|_| Instance::of(0, Placement::IDENTITY)));
        if part.is_some() && places_shapes(&file) {
            model.unread.push(unplaced());
        }
        model.parts.extend(part);
    }
    model.unread.append(&mut assembly.unread);
    model.unread.extend(damaged(&file));
    model.unread.extend(unreached(&file, &reached.take(), &aspects));
    model.tolerances = super::super::tolerances::read(&file, &budget);
    model.hidden = looks.hidden.iter().copied().collect();
    model.layers = looks.layers.iter().cloned().collect();
    Ok(CadContent { model, unit, warnings, splines: None })
}

/// What places a part in itself.
fn cut((entity, name): (u64, String)) -> Unread {
    let what = if name.is_empty() { "an assembly".into() } else { format!("\"{name}\"") };
    Unread {
        entity,
        keyword: "NEXT_ASSEMBLY_USAGE_OCCURRENCE".into(),
        reason: format!("places {what} in itself"),
        holds_faces: true,
    }
}

/// Shapes that are read without the representations that would say where they stand.
fn unplaced() -> Unread {
    Unread {
        entity: 0,
        keyword: "SHAPE_REPRESENTATION".into(),
        reason: "the shapes belong to no representation that can be read: which are of the model, and where they stand, is not known"
            .into(),
        holds_faces: true,
    }
}

/// Representations with faces that belong to no product and stand in none, beside products: where they stand is not known. A file
/// without products is a part as it stands.
fn homeless(
    assembly: &Assembly,
    tree: &[Node],
    file: &File,
    has_faces: impl Fn(usize) -> bool,
) -> Vec<Unread> {
    let placed: BTreeSet<usize> = tree.iter().flat_map(|n| &n.children).map(|c| c.node).collect();
    if !file.entities().any(|e| e.record("SHAPE_DEFINITION_REPRESENTATION").is_some()) {
        return vec![];
    }
    let is_lost = |n: &usize| !assembly.nodes[*n].is_product && !placed.contains(n) && has_faces(*n);
    let lost = (0..assembly.nodes.len()).filter(is_lost);
    let told = |n: usize| {
        let entity = file.entity(*assembly.nodes[n].representations.first()?).ok()?;
        let line = entity.wrong("").line;
        Some(Unread {
            entity: entity.number(),
            keyword: entity.main(&["REPRESENTATION"]).keyword.into(),
            reason: format!(
                "line {line}: has faces, but belongs to no product: where they stand is not known"
            ),
            holds_faces: true,
        })
    };
    lost.filter_map(told).collect()
}

/// The unit of the first representation that says one.
fn unit(shapes: &BTreeMap<u64, Representation>, options: &ReadOptions) -> LengthUnit {
    let said = shapes.values().find_map(|r| r.context.as_ref().ok()?.length);
    match (said, options.units.or(options.unit_else)) {
        (Some(millimeters), _) => LengthUnit { millimeters, from: UnitFrom::Header },
        (None, Some(unit)) => LengthUnit { millimeters: unit.to_millimeters(1.0), from: UnitFrom::Option },
        (None, None) => LengthUnit { millimeters: 1.0, from: UnitFrom::Assumed },
    }
}

fn warnings(
    shapes: &BTreeMap<u64, Representation>,
    unit: &LengthUnit,
    options: &ReadOptions,
) -> Vec<Warning> {
    let lengths = shapes.values().filter(|r| !r.items.is_empty()).map(|r| r.context.as_ref().ok()?.length);
    let without = lengths.filter(Option::is_none).count() as u64;
    let mut all = vec![];
    if without > 0 {
        all.push(Warning::UnitMissing { count: without, millimeters: unit.millimeters });
    }
    let asked = options.units.filter(|asked| asked.to_millimeters(1.0) != unit.millimeters);
    let said = crate::Unit::ALL.into_iter().find(|u| u.to_millimeters(1.0) == unit.millimeters);
    if let (Some(asked), Some(said), UnitFrom::Header) = (asked, said, unit.from) {
        all.push(Warning::UnitKept { said, asked });
    }
    all
}

/// The entities that could not be parsed, and the end of the file if it is missing.
fn damaged(file: &File) -> Vec<Unread> {
    let mut all: Vec<Unread> = vec![];
    for broken in file.broken().iter().take(MAX_TOLD) {
        let keyword = file.keyword_of(broken);
        let reason = file.entity(broken.number).err().map_or_else(String::new, |wrong| wrong.to_string());
        let holds_faces = keyword.is_empty() || CONTAINERS.iter().any(|c| keyword.contains(c));
        all.push(Unread { entity: broken.number, keyword: keyword.into(), reason, holds_faces });
    }
    let more = file.broken().len().saturating_sub(MAX_TOLD);
    if more > 0 {
        let reason = format!("{more} more entities are damaged");
        all.push(Unread { entity: 0, keyword: String::new(), reason, holds_faces: true });
    }
    if !file.is_whole() {
        let reason = format!("the file is cut short: line {} is its last one", file.last_line());
        all.push(Unread { entity: 0, keyword: "END-ISO-10303-21".into(), reason, holds_faces: true });
    }
    all
}

/// Parts of keywords of entities that lead to faces; what faces themselves need is told with them.
const CONTAINERS: [&str; 10] = [
    "REPRESENTATION",
    "SHELL",
    "BREP",
    "SOLID",
    "FACE",
    "SURFACE_MODEL",
    "MAPPED_ITEM",
    "OCCURRENCE",
    "TRANSFORMATION",
    "PRODUCT_DEFINITION",
];
