//! Parts that the pages of all documents are made of.

use super::super::headline::Headline;
use super::super::number::Style;
use super::super::values::{Name, Text, leaf};
use maud::{Markup, Render, html};
use trueness_document::scale::palette::Rgb;
use trueness_document::{InputRecord, Role};

/// A headline as icon and word in its color.
pub fn badge(s: Style, headline: Headline) -> Markup {
    let Headline { key, tone } = headline;
    html! {
        span class={ "verdict v-" (tone.name()) } {
            span.icon aria-hidden="true" { (tone.icon()) } " " (s.word(format!("verdict.{key}")))
        }
    }
}

/// Last part of a path.
pub fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).find(|part| !part.is_empty()).unwrap_or(path)
}

/// A part of the list, under its heading.
pub fn section(s: Style, key: &str, body: impl Render) -> Markup {
    html! { section class={ "block b-" (key) } { h2 { (s.word(key)) } "\n" (body) } "\n" }
}

/// A name and what belongs to it, in a list of facts.
pub fn fact(s: Style, key: &str, value: impl Render) -> Markup {
    html! { dt { (s.word(key)) } dd { (value) } }
}

/// A key number under the verdict. `class`: `lead` for the first, `warn` for what needs care.
pub fn key_number(s: Style, key: &str, class: &str, value: impl Render) -> Markup {
    labeled_number(s.word(key), class, value)
}

/// The same with a label of its own.
pub fn labeled_number(label: impl Render, class: &str, value: impl Render) -> Markup {
    html! { div class=(class) { dt { (label) } dd { (value) } } }
}

/// The color of a kind, beside its name.
pub fn swatch([r, g, b]: Rgb) -> Markup {
    let fill = format!("#{r:02x}{g:02x}{b:02x}");
    html! {
        svg.swatch viewBox="0 0 10 10" aria-hidden="true" {
            (leaf("rect", &[("width", &10), ("height", &10), ("rx", &2), ("fill", &fill)]))
        }
    }
}

/// The heads of the last three columns of a table of places.
pub fn place_heads() -> Markup {
    html! { @for axis in ["x", "y", "z"] { th.r { (axis) } } }
}

/// A place as the last three cells of a row.
pub fn place_cells(s: Style, place: [f64; 3]) -> Markup {
    html! { @for x in place { td.r { (s.number(x, 2)) } } }
}

/// Numbers with the same between two of them.
pub fn series(s: Style, numbers: [f64; 3], between: &'static str, decimals: usize) -> Markup {
    html! {
        @for (k, x) in numbers.into_iter().enumerate() { @if k > 0 { (between) } (s.number(x, decimals)) }
    }
}

/// Rows of a list of places that are printed; the screen has all that are listed.
const PRINTED: usize = 12;

/// Class of row `n` of a list of places.
pub fn row_class(n: usize) -> Option<&'static str> {
    (n >= PRINTED).then_some("more")
}

/// Says on paper how many of `rows` are not printed.
pub fn not_printed(s: Style, rows: usize) -> Markup {
    html! {
        @if rows > PRINTED {
            p.note.paper { "+\u{a0}" (s.count((rows - PRINTED) as u64)) " " (s.word("more.not_printed")) }
        }
    }
}

/// Says how many of all are listed.
pub fn listed(s: Style, key: &str, shown: usize, total: u64) -> Markup {
    html! {
        @if (shown as u64) < total {
            p.note { (s.word(key)) " " (s.count(shown as u64)) " / " (s.count(total)) }
        }
    }
}

/// What a file is called on the page.
pub fn role_key(role: Role) -> &'static str {
    match role {
        Role::Measured => "measured",
        Role::Reference => "reference",
        Role::Mesh => "mesh",
    }
}

/// The files read; nothing where the document lists them itself.
pub fn files(s: Style, inputs: &[InputRecord]) -> Markup {
    if inputs.is_empty() {
        return Markup::default();
    }
    section(s, "files", html! { @for input in inputs { (file(s, input)) } })
}

fn file(s: Style, input: &InputRecord) -> Markup {
    let role = role_key(input.role);
    html! {
        div.file {
            p { span class={ "chip " (role) } { i {} (s.word(role)) } " " (Name(&input.path)) }
            p.note {
                (Text(&input.format)) " · " (s.count(input.bytes)) "\u{a0}B"
                // A drawing holds none.
                @if input.points > 0 {
                    " · " (s.count(input.points)) " "
                    (s.word(if input.facets.is_some() { "vertices" } else { "points" }))
                }
                @if let Some(facets) = input.facets { " · " (s.count(facets)) " " (s.word("facets")) }
                @if let Some(b) = &input.bounds {
                    " · " (series(s, std::array::from_fn(|k| b.max[k] - b.min[k]), "\u{2009}×\u{2009}", 3)) "\u{a0}mm"
                }
                " · " (s.word("unit_assumed")) " " (Text(&input.unit_assumed))
            }
            p.hash {
                @match &input.sha256 {
                    Some(hash) => { abbr { "SHA-256" } " " code { (Text(hash)) } }
                    None => { (Text(input.sha256_reason.as_deref().unwrap_or("–"))) }
                }
            }
            @for warning in &input.warnings { p.warning { "⚠ " (Text(warning)) } }
        }
    }
}
