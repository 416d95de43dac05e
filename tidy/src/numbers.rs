//! Numbers that decide something: those that stand in comparisons, and constants.
//!
//! What is compared by a method (`min`, `total_cmp`), a pattern or a range is not found, and nothing in macros whose words are no
//! expressions: the count is a measure of growth, not a list of all thresholds.

use super::modules::for_tests;
use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, ExprLit, Lit, Token, Type};

/// Literals that compare without a threshold: none, one, a pair, a half, the other way.
const PLAIN: [f64; 4] = [0.0, 0.5, 1.0, 2.0];

/// Types of numbers.
const NUMBERS: [&str; 14] =
    ["f32", "f64", "u8", "u16", "u32", "u64", "u128", "usize", "i8", "i16", "i32", "i64", "i128", "isize"];

/// What one file holds.
#[derive(Default)]
pub struct Numbers {
    /// Literals other than the plain ones, and constants, within comparisons.
    pub compared: usize,
    /// Names of the constants that are numbers, one for each definition.
    pub constants: Vec<String>,
    /// Whether the place that is visited lies within a comparison.
    inside: bool,
}

/// The numbers in a file's text; what is marked for tests is left out.
///
/// # Errors
/// A text that is not Rust.
pub fn of_text(text: &str) -> syn::Result<Numbers> {
    let mut numbers = Numbers::default();
    let file = syn::parse_file(text)?;
    if !for_tests(&file.attrs) {
        numbers.visit_file(&file);
    }
    Ok(numbers)
}

impl Numbers {
    fn constant(&mut self, name: &syn::Ident, of: &Type) {
        if is_number(of) {
            self.constants.push(name.to_string());
        }
    }
    /// Visits what does not belong to the comparison around it.
    fn apart(&mut self, visit: impl FnOnce(&mut Numbers)) {
        let inside = std::mem::take(&mut self.inside);
        visit(self);
        self.inside = inside;
    }
}

impl<'a> Visit<'a> for Numbers {
    fn visit_item(&mut self, item: &'a syn::Item) {
        if !for_tests(attributes(item)) {
            self.apart(|numbers| visit::visit_item(numbers, item));
        }
    }
    fn visit_impl_item_fn(&mut self, item: &'a syn::ImplItemFn) {
        if !for_tests(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }
    fn visit_item_const(&mut self, item: &'a syn::ItemConst) {
        self.constant(&item.ident, &item.ty);
        visit::visit_item_const(self, item);
    }
    fn visit_impl_item_const(&mut self, item: &'a syn::ImplItemConst) {
        self.constant(&item.ident, &item.ty);
        visit::visit_impl_item_const(self, item);
    }
    fn visit_trait_item_const(&mut self, item: &'a syn::TraitItemConst) {
        self.constant(&item.ident, &item.ty);
        visit::visit_trait_item_const(self, item);
    }
    fn visit_expr_binary(&mut self, expression: &'a syn::ExprBinary) {
        let compares = matches!(
            expression.op,
            BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Eq(_) | BinOp::Ne(_)
        );
        let inside = self.inside;
        self.inside |= compares;
        visit::visit_expr_binary(self, expression);
        self.inside = inside;
    }
    fn visit_block(&mut self, block: &'a syn::Block) {
        self.apart(|numbers| visit::visit_block(numbers, block));
    }
    fn visit_expr_closure(&mut self, closure: &'a syn::ExprClosure) {
        self.apart(|numbers| visit::visit_expr_closure(numbers, closure));
    }
    fn visit_expr_index(&mut self, expression: &'a syn::ExprIndex) {
        // Which element is compared decides nothing.
        self.visit_expr(&expression.expr);
        self.apart(|numbers| numbers.visit_expr(&expression.index));
    }
    fn visit_expr_lit(&mut self, literal: &'a ExprLit) {
        self.compared += usize::from(self.inside && value(literal).is_some_and(|v| !PLAIN.contains(&v)));
    }
    fn visit_expr_path(&mut self, path: &'a syn::ExprPath) {
        let names: Vec<String> = path.path.segments.iter().map(|part| part.ident.to_string()).collect();
        let of_format = names.first().is_some_and(|first| NUMBERS.contains(&first.as_str()));
        // The ends of a format limit nothing, but its rounding does.
        let is_constant = names.last().is_some_and(|last| is_loud(last) && (!of_format || last == "EPSILON"));
        self.compared += usize::from(self.inside && is_constant);
    }
    fn visit_macro(&mut self, call: &'a syn::Macro) {
        let words = call.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated);
        for expression in words.into_iter().flatten() {
            // The expressions end with this call: they are counted apart and added.
            let mut within = Numbers { inside: self.inside, ..Numbers::default() };
            within.visit_expr(&expression);
            self.compared += within.compared;
            self.constants.append(&mut within.constants);
        }
    }
}

