//! Circles of files that name each other's items.

use super::{modules, paths};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

/// From a file to those it takes names from, with the names.
type Arrows = BTreeMap<PathBuf, BTreeMap<PathBuf, BTreeSet<String>>>;

/// Who names whose items among the files of a library, and among those of its program.
pub struct Graphs(Vec<Arrows>);

impl Graphs {
    /// Reads a crate's sources.
    ///
    /// # Errors
    /// A file that cannot be read or is not Rust.
    pub fn read(source: &Path) -> io::Result<Graphs> {
        let roots = ["lib.rs", "main.rs"].into_iter().filter(|root| source.join(root).exists());
        roots.map(|root| arrows(source, root)).collect::<io::Result<_>>().map(Graphs)
    }
    /// All files, relative to the sources.
    pub fn files(&self) -> BTreeSet<&Path> {
        self.0.iter().flat_map(|arrows| arrows.keys().map(PathBuf::as_path)).collect()
    }
    /// The circles of files, each with the arrows that make it; `name` stands for the crate's sources.
    pub fn of_files(&self, name: &str) -> Vec<String> {
        let all: BTreeSet<String> = self
            .0
            .iter()
            .flat_map(|arrows| rings(arrows).into_iter().map(|ring| told(name, "files", &ring, arrows)))
            .collect();
        all.into_iter().collect()
    }
    /// The circles of rooms, at every depth: folders, and files beside them, that reach one another through any of their files.
    pub fn of_rooms(&self, name: &str) -> Vec<String> {
        let mut all: Vec<String> = vec![];
        for arrows in &self.0 {
            let folders: BTreeSet<&Path> = arrows.keys().flat_map(|file| file.ancestors().skip(1)).collect();
            for folder in folders {
                let rooms = between_rooms(arrows, folder);
                for ring in rings(&rooms) {
                    let text = told(name, "rooms", &ring, &rooms);
                    // Modules that the library and the program share are seen twice.
                    if !all.contains(&text) {
                        all.push(text);
                    }
                }
            }
        }
        all
    }
}

/// The arrows among what lies in a folder, each file as the room that it is in or stands for; the head of the folder is none of them.
fn between_rooms(arrows: &Arrows, folder: &Path) -> Arrows {
    let room = |file: &Path| {
        let first = file.strip_prefix(folder).ok()?.components().next()?;
        let room = folder.join(first).with_extension("");
        let is_head = ["mod", "lib", "main"].iter().any(|head| room.file_name().is_some_and(|n| n == *head));
        (!is_head).then_some(room)
    };
    let mut all = Arrows::new();
    for (from, to, names) in arrows.iter().flat_map(|(from, to)| to.iter().map(move |(to, n)| (from, to, n)))
    {
        if let (Some(from), Some(to)) = (room(from), room(to))
            && from != to
        {
            all.entry(to.clone()).or_default();
            all.entry(from).or_default().entry(to).or_default().extend(names.iter().cloned());
        }
    }
    all
}

fn arrows(source: &Path, root: &str) -> io::Result<Arrows> {
    let modules = modules::of_crate(source, root)?;
    let mut arrows = Arrows::new();
    for (number, module) in modules.iter().enumerate() {
        let mut paths: Vec<Vec<String>> = module.imports.values().cloned().collect();
        module.tokens.iter().for_each(|tokens| paths::written_in(tokens, &mut paths));
        let from = arrows.entry(module.file.clone()).or_default();
        for path in paths {
            if let Some(to) = paths::definition(&modules, number, &path)
                && modules[to].file != module.file
            {
                let name = path.last().cloned().unwrap_or_default();
                from.entry(modules[to].file.clone()).or_default().insert(name);
            }
        }
    }
    Ok(arrows)
}

/// Groups of files that reach one another, of two and more; a file is in one group at most.
fn rings(arrows: &Arrows) -> Vec<Vec<PathBuf>> {
    let files: Vec<&PathBuf> = arrows.keys().collect();
    let numbers: BTreeMap<&PathBuf, usize> = files.iter().enumerate().map(|(n, file)| (*file, n)).collect();
    let to: Vec<Vec<usize>> =
        arrows.values().map(|to| to.keys().filter_map(|file| numbers.get(file).copied()).collect()).collect();
    let reached: Vec<Vec<bool>> = (0..files.len()).map(|from| reach(&to, from)).collect();
    let mut rings: BTreeSet<Vec<usize>> = BTreeSet::new();
    for (from, all) in reached.iter().enumerate().filter(|(from, all)| all[*from]) {
        rings.insert((0..files.len()).filter(|other| all[*other] && reached[*other][from]).collect());
    }
    rings.into_iter().map(|ring| ring.into_iter().map(|n| files[n].clone()).collect()).collect()
}

/// Which of all can be reached from `from` by one arrow or more.
fn reach(to: &[Vec<usize>], from: usize) -> Vec<bool> {
    let mut reached = vec![false; to.len()];
    let mut open = vec![from];
    while let Some(at) = open.pop() {
        open.extend(to[at].iter().filter(|next| !std::mem::replace(&mut reached[**next], true)));
    }
    reached
}

