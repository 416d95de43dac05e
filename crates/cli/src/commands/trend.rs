//! `trueness trend`: one plan over many parts.

use crate::command::Run;
use crate::console;
use crate::exit::{self, Outcome};
use crate::layout::{self, names, sentence};
use crate::number::{counted, fixed, short, six_digits};
use crate::options::{Common, DocumentArgs};
use crate::output::whole_file;
use crate::report::ReportArgs;
use crate::run_files::RunFiles;
use anyhow::{Context, anyhow, bail};
use clap::Args;
use std::fmt::Write;
use std::io::Read;
use std::path::{Path, PathBuf};
use trueness_document::Verdict;
use trueness_document::inspect::{self, InspectDocument};
use trueness_document::place_map::{MapPlace, TrendMap};
use trueness_document::trend::{IndexRecord, ResultInput, TrendDocument, TrendError, TrendRecord};
use trueness_report::MapPage;
use trueness_report::views::trend::View;

/// Longest result that is read, bytes.
const LONGEST: u64 = 256 << 20;

/// The course of an inspection plan over many parts: capability, control limits
///
/// Reads the results that `trueness inspect --json` wrote, in the order in which the parts were made.
#[derive(Args, Debug)]
#[command(after_help = exit::help("a part does not pass, or a value is out of control", "\
Examples:
  trueness trend part-01.json part-02.json part-03.json
  trueness trend results/*.json --json trend.json --csv trend.csv --html trend.html
  trueness trend results/*.json --map map.html"))]
pub struct TrendArgs {
    /// Results of `trueness inspect --json`, one part each, in their order
    #[arg(required = true)]
    results: Vec<PathBuf>,
    #[command(flatten)]
    document: DocumentArgs,
    /// Write the characteristics as a table, one line each
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a report with the maps of mean and spread over the part; needs results of `trueness inspect --places`
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

impl Run for TrendArgs {
    fn files(&self) -> anyhow::Result<RunFiles> {
        Ok(RunFiles::of(&self.results)
            .document(self.document.json.as_ref())
            .report(self.report.html.as_ref())
            .also("--csv", self.csv.as_ref())
            .also("--map", self.map.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        let read = self.results.iter().map(|path| read(path));
        let (inputs, results): (Vec<_>, Vec<_>) =
            read.collect::<anyhow::Result<Vec<_>>>()?.into_iter().unzip();
        let document = trueness_measure::trend::document(inputs, &results).map_err(|e| match &e {
            TrendError::Different { index, .. }
            | TrendError::Twice { index, .. }
            | TrendError::Changed { index, .. } => {
                anyhow!("{}: {e}", self.results[*index].display())
            }
            TrendError::None => anyhow!("{e}"),
        })?;
        let page = self.map.as_ref().map(|path| (path, MapPage::of(&document)));
        if let Some((path, None)) = &page {
            let why = document.map_reason.as_deref().unwrap_or("there are no places");
            bail!("{}: there is no map: {why}", path.display());
        }
        if let Some(path) = &self.csv {
            let text = csv(&document);
            whole_file(path, |file| file.write_all(text.as_bytes()))?;
        }
        self.report.write(&document, &[], &[], common.progress)?;
        if let (Some((path, Some(page))), Some(map)) = (page, &document.map) {
            let view = View::new(map);
            self.report.write_to(path, &page, &view.objects(), &[], common.progress)?;
        }
        self.document.write(&document)?;
        self.document.table(|| table(&document, common.verbose))?;
        let well = document.verdict == Verdict::Pass && document.in_control;
        Ok(if well { Outcome::Conforming } else { Outcome::NotConforming })
    }
}

/// A result of an inspection and what it was read from.
fn read(path: &Path) -> anyhow::Result<(ResultInput, InspectDocument)> {
    let shown = path.display();
    if crate::run_files::is_stream(path) {
        bail!("{shown}: a result must be a file");
    }
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).with_context(|| format!("{shown}: the result cannot be read"))?;
    let taken = file.take(LONGEST + 1).read_to_end(&mut bytes);
    taken.with_context(|| format!("{shown}: the result cannot be read"))?;
    if bytes.len() as u64 > LONGEST {
        bail!("{shown}: it is longer than 256 MB; this is no result of an inspection");
    }
    let value: serde_json::Value = serde_json::from_slice(&bytes)
        .map_err(|e| anyhow!("{shown}: it is no JSON ({e}); give what `trueness inspect --json` wrote"))?;
    let schema = value.get("schema").and_then(|s| s.as_str()).unwrap_or("no schema").to_string();
    if schema != inspect::SCHEMA {
        let wanted = inspect::SCHEMA;
        bail!(
            "{shown}: its schema is \"{schema}\", not \"{wanted}\"; give what `trueness inspect --json` wrote"
        );
    }
    let document: InspectDocument =
        serde_json::from_value(value).map_err(|e| anyhow!("{shown}: it is no whole result: {e}"))?;
    let digest = trueness_files::sha256(path).ok();
    let input = ResultInput {
        path: shown.to_string(),
        format: schema,
        bytes: bytes.len() as u64,
        sha256: digest.map(|d| d.iter().map(|b| format!("{b:02x}")).collect()),
        unit_assumed: document.units.clone(),
    };
    Ok((input, document))
}

/// The document for people.
fn table(document: &TrendDocument, verbose: bool) -> String {
    let mut out = String::new();
    if let Some(title) = &document.title {
        let _ = writeln!(out, "{title}");
    }
    for warning in &document.warnings {
        out += &sentence(&format!("! {warning}"), verbose);
    }
    out += &layout::table(&courses(&document.characteristics), 3);
    out += &layout::table(&capabilities(&document.characteristics), 1);
    let mut reasons: Vec<(&str, Vec<&str>)> = vec![];
    for c in &document.characteristics {
        for o in &c.out_of_control {
            let part = usize::try_from(o.part).ok().and_then(|n| document.parts.get(n));
            let name = part.map_or("", |p| &p.name);
            let text = format!("! {}: part {} ({name}) is {}", c.id, o.part + 1, o.rule.words());
            out += &sentence(&text, verbose);
        }
        if let Some(reason) = c.course_reason.as_ref().or(c.capability_reason.as_ref()) {
            match reasons.iter_mut().find(|r| r.0 == reason) {
                Some((_, ids)) => ids.push(&c.id),
                None => reasons.push((reason, vec![&c.id])),
            }
        }
    }
    for (reason, ids) in reasons {
        out += &sentence(&format!("  {}: {reason}", names(&ids, verbose)), verbose);
    }
    out.extend(document.map.as_ref().map(of_map));
    let passed = document.parts.iter().filter(|p| p.verdict == Verdict::Pass).count();
    let _ = writeln!(
        out,
        "{}: {}, {passed} of them pass; {}; intervals of {} %; mm, degrees",
        document.verdict.word(),
        counted(document.parts.len() as u64, ["part", "parts"]),
        if document.in_control { "in control" } else { "out of control" },
        100.0 * document.confidence
    );
    out
}

/// Where mean and spread over the part are greatest.
fn of_map(map: &TrendMap) -> String {
    let at = |place: Option<MapPlace>| match place {
        None => "–".into(),
        Some(MapPlace { position: [x, y, z], value, .. }) => {
            let [x, y, z] = [x, y, z].map(|x| fixed(x, 3));
            format!("{} at {x}, {y}, {z}", six_digits(value))
        }
    };
    let complete = counted(map.complete, ["place", "places"]);
    let mut out = format!(
        "map: {complete} with a value in every part, {} with some, {} with none\n",
        map.partial, map.without
    );
    for (name, of) in [("mean", &map.means), ("sigma", &map.std_devs)] {
        let _ = writeln!(out, "  {name}: greatest {}", at(of.greatest));
    }
    out
}

/// The course of each characteristic.
fn courses(all: &[TrendRecord]) -> Vec<Vec<String>> {
    let number = |x: Option<f64>| x.map_or_else(|| "–".into(), |x| fixed(x, 4));
    let kind =
        |c: &TrendRecord| format!("{}{}{}", c.symbol, if c.symbol.is_empty() { "" } else { " " }, c.kind);
    let head = ["id", "kind", "feature", "n", "mean", "sigma", "min", "max", "out"];
    let mut rows = vec![head.map(String::from).to_vec()];
    rows.extend(all.iter().map(|c| {
        let sigma = c.std_dev.map_or_else(|| "–".into(), short);
        let out = signaled(c).len().to_string();
        let numbers =
            [c.measured.to_string(), number(c.mean), sigma, number(c.min), number(c.max), out].to_vec();
        [vec![c.id.clone(), kind(c), c.feature.clone()], numbers].concat()
    }));
    rows
}

/// The indices of the characteristics that have some, with their intervals.
fn capabilities(all: &[TrendRecord]) -> Vec<Vec<String>> {
    let index = |i: Option<IndexRecord>| {
        let written =
            |i: IndexRecord| format!("{} ({}…{})", fixed(i.value, 2), fixed(i.low, 2), fixed(i.high, 2));
        i.map_or_else(|| "–".into(), written)
    };
    let of = |c: &TrendRecord| [c.cp, c.cpk, c.pp, c.ppk];
    let some = all.iter().filter(|c| of(c).iter().any(Option::is_some));
    let row = |c: &TrendRecord| [vec![c.id.clone()], of(c).map(index).to_vec()].concat();
    let mut rows: Vec<Vec<String>> = some.map(row).collect();
    if !rows.is_empty() {
        rows.insert(0, ["id", "Cp", "Cpk", "Pp", "Ppk"].map(String::from).to_vec());
    }
    rows
}

/// The parts that are out of control, from 0, each once.
fn signaled(c: &TrendRecord) -> Vec<u64> {
    let mut parts: Vec<u64> = c.out_of_control.iter().map(|o| o.part).collect();
    parts.dedup();
    parts
}

/// One line a characteristic; numbers with all digits (RFC 4180).
fn csv(document: &TrendDocument) -> String {
    let head = "id,kind,feature,datums,unit,lower,upper,parts,measured,mean,std_dev,std_dev_within,min,max,\
                control_lower,control_upper,cp,cp_low,cp_high,cpk,cpk_low,cpk_high,pp,pp_low,pp_high,ppk,ppk_low,ppk_high,\
                out_of_control";
    let mut out = format!("{head}\r\n");
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    for c in &document.characteristics {
        let mut cells = vec![
            c.id.clone(),
            c.kind.clone(),
            c.feature.clone(),
            c.datums.join(" "),
            c.unit.clone(),
            number(c.lower),
            number(c.upper),
            c.values.len().to_string(),
            c.measured.to_string(),
        ];
        let control = |f: fn(&trueness_document::trend::Control) -> f64| c.control.as_ref().map(f);
        let numbers =
            [c.mean, c.std_dev, c.std_dev_within, c.min, c.max, control(|x| x.lower), control(|x| x.upper)];
        cells.extend(numbers.map(number));
        for index in [c.cp, c.cpk, c.pp, c.ppk] {
            cells.extend([index.map(|i| i.value), index.map(|i| i.low), index.map(|i| i.high)].map(number));
        }
        let parts: Vec<String> = signaled(c).iter().map(|n| (n + 1).to_string()).collect();
        cells.push(parts.join(" "));
        out.push_str(&cells.into_iter().map(console::cell).collect::<Vec<_>>().join(","));
        out.push_str("\r\n");
    }
    out
}