/// The value of a number as it is written, without its sign.
fn value(literal: &ExprLit) -> Option<f64> {
    match &literal.lit {
        Lit::Int(number) => number.base10_parse().ok(),
        Lit::Float(number) => number.base10_parse().ok(),
        _ => None,
    }
}

/// The name of a constant: capitals, digits and underscores, beginning with a letter, longer than the name of a type's parameter.
fn is_loud(name: &str) -> bool {
    name.len() > 1
        && name.starts_with(|c: char| c.is_ascii_uppercase())
        && name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_')
}

/// Whether values of the type are numbers, or arrays and tuples of them alone.
fn is_number(of: &Type) -> bool {
    match of {
        Type::Path(path) => NUMBERS.iter().any(|name| path.path.is_ident(name)),
        Type::Array(array) => is_number(&array.elem),
        Type::Tuple(tuple) => !tuple.elems.is_empty() && tuple.elems.iter().all(is_number),
        _ => false,
    }
}

fn attributes(item: &syn::Item) -> &[syn::Attribute] {
    use syn::Item;
    match item {
        Item::Const(i) => &i.attrs,
        Item::Enum(i) => &i.attrs,
        Item::Fn(i) => &i.attrs,
        Item::Impl(i) => &i.attrs,
        Item::Macro(i) => &i.attrs,
        Item::Mod(i) => &i.attrs,
        Item::Static(i) => &i.attrs,
        Item::Struct(i) => &i.attrs,
        Item::Trait(i) => &i.attrs,
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compared(condition: &str) -> usize {
        of_text(&format!("fn f() {{ if {condition} {{}} }}")).unwrap().compared
    }

    #[test]
    fn what_limits_in_a_comparison_counts() {
        for (condition, expected) in [
            ("x < 3.0", 1),
            ("x <= 1e-9 * y", 1),
            ("x.abs() > FAR * sigma", 1),
            ("x > -7", 1),
            ("x < f64::EPSILON", 1),
            ("x < f64::INFINITY && y != u32::MAX", 0),
            ("x.min(3.0) != Self::FAR || y >= 12 * z", 3),
            ("matches(a == 4, b)", 1),
            ("assert!(a == 4, \"{}\", 5)", 1),
            // Once, though it lies within two comparisons.
            ("(x < 3.0) == y", 1),
            ("x == 0 && y > 1 && z < 2.0 && w > 0.5 && v == -1.0", 0),
            ("x[7] == y[8] && T == u", 0),
            ("x.any(|y| f(3.0)) == (5 + z < w)", 1),
            ("{ 5 } == z", 0),
            ("x + 3.0 * y", 0),
        ] {
            assert_eq!(compared(condition), expected, "{condition}");
        }
    }

    #[test]
    fn constants_that_are_numbers_count_wherever_they_stand() {
        let text = "const A: f64 = 1.0; pub const B: [u8; 2] = [1, 2]; const C: &str = \"\"; struct S;
            impl S { const D: usize = 3; } fn f() { const E: (i8, f32) = (1, 2.0); } mod m { const F: u64 = 1; }
            trait T { const G: u32; }";
        assert_eq!(of_text(text).unwrap().constants, ["A", "B", "D", "E", "F", "G"]);
    }

    #[test]
    fn tests_do_not_count() {
        let text =
            "#[cfg(test)] const A: f64 = 1.0; #[cfg(test)] mod tests { const B: u8 = 1; fn f() { x < 3.0; } }
            struct S; impl S { #[cfg(test)] fn f() { x < 3.0; } }";
        let numbers = of_text(text).unwrap();
        assert_eq!((numbers.compared, numbers.constants.len()), (0, 0));
        assert_eq!(of_text("#![cfg(test)] fn f() { x < 3.0; }").unwrap().compared, 0);
    }
}