/// The arrows of a circle: from, to, and the names that are taken.
fn inside<'a>(
    ring: &'a [PathBuf],
    arrows: &'a Arrows,
) -> impl Iterator<Item = (&'a PathBuf, &'a PathBuf, &'a BTreeSet<String>)> {
    let from = ring.iter().filter_map(|from| arrows.get_key_value(from));
    let all = from.flat_map(|(from, to)| to.iter().map(move |(to, names)| (from, to, names)));
    all.filter(|(_, to, _)| ring.contains(to))
}

fn told(name: &str, what: &str, ring: &[PathBuf], arrows: &Arrows) -> String {
    let mut text = format!("{name}: a circle of {} {what}", ring.len());
    for (from, to, names) in inside(ring, arrows) {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        text += &format!("\n    {} -> {}: {}", from.display(), to.display(), names.join(", "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Files of a crate in a folder of their own, and the circles of files that are found in them.
    fn found(name: &str, files: &[(&str, &str)]) -> Vec<String> {
        looked_at(name, files, |folder| Graphs::read(folder).unwrap().of_files("crate"))
    }

    fn looked_at<T>(name: &str, files: &[(&str, &str)], look: fn(&Path) -> T) -> T {
        let folder = std::env::temp_dir().join(format!("tidy-{}-{name}", std::process::id()));
        for (file, text) in files {
            let path = folder.join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let found = look(&folder);
        fs::remove_dir_all(&folder).unwrap();
        found
    }

    #[test]
    fn a_program_beside_a_library_is_looked_at_too() {
        let files = [
            ("lib.rs", "pub mod c;"),
            ("c.rs", "pub struct C;"),
            ("main.rs", "mod a; mod b;"),
            ("a.rs", "use crate::b::B; pub struct A;"),
            ("b.rs", "pub struct B; use super::a::A;"),
        ];
        assert_eq!(found("program", &files).len(), 1);
    }

    #[test]
    fn two_files_that_use_each_other_are_a_circle() {
        let circle = found(
            "pair",
            &[
                ("lib.rs", "mod a; mod b;"),
                ("a.rs", "use crate::b::B; pub struct A;"),
                ("b.rs", "pub struct B; fn f() { g!(super::a::A) }"),
            ],
        );
        assert_eq!(circle.len(), 1);
        assert!(circle[0].contains("a.rs -> b.rs: B") && circle[0].contains("b.rs -> a.rs: A"), "{circle:?}");
    }

    #[test]
    fn re_exports_are_followed_to_the_definition() {
        let lib = "mod room;";
        let fine = [
            ("lib.rs", lib),
            ("room/mod.rs", "mod x; mod y; pub use x::X; pub use y::*;"),
            ("room/x.rs", "pub struct X;"),
            ("room/y.rs", "use super::X; pub struct Y;"),
        ];
        assert!(found("list", &fine).is_empty());
        // The index defines what its entries use, and uses them.
        let ring = [
            ("lib.rs", lib),
            ("room/mod.rs", "mod x; pub struct Low; pub fn all() { x::run() }"),
            ("room/x.rs", "use super::Low; pub fn run() {}"),
        ];
        assert_eq!(found("index", &ring).len(), 1);
    }

    #[test]
    fn a_name_re_exported_from_a_child_of_that_name_is_followed() {
        let files = [
            ("lib.rs", "mod data; mod room;"),
            ("data.rs", "pub use crate::room::x as write; pub struct Data;"),
            ("room/mod.rs", "mod x; pub use x::run as x;"),
            ("room/x.rs", "use crate::data::Data; pub fn run() {}"),
        ];
        assert_eq!(found("named", &files).len(), 1);
    }

    #[test]
    fn tests_and_other_crates_draw_no_arrow() {
        let files = [
            ("lib.rs", "mod a; mod b;"),
            ("a.rs", "use std::fmt; use crate::b::B; pub struct A; #[cfg(test)] mod tests { use super::A; }"),
            ("b.rs", "pub struct B; #[cfg(test)] mod tests { use crate::a::A; }"),
        ];
        assert!(found("tests", &files).is_empty());
    }

    #[test]
    fn folders_that_reach_each_other_through_other_files_are_a_circle_at_every_depth() {
        let files = [
            ("lib.rs", "mod top;"),
            ("top/mod.rs", "mod a; mod b; mod c;"),
            ("top/a/mod.rs", "mod x; mod y; pub use x::X;"),
            ("top/a/x.rs", "pub struct X;"),
            ("top/a/y.rs", "use crate::top::b::B; use crate::top::c::C;"),
            ("top/b.rs", "use super::a::X; pub struct B;"),
            ("top/c.rs", "pub struct C;"),
        ];
        assert!(found("through", &files).is_empty());
        let rooms = looked_at("rooms", &files, |folder| Graphs::read(folder).unwrap().of_rooms("crate"));
        assert_eq!(rooms.len(), 1);
        assert!(rooms[0].contains("top/a -> top/b: B") && !rooms[0].contains("top/c"));
    }
}
