//! Pieces that the pages of all documents are made of.

use super::super::html::{Html, escaped};
pub use super::headline::{Headline, Tone};
use crate::results::{InputRecord, Role};
use crate::scale::palette::Rgb;

/// A headline as icon and word in its colour.
pub fn badge(h: &mut Html, headline: Headline) {
    let Headline { key, tone } = headline;
    h.raw(&format!("<span class=\"verdict v-{}\"><span class=\"icon\" aria-hidden=\"true\">", tone.name()));
    h.raw(tone.icon()).raw("</span> ").word(&format!("verdict.{key}")).raw("</span>");
}

/// Last part of a path.
pub fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).find(|part| !part.is_empty()).unwrap_or(path)
}

/// A part of the list, under its heading.
pub fn section(h: &mut Html, key: &str, body: impl FnOnce(&mut Html)) {
    h.raw(&format!("<section class=\"block b-{key}\"><h2>")).word(key).raw("</h2>\n");
    body(h);
    h.raw("</section>\n");
}

/// A name and what belongs to it, in a list of facts.
pub fn fact(h: &mut Html, key: &str, body: impl FnOnce(&mut Html)) {
    h.raw("<dt>").word(key).raw("</dt><dd>");
    body(h);
    h.raw("</dd>");
}

/// A key number under the verdict. `class`: `lead` for the first, `warn` for what needs care.
pub fn key_number(h: &mut Html, key: &str, class: &str, value: impl FnOnce(&mut Html)) {
    h.raw(&format!("<div class=\"{class}\"><dt>")).word(key).raw("</dt><dd>");
    value(h);
    h.raw("</dd></div>");
}

/// The colour of a kind, beside its name.
pub fn swatch(h: &mut Html, [r, g, b]: Rgb) {
    h.raw(&format!(
        "<svg class=\"swatch\" viewBox=\"0 0 10 10\" aria-hidden=\"true\"><rect width=\"10\" height=\"10\" rx=\"2\" \
         fill=\"#{r:02x}{g:02x}{b:02x}\"/></svg>"
    ));
}

/// A place as the last three cells of a row.
pub fn place_cells(h: &mut Html, place: [f64; 3]) {
    for x in place {
        h.raw("<td class=\"r\">").number(x, 2, false).raw("</td>");
    }
}

/// Rows of a list of places that are printed; the screen has all that are listed.
const PRINTED: usize = 12;

/// Begins row `n` of a list of places, which leads to a pick.
pub fn pick_row(h: &mut Html, n: usize, pick: usize) {
    let class = if n < PRINTED { "" } else { " class=\"more\"" };
    h.raw(&format!("<tr data-pick=\"{pick}\"{class}>"));
}

/// Says on paper how many of `rows` are not printed.
pub fn not_printed(h: &mut Html, rows: usize) {
    if rows > PRINTED {
        h.raw("<p class=\"note paper\">+\u{a0}")
            .count((rows - PRINTED) as u64)
            .raw(" ")
            .word("more.not_printed");
        h.raw("</p>");
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
pub fn files(h: &mut Html, inputs: &[InputRecord]) {
    if inputs.is_empty() {
        return;
    }
    section(h, "files", |h| inputs.iter().for_each(|input| file(h, input)));
}

fn file(h: &mut Html, input: &InputRecord) {
    let role = role_key(input.role);
    h.raw(&format!("<div class=\"file\"><p><span class=\"chip {role}\"><i></i>")).word(role).raw("</span> ");
    h.name(&input.path).raw("</p><p class=\"note\">").text(&input.format).raw(" · ").count(input.bytes);
    let what = if input.facets.is_some() { "vertices" } else { "points" };
    h.raw("\u{a0}B · ").count(input.points).raw(" ").word(what);
    if let Some(facets) = input.facets {
        h.raw(" · ").count(facets).raw(" ").word("facets");
    }
    if let Some(b) = &input.bounds {
        h.raw(" · ");
        for k in 0..3 {
            h.raw(if k > 0 { "\u{2009}×\u{2009}" } else { "" }).number(b.max[k] - b.min[k], 3, false);
        }
        h.raw("\u{a0}mm");
    }
    h.raw(" · ").word("unit_assumed").raw(" ").text(&input.unit_assumed).raw("</p>");
    match &input.sha256 {
        Some(hash) => {
            h.raw(&format!("<p class=\"hash\"><abbr>SHA-256</abbr> <code>{}</code></p>", escaped(hash)))
        }
        None => h.raw("<p class=\"hash\">").text(input.sha256_reason.as_deref().unwrap_or("–")).raw("</p>"),
    };
    for warning in &input.warnings {
        h.raw("<p class=\"warning\">⚠ ").text(warning).raw("</p>");
    }
    h.raw("</div>");
}
