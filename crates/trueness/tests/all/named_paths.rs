//! Every item that a page of the manual names by its path is there: the compiler looks it up, as rustdoc does for links.

use std::collections::BTreeSet;
use std::path::Path;

/// Imports the items, and gives their paths.
macro_rules! items {
    ($($($part:ident)::+,)+) => {
        #[allow(unused_imports)]
        mod imported {
            $(use trueness::$($part)::+ as _;)+
        }
        const ITEMS: &[&str] = &[$(stringify!($($part)::+)),+];
    };
}

items! {
    files::open,
    geom::deviation::paper,
    geom::spline::surface,
    surface::curvature::cloud,
    surface::curvature::mesh,
    surface::fit,
}

/// The crates and rooms that the crate `trueness` offers, with which a path begins.
const BEGINNINGS: [&str; 11] =
    ["cad", "document", "files", "geom", "measure", "report", "section", "solid", "surface", "task", "tasks"];

/// What stands between backquotes and begins as a path.
fn named(text: &str) -> impl Iterator<Item = String> {
    let quoted = text.split('`').skip(1).step_by(2);
    quoted.filter_map(|code| {
        let path = code.split(|c: char| !(c.is_alphanumeric() || "_:".contains(c))).next().unwrap();
        let path = path.trim_start_matches("trueness::").trim_end_matches(':');
        let (first, _) = path.split_once("::")?;
        BEGINNINGS.contains(&first).then(|| path.to_string())
    })
}

#[test]
fn pages_of_the_manual_name_what_there_is() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let pages = std::fs::read_dir(root.join("docs")).unwrap().map(|file| file.unwrap().path());
    let pages = pages.filter(|path| path.extension().is_some_and(|e| e == "md"));
    let others = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"].map(|name| root.join(name));
    let all: BTreeSet<String> = pages
        .chain(others)
        .flat_map(|page| named(&std::fs::read_to_string(page).unwrap()).collect::<Vec<_>>())
        .collect();
    // Whether an item is there the compiler says of those in the list.
    let known: BTreeSet<String> = ITEMS.iter().map(|item| item.replace(' ', "")).collect();
    assert_eq!(all, known, "the paths that pages name, and `items!` here");
}
