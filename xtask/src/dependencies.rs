//! What the workspace depends on: every licence is one of those that `deny.toml` allows, and no crate comes in two versions but those
//! that it names. cargo-deny, where it is installed, reads the same tables and knows advisories as well.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Checks licences and doubles; says what is wrong and `false`.
pub fn run(root: &Path) -> bool {
    match findings(root) {
        Ok(found) => {
            found.iter().for_each(|line| eprintln!("{line}"));
            found.is_empty()
        }
        Err(e) => {
            eprintln!("{e}");
            false
        }
    }
}

/// Runs cargo-deny, if it is installed; what it cannot do is told.
pub fn deny(root: &Path) -> bool {
    let deny = |word| Command::new(env!("CARGO")).args(["deny", word]).current_dir(root).output();
    if !deny("--version").is_ok_and(|o| o.status.success()) {
        println!("SKIPPED: advisories. There is no cargo-deny (`cargo install --locked cargo-deny`).");
        return !crate::requires_all();
    }
    deny("check").is_ok_and(|o| {
        eprintln!("{}", String::from_utf8_lossy(&o.stderr));
        o.status.success()
    })
}

fn findings(root: &Path) -> Result<Vec<String>, String> {
    let settings = fs::read_to_string(root.join("deny.toml")).map_err(|e| format!("deny.toml: {e}"))?;
    let lock = fs::read_to_string(root.join("Cargo.lock")).map_err(|e| format!("Cargo.lock: {e}"))?;
    let words =
        ["tree", "--workspace", "--all-features", "--target=all", "--edges=normal,build,dev", "--locked"];
    let o = Command::new(env!("CARGO"))
        .args(words)
        .args(["--prefix=none", "--format={p}\t{l}"])
        .current_dir(root)
        .output()
        .map_err(|e| format!("cargo: {e}"))?;
    if !o.status.success() {
        return Err(String::from_utf8_lossy(&o.stderr).into_owned());
    }
    let packages = String::from_utf8_lossy(&o.stdout).into_owned();
    Ok([unlicensed(&packages, &entries(&settings, "allow")), doubled(&lock, &entries(&settings, "skip"))]
        .concat())
}

/// The entries of a list of `deny.toml`, which has one a line.
fn entries<'a>(settings: &'a str, list: &str) -> BTreeSet<&'a str> {
    let open = format!("{list} = [");
    let inside = settings.lines().skip_while(|line| *line != open).skip(1).take_while(|line| *line != "]");
    inside.filter_map(|line| line.split('"').nth(1)).collect()
}

/// Packages with a licence that is not allowed; a line has the package, a tab and its licence.
fn unlicensed(packages: &str, allowed: &BTreeSet<&str>) -> Vec<String> {
    let lines: BTreeSet<&str> = packages.lines().map(|line| line.trim_end_matches(" (*)")).collect();
    let mut found = vec![];
    for (package, licence) in lines.into_iter().filter_map(|line| line.split_once('\t')) {
        // The project's own stand in a folder, which is told behind the version.
        let from = package.split_once(" (").map_or("proc-macro)", |(_, from)| from);
        let is_own = from != "proc-macro)" && !from.contains("://");
        if !is_own && !is_allowed(licence, allowed) {
            found.push(format!("{package}: the licence `{licence}` is not allowed by deny.toml"));
        }
    }
    found
}

/// Whether an expression can be met by allowed licences. In the old way of writing a slash is an `OR`.
fn is_allowed(expression: &str, allowed: &BTreeSet<&str>) -> bool {
    let plain = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let mut words = plain.split_whitespace().peekable();
    let met = either(&mut words, allowed);
    met && words.next().is_none()
}

/// Words of an expression.
type Words<'a> = std::iter::Peekable<std::str::SplitWhitespace<'a>>;

fn either(words: &mut Words, allowed: &BTreeSet<&str>) -> bool {
    let mut met = both(words, allowed);
    while words.next_if_eq(&"OR").is_some() {
        met |= both(words, allowed);
    }
    met
}

fn both(words: &mut Words, allowed: &BTreeSet<&str>) -> bool {
    let mut met = one(words, allowed);
    while words.next_if_eq(&"AND").is_some() {
        met &= one(words, allowed);
    }
    met
}

