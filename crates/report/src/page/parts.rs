//! Parts that the pages of all documents are made of.

use super::super::headline::Headline;
use super::super::number::{Style, decimals};
use super::super::values::{Name, Number, Optional, Percent, Text, leaf};
use maud::{Markup, Render, html};
use trueness_document::compare::{Statistics, ToleranceShares};
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

/// Whether something is so, which needs care where it is not.
pub fn holds(s: Style, key: &str, holds: bool, [yes, no]: [&str; 2]) -> Markup {
    match holds {
        true => key_number(s, key, "", html! { "✓\u{a0}" (s.word(yes)) }),
        false => key_number(s, key, "warn", html! { "⚠\u{a0}" (s.word(no)) }),
    }
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

/// Numbers with the same between two of them.
pub fn series(s: Style, numbers: [f64; 3], between: &'static str, decimals: usize) -> Markup {
    html! {
        @for (k, x) in numbers.into_iter().enumerate() { @if k > 0 { (between) } (s.number(x, decimals)) }
    }
}

/// Two ends of a range.
pub fn range(from: impl Render, to: impl Render) -> Markup {
    html! { (from) "\u{2009}…\u{2009}" (to) }
}

/// A length.
pub fn mm(length: impl Render) -> Markup {
    html! { (length) "\u{a0}mm" }
}

/// A number with as many digits as its uncertainty has, and that.
pub fn with_uncertainty(s: Style, x: f64, u: Option<f64>) -> Markup {
    html! { (s.number(x, decimals(u, 4))) @if let Some(u) = u { "\u{a0}±\u{a0}" (s.small(u)) } }
}

/// Least and greatest value, with their signs.
pub fn extent(s: Style, of: &Statistics, decimals: usize) -> Markup {
    let value = |x| s.optional(x, decimals).signed();
    let [least, greatest] = [&of.min_reason, &of.max_reason].map(|reason| reason.as_deref());
    range(value(of.min).because(least), value(of.max).because(greatest))
}

/// The share of the points within tolerance.
pub fn inside<'a>(s: Style, t: &'a ToleranceShares) -> Optional<'a, Percent> {
    s.optional_percent(t.inside, 2).because(t.inside_reason.as_deref())
}

/// Between what most values lie.
pub fn most(s: Style, of: &Statistics, decimals: usize, signed: bool) -> Markup {
    let value = |x| s.optional(x, decimals).with_sign(signed);
    range(value(of.percentiles.p2_5), value(of.percentiles.p97_5))
}

/// The middle value, or why there is none.
pub fn median(s: Style, of: &Statistics, decimals: usize, signed: bool) -> Optional<'_, Number> {
    s.optional(of.median, decimals).with_sign(signed).because(of.median_reason.as_deref())
}

/// How many fail, are undecided, not measured and pass: the worst first, each with key and class of its number. The worst one leads, if
/// one of them is to.
pub fn verdicts(counts: [u64; 4], mut lead: bool) -> Vec<(&'static str, &'static str, u64)> {
    let words = ["verdict.fail", "verdict.undecided", "verdict.not_measured", "verdict.pass"];
    let all = words.into_iter().zip(["warn", "warn", "warn", ""]).zip(counts);
    let shown = all.filter(|((key, _), count)| *count > 0 || *key == "verdict.pass");
    shown
        .map(|((key, class), count)| {
            let leads = count > 0 && std::mem::take(&mut lead);
            (key, if leads { "lead" } else { class }, count)
        })
        .collect()
}

/// Words, a paragraph each.
pub fn paragraphs<K: AsRef<str>>(s: Style, keys: impl IntoIterator<Item = K>) -> Markup {
    html! { @for key in keys { p { (s.word(key)) } } }
}

/// Words in a line.
pub fn line<const N: usize>(s: Style, keys: [&str; N]) -> Markup {
    html! { @for (n, key) in keys.into_iter().enumerate() { @if n > 0 { " · " } (s.word(key)) } }
}

/// What makes a result doubtful.
pub fn warning(text: impl Render) -> Markup {
    html! { p.note { strong.warning { "⚠" } " " (text) } }
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
