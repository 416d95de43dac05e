//! The modules of a crate as its files declare them.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use syn::{Attribute, Item, Meta, UseTree};

/// A module: a file, or a part of one.
pub struct Module {
    /// The file it stands in, relative to the crate's source folder.
    pub file: PathBuf,
    /// The module that declares it; `None` for the root.
    pub parent: Option<usize>,
    /// Modules that it declares.
    pub children: BTreeMap<String, usize>,
    /// Names of the items that it defines.
    pub items: Vec<String>,
    /// Names that it imports, with the path of each as written.
    pub imports: BTreeMap<String, Vec<String>>,
    /// Paths of which it imports all names.
    pub globs: Vec<Vec<String>>,
    /// The tokens of its items, without imports and without modules.
    pub tokens: Vec<proc_macro2::TokenStream>,
}

/// All modules of the crate whose root is this file of the folder; the first is the root. Modules for tests are left out.
///
/// # Errors
/// A file that cannot be read or is not Rust.
pub fn of_crate(folder: &Path, root: &str) -> io::Result<Vec<Module>> {
    let mut modules = vec![];
    read_file(folder, Path::new(root), Path::new(""), None, &mut modules)?;
    Ok(modules)
}

/// Adds the module in `file`, whose children lie in the folder `below`; returns its number.
fn read_file(
    folder: &Path,
    file: &Path,
    below: &Path,
    parent: Option<usize>,
    modules: &mut Vec<Module>,
) -> io::Result<usize> {
    let text = fs::read_to_string(folder.join(file))?;
    let parsed = syn::parse_file(&text).map_err(|e| io::Error::other(format!("{}: {e}", file.display())))?;
    add(folder, file, below, parent, parsed.items, modules)
}

fn add(
    folder: &Path,
    file: &Path,
    below: &Path,
    parent: Option<usize>,
    items: Vec<Item>,
    modules: &mut Vec<Module>,
) -> io::Result<usize> {
    let number = modules.len();
    modules.push(Module {
        file: file.to_path_buf(),
        parent,
        children: BTreeMap::new(),
        items: vec![],
        imports: BTreeMap::new(),
        globs: vec![],
        tokens: vec![],
    });
    for item in items {
        match item {
            Item::Mod(m) if for_tests(&m.attrs) => {}
            Item::Mod(m) => {
                let name = m.ident.to_string();
                let inside = below.join(&name);
                let child = match m.content {
                    Some((_, items)) => add(folder, file, &inside, Some(number), items, modules)?,
                    None => {
                        let plain = below.join(format!("{name}.rs"));
                        let path = if folder.join(&plain).exists() { plain } else { inside.join("mod.rs") };
                        read_file(folder, &path, &inside, Some(number), modules)?
                    }
                };
                modules[number].children.insert(name, child);
            }
            Item::Use(u) if for_tests(&u.attrs) => {}
            Item::Use(u) => imports(&u.tree, &mut vec![], &mut modules[number]),
            item => {
                if let Some(name) = name_of(&item) {
                    modules[number].items.push(name);
                }
                modules[number].tokens.push(quote::quote!(#item));
            }
        }
    }
    Ok(number)
}

fn imports(tree: &UseTree, path: &mut Vec<String>, module: &mut Module) {
    match tree {
        UseTree::Path(p) => {
            path.push(p.ident.to_string());
            imports(&p.tree, path, module);
            path.pop();
        }
        UseTree::Name(n) if n.ident == "self" => {
            if let Some(last) = path.last() {
                module.imports.insert(last.clone(), path.clone());
            }
        }
        UseTree::Name(n) => {
            let name = n.ident.to_string();
            let whole = path.iter().cloned().chain([name.clone()]).collect();
            module.imports.insert(name, whole);
        }
        UseTree::Rename(r) => {
            let mut whole = path.clone();
            if r.ident != "self" {
                whole.push(r.ident.to_string());
            }
            // A trait imported `as _` has no name, but it is taken from its file all the same.
            let name =
                if r.rename == "_" { format!("_{}", module.imports.len()) } else { r.rename.to_string() };
            module.imports.insert(name, whole);
        }
        UseTree::Glob(_) => module.globs.push(path.clone()),
        UseTree::Group(g) => g.items.iter().for_each(|tree| imports(tree, path, module)),
    }
}

/// Whether something stands in tests alone.
pub fn for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|a| match &a.meta {
        Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        _ => false,
    })
}

/// The name that an item defines in its module; items marked for tests define none.
fn name_of(item: &Item) -> Option<String> {
    let (name, attributes) = match item {
        Item::Const(i) => (&i.ident, &i.attrs),
        Item::Enum(i) => (&i.ident, &i.attrs),
        Item::Fn(i) => (&i.sig.ident, &i.attrs),
        Item::Static(i) => (&i.ident, &i.attrs),
        Item::Struct(i) => (&i.ident, &i.attrs),
        Item::Trait(i) => (&i.ident, &i.attrs),
        Item::Type(i) => (&i.ident, &i.attrs),
        Item::Union(i) => (&i.ident, &i.attrs),
        Item::Macro(i) => (i.ident.as_ref()?, &i.attrs),
        _ => return None,
    };
    (!for_tests(attributes)).then(|| name.to_string())
}
