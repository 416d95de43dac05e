//! The whole of a file.

use super::super::global::Global;
use super::super::text::{File, file, up_to_the_end};
use super::assembly::Assembly;
use super::geometry::Geometry;
use super::kinds::name;
use super::looks::{Looks, hidden_and_layers};
use super::shape::Shapes;
use super::sheets::Sheets;
use crate::content::cad_file::{CadContent, LengthUnit};
use crate::content::spline_model::SplineModel;
use crate::error::{Fault, Result};
use crate::format::ReadOptions;
use crate::formats::brep::tree::instances;
use crate::formats::brep::{Budget, MAX_TOLD};
use crate::source::{SNIFFED_BYTES, Source};
use crate::unicode::no_zeros;
use crate::{UnitFrom, Warning};
use trueness_cad::brep::Bounds;
use trueness_cad::curve::Curve;
use trueness_cad::model::{Model, Unread};
use trueness_cad::surface::Surface;
use trueness_geom::progress::Progress;
use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::value::Mass;

/// Resolutions that files state are taken between these, millimeters: what lies nearer together is one place.
const RESOLUTIONS: [f64; 2] = [1e-6, 1e-2];
/// The resolution of a file that states none, millimeters: what most programs state.
const USUAL_RESOLUTION: f64 = 1e-3;

/// Reads the model of a file; whether it holds any shape is another question. The splines are those of a file whose faces are all whole B-spline
/// surfaces, and its curves that bound nothing.
pub(in super::super) fn read(
    source: &mut Source,
    options: &ReadOptions,
    progress: &dyn Progress,
) -> Result<CadContent> {
    let (head, _) = up_to_the_end(source.feed.ahead(SNIFFED_BYTES)?);
    no_zeros(head)?;
    let (text, trailing) = up_to_the_end(source.feed.all()?);
    no_zeros(text)?;
    let file = file(text)?;
    let global = Global::of(&file.global)?;
    let unit = unit(&global, options);
    let mut warnings = vec![];
    if trailing > 0 {
        warnings.push(Warning::TrailingBytes { count: trailing });
    }
    let resolution = global.resolution.map(|r| (r * unit.millimeters).clamp(RESOLUTIONS[0], RESOLUTIONS[1]));
    let budget = Budget::of(file.entities.values().map(|e| 1 + e.words.as_ref().map_or(0, Vec::len)).sum());
    let tolerance = resolution.unwrap_or(USUAL_RESOLUTION);
    let geometry = Geometry { file: &file, unit: unit.millimeters, tolerance, budget: &budget };
    let looks = Looks::of(&file);
    let mut assembly = Assembly::of(&geometry, global.name.clone());
    let mut model = Model { uncertainty: resolution, ..Model::default() };
    let mut parts = vec![None; assembly.nodes.len()];
    let mut sheets = Sheets::default();
    for (node, own) in parts.iter_mut().enumerate() {
        let mut shapes = Shapes::new(geometry, &looks, progress);
        shapes.wires = assembly.wires[node];
        assembly.shapes[node].iter().for_each(|number| shapes.add(*number));
        let (part, told, mut unread) = shapes.part(assembly.nodes[node].name.clone());
        if progress.cancelled() {
            return Err(Fault::Cancelled.into());
        }
        sheets.add(&told);
        model.unread.append(&mut unread);
        if !part.brep.faces.is_empty() || part.wires > 0 {
            *own = Some((model.parts.len() as u32, part.brep.faces.len() as u64));
            model.parts.push(part);
        }
    }
    let color = |number: u64| looks.color(file.entities.get(&number)?);
    let made = instances(&mut assembly.nodes, &parts, color)?;
    (model.instances, model.depth) = (made.instances, made.levels);
    model.unread.append(&mut assembly.unread);
    model.unread.extend(made.cut.into_iter().map(|(entity, own)| Unread {
        entity,
        keyword: name(408),
        reason: format!("places \"{own}\" in itself"),
        holds_faces: true,
    }));
    model.unread.extend(damaged(&file));
    (model.hidden, model.layers) = hidden_and_layers(&file);
    if sheets.turned > 0 || sheets.closed > 0 {
        let Sheets { faces, closed, turned } = sheets;
        warnings.push(Warning::Sheets { faces, closed, turned });
    }
    let splines = splines(&model, &geometry);
    Ok(CadContent { model, unit, warnings, splines })
}

/// The unit that the file states, else the one that is asked for.
fn unit(global: &Global, options: &ReadOptions) -> LengthUnit {
    match (global.millimeters, options.units.or(options.unit_else)) {
        (Some(millimeters), _) => LengthUnit { millimeters, from: UnitFrom::Header },
        (None, Some(unit)) => LengthUnit { millimeters: unit.to_millimeters(1.0), from: UnitFrom::Option },
        (None, None) => LengthUnit { millimeters: 1.0, from: UnitFrom::Assumed },
    }
}

/// Kinds of entities that hold shapes; what these need is told with them.
const SHAPE_KINDS: [u64; 8] = [0, 144, 143, 186, 308, 408, 510, 514];

/// The damaged entities that hold shapes, and the end of the file if it is missing.
fn damaged(file: &File) -> Vec<Unread> {
    let mut all: Vec<Unread> = vec![];
    let mut more = 0;
    for entity in file.entities.values() {
        let Err(reason) = &entity.words else { continue };
        if all.len() == MAX_TOLD {
            more += 1;
            continue;
        }
        let (keyword, holds_faces) = (name(entity.kind), SHAPE_KINDS.contains(&entity.kind));
        let reason = format!("line {}: {reason}", entity.line);
        all.push(Unread { entity: entity.number, keyword, reason, holds_faces });
    }
    let mut tell = |keyword: &str, reason: String| {
        all.push(Unread { entity: 0, keyword: keyword.into(), reason, holds_faces: true });
    };
    if more > 0 {
        tell("", format!("{more} more entities are damaged"));
    }
    if !file.is_whole {
        tell("section T", format!("the file is cut short: line {} is its last one", file.last_line));
    }
    all
}

/// The surfaces of a model whose faces are all whole B-spline surfaces, and the B-spline curves that bound nothing.
fn splines(model: &Model, geometry: &Geometry) -> Option<SplineModel> {
    let mut found = SplineModel::default();
    for face in
        model.instances.iter().filter_map(|i| model.parts.get(i.part as usize)).flat_map(|p| &p.brep.faces)
    {
        let (Surface::Spline(nurbs), Bounds::Rectangle([u, v])) = (&face.surface, &face.bounds) else {
            return None;
        };
        let own = nurbs.within([(*u).into(), (*v).into()]);
        found.surfaces.push(if face.reversed { own.flipped() } else { own });
    }
    if !model.is_complete() || model.instances.len() > 1 {
        return None;
    }
    let is_curve = |e: &&super::super::text::Entity| e.kind == 126 && e.status[2] != 5;
    for entity in geometry.file.entities.values().filter(is_curve) {
        found.curves.extend(rational(&geometry.curve(entity.number).ok()?.curve));
    }
    Some(found)
}

fn rational(curve: &Curve) -> Option<Rational<3>> {
    match curve {
        Curve::Rational(own) => Some(own.clone()),
        Curve::Spline(own) => {
            let masses = own.points().iter().map(|p| Mass::new(*p, 1.0)).collect();
            Rational::of_masses(own.knots().clone(), masses).ok()
        }
        _ => None,
    }
}
