//! Which file defines what a path names.

use super::modules::Module;
use proc_macro2::{TokenStream, TokenTree};

/// The module that defines what `path` names when it is written in module `from`; `None` for other crates and for names
/// that this reading does not know.
pub fn definition(modules: &[Module], from: usize, path: &[String]) -> Option<usize> {
    resolve(modules, from, path, 0)
}

/// Re-exports followed before a path is given up: a ring of them has no end.
const DEEPEST: usize = 20;

fn resolve(modules: &[Module], from: usize, path: &[String], depth: usize) -> Option<usize> {
    let (first, rest) = path.split_first()?;
    if depth > DEEPEST {
        return None;
    }
    match first.as_str() {
        "crate" => inside(modules, 0, rest, depth),
        "self" => inside(modules, from, rest, depth),
        "super" => {
            let up = modules[from].parent?;
            // In `super::super` the second word is one of the module above, not a name in it.
            if rest.first().is_some_and(|s| s == "super") {
                resolve(modules, up, rest, depth + 1)
            } else {
                inside(modules, up, rest, depth)
            }
        }
        name if known(&modules[from], name) => inside(modules, from, path, depth),
        _ => modules[from].globs.iter().find_map(|glob| {
            let whole: Vec<String> = glob.iter().chain(path).cloned().collect();
            (glob.first() != path.first()).then(|| resolve(modules, from, &whole, depth + 1)).flatten()
        }),
    }
}

fn known(module: &Module, name: &str) -> bool {
    module.children.contains_key(name)
        || module.imports.contains_key(name)
        || module.items.iter().any(|i| i == name)
}

/// Follows `path` from within module `at`. A module itself is no definition: what is used of it is.
fn inside(modules: &[Module], at: usize, path: &[String], depth: usize) -> Option<usize> {
    let (name, rest) = path.split_first()?;
    let module = &modules[at];
    if let Some(&child) = module.children.get(name)
        && !rest.is_empty()
    {
        return inside(modules, child, rest, depth);
    }
    if module.items.contains(name) {
        return Some(at);
    }
    if let Some(import) = module.imports.get(name) {
        if import.first() == Some(name) && !module.children.contains_key(name) {
            return None; // the name of another crate
        }
        let whole: Vec<String> = import.iter().chain(rest).cloned().collect();
        return resolve(modules, at, &whole, depth + 1);
    }
    module.globs.iter().find_map(|glob| {
        let whole: Vec<String> = glob.iter().chain(path).cloned().collect();
        resolve(modules, at, &whole, depth + 1)
    })
}

/// All paths of two names or more that stand in `tokens`, within macros too.
pub fn written_in(tokens: &TokenStream, out: &mut Vec<Vec<String>>) {
    let mut path: Vec<String> = vec![];
    let mut colons = 0;
    for token in tokens.clone() {
        match token {
            TokenTree::Punct(p) if p.as_char() == ':' && !path.is_empty() => colons += 1,
            TokenTree::Ident(name) => {
                if colons != 2 {
                    end(&mut path, out);
                }
                path.push(name.to_string());
                colons = 0;
            }
            other => {
                end(&mut path, out);
                colons = 0;
                if let TokenTree::Group(group) = other {
                    written_in(&group.stream(), out);
                }
            }
        }
    }
    end(&mut path, out);
}

fn end(path: &mut Vec<String>, out: &mut Vec<Vec<String>>) {
    if path.len() > 1 {
        out.push(std::mem::take(path));
    }
    path.clear();
}