fn one(words: &mut Words, allowed: &BTreeSet<&str>) -> bool {
    if words.next_if_eq(&"(").is_some() {
        return either(words, allowed) & words.next_if_eq(&")").is_some();
    }
    let Some(id) = words.next() else { return false };
    // With an exception it is a licence of another name.
    match words.next_if_eq(&"WITH") {
        Some(_) => {
            let exception = words.next().unwrap_or_default();
            allowed.contains(format!("{id} WITH {exception}").as_str())
        }
        None => allowed.contains(id),
    }
}

/// Crates of which the lock file holds more versions than are named, and names that are not needed.
fn doubled(lock: &str, skipped: &BTreeSet<&str>) -> Vec<String> {
    let mut versions: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut name = "";
    for line in lock.lines() {
        if let Some(found) = line.strip_prefix("name = ") {
            name = found.trim_matches('"');
        } else if let Some(version) = line.strip_prefix("version = ").filter(|_| !name.is_empty()) {
            versions.entry(name).or_default().push(version.trim_matches('"'));
            name = "";
        }
    }
    let is_named = |name: &str, version: &&&str| skipped.contains(format!("{name}@{version}").as_str());
    let mut found = vec![];
    for (name, all) in &versions {
        let left: Vec<&&str> = all.iter().filter(|version| !is_named(name, version)).collect();
        if left.len() > 1 {
            found.push(format!("{name}: the versions {left:?}; have one, or name the older in deny.toml"));
        }
    }
    for named in skipped {
        let (name, version) = named.split_once('@').unwrap_or((named, ""));
        if !versions.get(name).is_some_and(|all| all.len() > 1 && all.contains(&version)) {
            found.push(format!("{named}: is no double any more; take its line out of deny.toml"));
        }
    }
    found
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const SETTINGS: &str = "[licenses]\nallow = [\n    \"MIT\",\n    \"Zlib\",\n]\nskip = [\n    { crate = \"a@1.0.0\", reason = \"b\" },\n]\n";

    #[test]
    fn expressions_are_met_or_not() {
        let allowed = entries(SETTINGS, "allow");
        assert_eq!(allowed, BTreeSet::from(["MIT", "Zlib"]));
        for (expression, met) in [
            ("MIT", true),
            ("MIT OR GPL-3.0", true),
            ("GPL-3.0/MIT", true),
            ("MIT AND GPL-3.0", false),
            ("(GPL-3.0 OR MIT) AND Zlib", true),
            ("(GPL-3.0 OR MIT) AND X", false),
            ("X OR MIT AND Zlib", true),
            ("MIT WITH exception", false),
            ("MIT WITH exception OR Zlib", true),
            ("(MIT", false),
            ("MIT Zlib", false),
            ("", false),
        ] {
            assert_eq!(is_allowed(expression, &allowed), met, "{expression}");
        }
    }

    #[test]
    fn packages_of_others_need_a_licence() {
        let packages = "own v1 (/home/own)\t\na v1\tMIT\nb v1 (proc-macro)\tGPL\nb v1 (proc-macro)\tGPL (*)\nc v1\t\n\
            d v1 (https://d)\tGPL\n";
        let found = unlicensed(packages, &entries(SETTINGS, "allow"));
        let named: Vec<&str> = found.iter().filter_map(|line| line.split(' ').next()).collect();
        assert_eq!(named, ["b", "c", "d"], "{found:?}");
        assert!(found[0].contains("the licence `GPL` is not allowed"), "{found:?}");
    }

    #[test]
    fn doubles_are_named_and_names_are_needed() {
        let package =
            |name: &str, version: &str| format!("[[package]]\nname = \"{name}\"\nversion = \"{version}\"\n");
        let lock = |all: &[(&str, &str)]| {
            let packages: Vec<String> = all.iter().map(|(name, version)| package(name, version)).collect();
            format!("version = 4\n\n{}", packages.join("\n"))
        };
        let skip = entries(SETTINGS, "skip");
        let found = |all: &[(&str, &str)]| doubled(&lock(all), &skip);
        assert!(found(&[("a", "1.0.0"), ("a", "2.0.0"), ("b", "1.0.0")]).is_empty());
        let three = found(&[("a", "1.0.0"), ("a", "2.0.0"), ("a", "3.0.0")]);
        assert!(three.len() == 1 && three[0].contains("[\"2.0.0\", \"3.0.0\"]"), "{three:?}");
        let other = found(&[("a", "1.0.0"), ("b", "1.0.0"), ("b", "2.0.0")]);
        assert!(
            other.len() == 2 && other[0].starts_with("b:") && other[1].starts_with("a@1.0.0"),
            "{other:?}"
        );
    }
}
