//! The head of the tables.

use crate::number::Style;
use maud::{Markup, html};

/// The head of a table: two columns without a name, then these.
pub(super) fn head(s: Style, words: &[&str]) -> Markup {
    html! {
        thead {
            tr {
                th {} th {}
                // Coordinates are called the same in all languages.
                @for word in words { th.r { @if word.len() == 1 { (word) } @else { (s.word(word)) } } }
            }
        }
    }
}
