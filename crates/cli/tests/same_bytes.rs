//! The same bytes on any machine: what the commands write over the corpus, under each instruction set, on one thread and on three.
//!
//! Kept are hashes: in `golden/numbers.tsv` those of documents, point files and models, in `golden/words.tsv` those of pages, tables,
//! drawings and help texts. After a change that is meant, write them anew with `TRUENESS_BLESS=numbers`, `words` or `1` (both), and say
//! in the commit why they changed. A change of words leaves the numbers as they are. Of a report the scripts and styles of the viewer
//! are left out.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

mod common;
use common::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Files of the corpus that the commands read, by the name they have there.
const INPUTS: &[&str] = &[
    "bunny/zipper_res2.ply",
    "bunny/zipper_res3.ply",
    "broken/ok_ascii.stl",
    "examples/plate/nominal.stl",
    "examples/plate/plate.toml",
    "examples/plate/scan.stl",
    "reference_surfaces/franke_400_noise.txt",
    "shapes/numpy-stl__Moon_Chinese.stl",
    "shapes/trimesh__angle_block.STL",
    "shapes/trimesh__soup.stl",
    "shapes/trimesh__wallhole.obj",
];

/// What is run, in this order; `…` stands for the name of the run.
const RUNS: &[(&str, &str)] = &[
    (
        "compare",
        "compare zipper_res3.ply zipper_res2.ply --tolerance 0.5 --research --json ….json --html ….html --out ….csv",
    ),
    ("compare_npz", "compare zipper_res3.ply zipper_res2.ply --out ….npz"),
    ("compare_parquet", "compare zipper_res3.ply zipper_res2.ply --out ….parquet"),
    ("compare_vtp", "compare zipper_res3.ply zipper_res2.ply --out ….vtp"),
    ("compare_ply", "compare zipper_res3.ply zipper_res2.ply --out ….ply"),
    ("compare_paper", "compare zipper_res3.ply zipper_res2.ply --method paper --json ….json"),
    ("compare_winding", "compare zipper_res3.ply zipper_res2.ply --sign winding --json ….json"),
    ("align", "align scan.stl nominal.stl --json ….json --out ….ply"),
    ("check", "check zipper_res2.ply --json ….json --html ….html"),
    ("check_soup", "check trimesh__soup.stl --json ….json"),
    ("repair", "repair zipper_res3.ply --json ….json --html ….html --out ….stl"),
    ("repair_crossing", "repair trimesh__angle_block.STL --json ….json --out ….obj"),
    ("repair_wall", "repair trimesh__wallhole.obj --json ….json --out ….off"),
    ("fit", "fit trimesh__angle_block.STL --shape sphere --json ….json"),
    ("fit_zone", "fit zipper_res3.ply --shape cylinder --method minimum-zone --json ….json"),
    ("segment", "segment nominal.stl --json ….json --out ….ply --html ….html"),
    ("section", "section scan.stl --plane 0,0,1,3 --json ….json --dxf ….dxf --svg ….svg"),
    ("surface", "surface franke_400_noise.txt --spans 6x6 --json ….json --step ….step --iges ….igs"),
    ("surface_tolerance", "surface franke_400_noise.txt --tolerance 0.5 --json ….json"),
    (
        "surface_trim",
        "surface franke_400_noise.txt --spans 6x6 --trim --json ….json --step ….step --iges ….igs --obj ….obj",
    ),
    ("info", "info zipper_res3.ply --json ….json"),
    ("convert", "convert zipper_res3.ply ….obj --json ….json"),
    ("curvature", "curvature zipper_res3.ply --json ….json --out ….npz"),
    ("inspect", "inspect plate.toml --json ….json --html ….html --csv ….csv --junit ….xml --qif ….qif"),
    ("inspect_nominal", "inspect plate.toml --measured nominal.stl --json ….json"),
    ("trend", "trend inspect.json inspect_nominal.json --json ….json --csv ….csv --html ….html"),
];

/// What a file is for, which says where its hash is kept.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Documents, point files and models.
    Numbers,
    /// Pages, tables, drawings and help texts.
    Words,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Kind::Numbers => "numbers",
            Kind::Words => "words",
        }
    }
    fn of(file: &str) -> Kind {
        let is_table = ["inspect.csv", "trend.csv"].contains(&file);
        let ending = file.rsplit('.').next().unwrap();
        if is_table || ["html", "xml", "svg", "stdout", "help"].contains(&ending) {
            Kind::Words
        } else {
            Kind::Numbers
        }
    }
}

/// The hash of each file that is written, and of what is printed.
type Hashes = BTreeMap<String, u64>;

