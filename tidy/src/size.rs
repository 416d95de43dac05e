//! Files of at most 500 lines, functions of at most 80; those from 400 and from 60 are told.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{ImplItem, Item, TraitItem};

/// Lines that are told, and lines that there may be at most.
struct Cap {
    told: usize,
    most: usize,
}

/// Lines of a file.
const FILE: Cap = Cap { told: 400, most: 500 };
/// Lines of a function, from its signature to its closing brace; attributes and documentation are not counted.
const FUNCTION: Cap = Cap { told: 60, most: 80 };

/// A file or function that is long.
pub struct Long {
    /// What it is, and its lines.
    pub text: String,
    /// Its lines as a share of those that it may have.
    pub share: f64,
    /// Whether it is a function.
    pub is_function: bool,
}

impl Long {
    /// Whether it is too long.
    pub fn is_failure(&self) -> bool {
        self.share > 1.0
    }
}

/// What is long in the file `name` with this text.
///
/// # Errors
/// A text that is not Rust.
pub fn findings(name: &str, text: &str) -> Result<Vec<Long>, String> {
    let file = syn::parse_file(text).map_err(|e| format!("{name}: {e}"))?;
    let mut found: Vec<Long> = long(name, text.lines().count(), &FILE, false).into_iter().collect();
    let mut functions = vec![];
    file.items.iter().for_each(|item| functions_of(item, &mut functions));
    for (what, start, end) in functions {
        let (first, last) = (start.start().line, end.end().line);
        found.extend(long(&format!("{name}:{first}: `{what}`"), last - first + 1, &FUNCTION, true));
    }
    Ok(found)
}

fn long(name: &str, lines: usize, cap: &Cap, is_function: bool) -> Option<Long> {
    let what = if is_function { "function" } else { "file" };
    let text = format!("{name}: {lines} lines; a {what} has at most {}", cap.most);
    (lines >= cap.told).then(|| Long { text, share: lines as f64 / cap.most as f64, is_function })
}

/// What the long files and functions that may be are told as: their number, and the ten longest or all.
pub fn summary(mut long: Vec<Long>, verbose: bool) -> Vec<String> {
    const SHOWN: usize = 10;
    long.sort_by(|a, b| b.share.total_cmp(&a.share));
    let functions = long.iter().filter(|one| one.is_function).count();
    let counts = format!(
        "{} files have {} lines or more, {functions} functions {} or more",
        long.len() - functions,
        FILE.told,
        FUNCTION.told
    );
    let shown = if verbose { long.len() } else { SHOWN };
    let longest = long.into_iter().take(shown).map(|one| format!("    {}", one.text));
    [counts].into_iter().chain(longest).collect()
}

/// Name, first and last token of each function in an item.
fn functions_of(item: &Item, out: &mut Vec<(String, Span, Span)>) {
    match item {
        Item::Fn(f) => out.push((f.sig.ident.to_string(), f.sig.span(), f.block.span())),
        Item::Impl(i) => {
            for item in &i.items {
                if let ImplItem::Fn(f) = item {
                    out.push((f.sig.ident.to_string(), f.sig.span(), f.block.span()));
                }
            }
        }
        Item::Trait(t) => {
            for item in &t.items {
                if let TraitItem::Fn(f) = item
                    && let Some(block) = &f.default
                {
                    out.push((f.sig.ident.to_string(), f.sig.span(), block.span()));
                }
            }
        }
        Item::Mod(m) => {
            m.content.iter().flat_map(|(_, items)| items).for_each(|item| functions_of(item, out))
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is found, and whether it fails.
    fn found(text: &str) -> Vec<(String, bool)> {
        findings("d.rs", text).unwrap().into_iter().map(|one| (one.text.clone(), one.is_failure())).collect()
    }

    fn function(lines: usize) -> String {
        let body = "    x();\n".repeat(lines - 2);
        format!("mod a {{\nimpl B {{\n/// Text.\nfn c() {{\n{body}}}\n}}\n}}\n")
    }

    #[test]
    fn long_functions_and_files_are_named_with_their_line() {
        let told = |lines| format!("d.rs:4: `c`: {lines} lines; a function has at most 80");
        assert_eq!(found(&function(81)), [(told(81), true)]);
        assert_eq!(found(&function(80)), [(told(80), false)]);
        assert_eq!(found(&function(60)), [(told(60), false)]);
        assert!(found(&function(59)).is_empty());
        let told = |lines| format!("d.rs: {lines} lines; a file has at most 500");
        assert_eq!(found(&"\n".repeat(501)), [(told(501), true)]);
        assert_eq!(found(&"\n".repeat(500)), [(told(500), false)]);
        assert_eq!(found(&"\n".repeat(400)), [(told(400), false)]);
        assert!(found(&"\n".repeat(399)).is_empty());
    }

    #[test]
    fn the_longest_are_told_first_and_all_on_request() {
        let many =
            || (60..75).flat_map(|lines| findings("d.rs", &function(lines)).unwrap()).collect::<Vec<_>>();
        let short = summary(many(), false);
        assert_eq!(short[0], "0 files have 400 lines or more, 15 functions 60 or more");
        assert!(
            short.len() == 11 && short[1].contains("74 lines") && short[10].contains("65 lines"),
            "{short:?}"
        );
        assert_eq!(summary(many(), true).len(), 16);
    }
}
