//! Files of at most 500 lines, functions of at most 80.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{ImplItem, Item, TraitItem};

/// Lines of a file.
const FILE: usize = 500;
/// Lines of a function, from its signature to its closing brace; attributes and documentation are not counted.
const FUNCTION: usize = 80;

/// What is too long in the file `name` with this text.
///
/// # Errors
/// A text that is not Rust.
pub fn findings(name: &str, text: &str) -> Result<Vec<String>, String> {
    let file = syn::parse_file(text).map_err(|e| format!("{name}: {e}"))?;
    let lines = text.lines().count();
    let mut found = vec![];
    if lines > FILE {
        found.push(format!("{name}: {lines} lines; a file has at most {FILE}"));
    }
    let mut functions = vec![];
    file.items.iter().for_each(|item| functions_of(item, &mut functions));
    for (what, start, end) in functions {
        let (first, last) = (start.start().line, end.end().line);
        let lines = last - first + 1;
        if lines > FUNCTION {
            found.push(format!(
                "{name}:{first}: `{what}` has {lines} lines; a function has at most {FUNCTION}"
            ));
        }
    }
    Ok(found)
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

    #[test]
    fn long_functions_and_files_are_named_with_their_line() {
        let body = "    x();\n".repeat(79);
        let text = format!("mod a {{\nimpl B {{\n/// Text.\nfn c() {{\n{body}}}\n}}\n}}\n");
        assert_eq!(findings("d.rs", &text).unwrap(), ["d.rs:4: `c` has 81 lines; a function has at most 80"]);
        assert!(findings("d.rs", &text.replacen("    x();\n", "", 1)).unwrap().is_empty());
        assert_eq!(findings("d.rs", &"\n".repeat(501)).unwrap().len(), 1);
        assert!(findings("d.rs", &"\n".repeat(500)).unwrap().is_empty());
    }
}