fn written(level: &str, threads: &str) -> Option<Hashes> {
    let f = Folder::new();
    for input in INPUTS {
        let name = Path::new(input).file_name().unwrap();
        std::fs::copy(corpus(input), f.0.join(name)).unwrap();
    }
    let given = f.names();
    let mut all = Hashes::new();
    for (name, line) in RUNS {
        let words: Vec<String> = line.split(' ').map(|word| word.replace('…', name)).collect();
        let mut command = Command::new(env!("CARGO_BIN_EXE_trueness"));
        command.args(&words).args(["--threads", threads]).env_remove("COLUMNS").stdin(Stdio::null());
        let o = command.current_dir(&f.0).env("TRUENESS_INSTRUCTIONS", level).output().unwrap();
        if stderr(&o).contains("this processor lacks") {
            return None;
        }
        assert!(status(&o) <= 1, "{name}: {}", stderr(&o));
        all.insert(format!("{name}.stdout"), hash(&o.stdout));
    }
    for name in f.names().into_iter().filter(|name| !given.contains(name)) {
        let bytes = std::fs::read(f.file(&name)).unwrap();
        let bytes = if name.ends_with(".html") { without_viewer(&bytes) } else { bytes };
        all.insert(name, hash(&bytes));
    }
    Some(all)
}

/// The help of the program, of every command that it lists, and of those that these list.
fn help_texts() -> Hashes {
    let mut hashes = Hashes::new();
    let mut open: Vec<Vec<String>> = vec![vec![]];
    while let Some(words) = open.pop() {
        let mut command = Command::new(env!("CARGO_BIN_EXE_trueness"));
        let o =
            command.args(&words).arg("--help").env_remove("COLUMNS").stdin(Stdio::null()).output().unwrap();
        assert_eq!(status(&o), 0, "{words:?}: {}", stderr(&o));
        let text = stdout(&o);
        let listed =
            text.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
        // A line that goes on is indented deeper. `help` has no help.
        let names = listed.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
        for name in names.filter(|name| !["", "help"].contains(name)) {
            open.push([&words[..], &[name.to_string()]].concat());
        }
        hashes.insert(format!("trueness {}.help", words.join(" ")).replace(" .", "."), hash(text.as_bytes()));
    }
    assert!(hashes.len() > 10, "{hashes:?}");
    hashes
}

/// A page without its scripts and styles, but with its data.
fn without_viewer(page: &[u8]) -> Vec<u8> {
    let mut text = String::from_utf8(page.to_vec()).unwrap();
    for (open, close) in [("<script>", "</script>"), ("<style>", "</style>")] {
        while let Some(from) = text.find(open) {
            let to = from + text[from..].find(close).unwrap() + close.len();
            text.replace_range(from..to, "");
        }
    }
    text.into_bytes()
}

/// FNV-1a of 64 bits.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3))
}

fn kept(kind: Kind) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(kind.name()).with_extension("tsv")
}

/// Lines of this kind that are kept.
fn lines(hashes: &Hashes, kind: Kind) -> Vec<String> {
    let of_kind = hashes.iter().filter(|(name, _)| Kind::of(name) == kind);
    of_kind.map(|(name, hash)| format!("{name}\t{hash:016x}")).collect()
}

#[test]
fn every_instruction_set_writes_the_bytes_that_are_kept() {
    let help = help_texts();
    let now = |level: &str, threads: &str| {
        let mut now = written(level, threads)?;
        now.extend(help.clone());
        Some(now)
    };
    for kind in [Kind::Numbers, Kind::Words].into_iter().filter(|kind| is_blessed(kind.name())) {
        std::fs::write(kept(kind), lines(&now("plain", "1").unwrap(), kind).join("\n") + "\n").unwrap();
    }
    let mut other = vec![];
    for (level, threads) in [("plain", "1"), ("avx2", "3"), ("avx512", "2")] {
        let Some(now) = now(level, threads) else {
            println!("NOT TRIED: {level}, which this processor lacks");
            continue;
        };
        for kind in [Kind::Numbers, Kind::Words] {
            let kept = std::fs::read_to_string(kept(kind)).unwrap();
            let (now, kept) = (lines(&now, kind), kept.lines().map(String::from).collect::<Vec<_>>());
            let told = |have: &[String], lack: &[String], what: &str, other: &mut Vec<String>| {
                let lines = have.iter().filter(|line| !lack.contains(line));
                other.extend(lines.map(|line| format!("{level}: {}: {what} {line}", kind.name())));
            };
            told(&now, &kept, "now", &mut other);
            told(&kept, &now, "kept", &mut other);
        }
    }
    assert!(other.is_empty(), "other bytes:\n{}", other.join("\n"));
}

#[test]
fn an_instruction_set_that_there_is_not_is_refused() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trueness"));
    let o = command.args(["check", "x.stl"]).env("TRUENESS_INSTRUCTIONS", "mmx").output().unwrap();
    assert_eq!(status(&o), 2);
    assert!(
        stderr(&o).contains("TRUENESS_INSTRUCTIONS=mmx: give one of plain, avx2, avx512"),
        "{}",
        stderr(&o)
    );
}
