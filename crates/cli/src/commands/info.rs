//! `trueness info`: what is in a file.

use crate::command::Run;
use crate::number::{EDGES, FACETS, POINTS, SHELLS, counted, extent, fixed};
use crate::options::{Common, DocumentArgs, PointInputArgs};
use crate::task;
use clap::Args;
use std::path::PathBuf;
use trueness::task::{Outcome, Request, RunFiles};
use trueness::tasks::info::InfoRequest;
use trueness_document::info::{CadRecord, InfoDocument};
use trueness_files::FileSources;

/// What is in a file: points, facets, CAD faces, parts, unit, size
///
/// Reads a file of any format and tells what it holds. Of a CAD model: faces by kind, area, volume, parts and where they stand, and every
/// face that could not be read.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness info scan.ply
  trueness info part.stp --json -")]
pub struct InfoArgs {
    /// A file of any format that is read; `-` reads stdin
    file: PathBuf,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
}

impl InfoArgs {
    fn request(&self) -> InfoRequest {
        InfoRequest { file: self.file.clone(), reading: self.input.reading() }
    }
}

impl Run for InfoArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        Ok(self.request().files(&FileSources)?.document(self.document.json.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run(&self.request(), &self.document, common, |done| table(&done.document, common.verbose))
    }
}

/// Faces that could not be read, and parts, that are listed without `--verbose`.
const LISTED_ROWS: usize = 10;

fn table(d: &InfoDocument, all: bool) -> String {
    let mut rows: Vec<(&str, String)> = vec![];
    for input in &d.inputs {
        rows.push(("file", format!("{}  ({}, {})", input.path, input.format, d.unit)));
        rows.extend(input.warnings.iter().map(|w| ("!", w.clone())));
    }
    rows.push(("holds", d.content.to_string()));
    let counts = [(d.points, POINTS), (d.facets, FACETS)];
    let counts: Vec<String> = counts.into_iter().filter_map(|(n, what)| Some(counted(n?, what))).collect();
    if !counts.is_empty() {
        rows.push(("", counts.join(", ")));
    }
    match d.bounds {
        Some([least, greatest]) => {
            let size: Vec<String> = (0..3).map(|k| extent(greatest[k] - least[k])).collect();
            rows.push(("size", format!("{} mm", size.join(" × "))));
            rows.push(("from", least.map(|x| fixed(x, 4)).join("  ")));
            rows.push(("to", greatest.map(|x| fixed(x, 4)).join("  ")));
        }
        None => rows.push(("size", "none".into())),
    }
    if let Some(area) = d.area {
        rows.push(("area", format!("{} mm²", extent(area))));
    }
    if let Some(cad) = &d.cad {
        self::cad(cad, if all { usize::MAX } else { LISTED_ROWS }, &mut rows);
    }
    rows.into_iter().map(|(name, text)| format!("{name:<8} {text}\n")).collect()
}

fn cad(cad: &CadRecord, most: usize, rows: &mut Vec<(&str, String)>) {
    let faces: Vec<String> = cad.faces.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
    let total = cad.faces.values().sum();
    rows.push(("faces", format!("{}: {}", counted(total, ["face", "faces"]), faces.join(", "))));
    let solids = counted(cad.solids, ["solid", "solids"]);
    rows.push(("", [counted(cad.edges, EDGES), counted(cad.shells, SHELLS), solids].join(", ")));
    match (cad.volume, &cad.volume_reason) {
        (Some(volume), _) => rows.push(("volume", format!("{} mm³", extent(volume)))),
        (None, reason) => rows.push(("volume", format!("none: {}", reason.as_deref().unwrap_or_default()))),
    }
    let [parts, instances] = [(cad.parts.len() as u64, "part"), (cad.instances, "instance")]
        .map(|(n, what)| counted(n, [what, &format!("{what}s")]));
    rows.push(("parts", format!("{parts}, {instances}, assembly of depth {}", cad.depth)));
    for part in cad.parts.iter().take(most) {
        let [faces, solids] = [(part.faces, "face"), (part.solids, "solid")]
            .map(|(n, what)| counted(n, [what, &format!("{what}s")]));
        rows.push(("", format!("{} × {}: {faces}, {solids}", part.instances, part.name)));
    }
    if let Some(tolerances) = &cad.tolerances {
        let datums = counted(tolerances.datums, ["datum", "datums"]);
        let dimensions = counted(tolerances.dimensions, ["dimension", "dimensions"]);
        rows.push(("allows", format!("{datums}, {dimensions}; `trueness plan init` makes a plan of them")));
        let kinds: Vec<String> = tolerances.geometric.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
        if !kinds.is_empty() {
            rows.push(("", kinds.join(", ")));
        }
    }
    for face in cad.refused.iter().take(most) {
        rows.push(("! unread", format!("#{} {}: {}", face.face, face.keyword, face.why)));
    }
    for (what, n) in [("parts", cad.parts.len()), ("unread faces", cad.refused.len())] {
        if n > most {
            rows.push(("", format!("{} more {what}: --verbose lists them", n - most)));
        }
    }
    for unread in &cad.unread {
        rows.push(("! unread", format!("{} × {}: {}", unread.count, unread.keyword, unread.why)));
    }
}
