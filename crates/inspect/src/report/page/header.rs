//! First sight: the verdict, what was looked at, the key numbers; and the line at the foot.

use super::super::ReportInput;
use super::super::html::Html;
use super::super::payload::Payload;
use super::blocks::{badge, file_name, role_key};
use crate::results::Role;

/// The heading: the title given, else the document's own, else the part's name, else the first file's.
pub fn title(input: &ReportInput) -> String {
    let subject = input.result.subject();
    let first = subject.head().inputs.first().map(|i| file_name(&i.path));
    let given = input.options.title.as_deref().or(subject.title()).or(input.options.part.as_deref());
    given.or(first).unwrap_or("trueness").to_string()
}

/// The header of the page.
pub fn header(h: &mut Html, input: &ReportInput) {
    let subject = input.result.subject();
    let headline = subject.headline();
    h.raw(&format!("<header class=\"header h-{}\">\n<div class=\"row\"><h1>", headline.tone.name()));
    badge(h, headline);
    h.raw("</h1><p class=\"title\">").name(&title(input)).raw("</p><p class=\"who\">");
    who(h, input);
    h.raw("</p><p class=\"unit\">").text(subject.head().units);
    if let Some(key) = subject.convention() {
        h.raw(" · ").word(key);
    }
    h.raw("</p><div id=\"tools\" class=\"tools\"></div></div>\n");
    identification(h, input);
    h.raw("<div id=\"numbers\" class=\"numbers\">");
    subject.numbers(h);
    h.raw("</div>\n</header>\n");
}

/// The files and what they are. Of several references that of the comparison on the stage, and how many there are.
fn who(h: &mut Html, input: &ReportInput) {
    let subject = input.result.subject();
    let files = subject.head().inputs;
    let references = files.iter().filter(|f| f.role == Role::Reference).count();
    let several = references > 1;
    let mut number = 0;
    for (n, file) in files.iter().enumerate() {
        let role = role_key(file.role);
        let one_of = several && file.role == Role::Reference;
        if n > 0 && !(one_of && number > 0) {
            h.raw("<span class=\"to\" aria-hidden=\"true\">↔</span>");
        }
        let comparison = if one_of { format!(" data-comparison=\"{number}\"") } else { String::new() };
        let hidden = if one_of && number > 0 { " hidden" } else { "" };
        h.raw(&format!("<span class=\"chip {role}\"{comparison}{hidden}><i></i>")).word(role).raw(" ");
        h.name(file_name(&file.path));
        if one_of {
            number += 1;
            h.raw(&format!("<span class=\"of\">{number} / {references}</span>"));
        }
        h.raw("</span>");
    }
}

fn identification(h: &mut Html, input: &ReportInput) {
    let o = input.options;
    // Without a title the part's name is the heading already.
    let part = o.part.as_ref().filter(|p| **p != title(input));
    let given = [("part", part), ("serial", o.serial.as_ref()), ("operator", o.operator.as_ref())];
    let mut given = given.into_iter().filter_map(|(key, value)| Some((key, value?))).peekable();
    if given.peek().is_none() {
        return;
    }
    h.raw("<p class=\"identification\">");
    for (key, value) in given {
        h.raw("<span>").word(key).raw(": ").name(value).raw("</span> ");
    }
    h.raw("</p>\n");
}

/// The line at the foot: what is shown, what was left out, how it was computed.
pub fn status(h: &mut Html, input: &ReportInput, payload: &Payload) {
    let subject = input.result.subject();
    h.raw("<footer class=\"status\"><output id=\"readout\" class=\"readout\"></output><p>");
    if payload.points.1 > 0 {
        let total = subject.points().unwrap_or(payload.points.1 as u64);
        h.word("shown").raw(" ").count(payload.points.0 as u64).raw(" / ").count(total);
        h.raw(" ").word("points.of").raw(" · ");
    }
    if payload.simplified {
        h.word("simplified").raw(" ≤ ").number(1000.0 * payload.display_error, 1, false).raw(" µm · ");
    }
    subject.how(h);
    h.raw(" · trueness ").text(subject.head().version).raw("</p></footer>\n");
}
