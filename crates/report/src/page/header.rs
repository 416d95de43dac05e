//! First sight: the verdict, what was looked at, the key numbers; and the line at the foot.

use super::super::ReportOptions;
use super::super::number::Style;
use super::super::payload::Payload;
use super::super::subject::Content;
use super::super::values::{Name, Text};
use super::parts::{badge, file_name, role_key};
use maud::{Markup, html};
use trueness_document::{InputRecord, Role};

/// The heading: the title given, else the document's own, else the part's name, else the first file's.
pub fn title(options: &ReportOptions, content: &Content) -> String {
    let first = content.inputs.first().map(|i| file_name(&i.path));
    let given = options.title.as_deref().or(content.title).or(options.part.as_deref());
    given.or(first).unwrap_or("trueness").to_string()
}

/// The header of the page.
pub fn header(s: Style, options: &ReportOptions, content: &Content) -> Markup {
    let [_, _, units] = content.marks;
    html! {
        header class={ "header h-" (content.headline.tone.name()) } {
            "\n"
            div.row {
                h1 { (badge(s, content.headline)) }
                p.title { (Name(title(options, content))) }
                p.who { (who(s, content.inputs)) }
                p.unit {
                    (Text(units))
                    @if let Some(key) = content.convention { " · " (s.word(key)) }
                }
                div id="tools" class="tools" {}
            }
            "\n" (identification(s, options, content))
            div id="numbers" class="numbers" { (content.numbers) }
            "\n"
        }
        "\n"
    }
}

/// The files and what they are. Of several references that of the comparison on the stage, and how many there are.
fn who(s: Style, files: &[InputRecord]) -> Markup {
    let references = files.iter().filter(|f| f.role == Role::Reference).count();
    // Of each file its number among several references, if it is one of them.
    let numbers = files.iter().scan(0, |next, file| {
        let one_of = references > 1 && file.role == Role::Reference;
        *next += usize::from(one_of);
        Some(one_of.then(|| *next - 1))
    });
    html! {
        @for (n, (file, number)) in files.iter().zip(numbers).enumerate() {
            @let later = number.is_some_and(|number| number > 0);
            @if n > 0 && !later { span.to aria-hidden="true" { "↔" } }
            span class={ "chip " (role_key(file.role)) } data-comparison=[number] hidden[later] {
                i {} (s.word(role_key(file.role))) " " (Name(file_name(&file.path)))
                @if let Some(number) = number { span.of { (number + 1) " / " (references) } }
            }
        }
    }
}

fn identification(s: Style, o: &ReportOptions, content: &Content) -> Markup {
    // Without a title the part's name is the heading already.
    let part = o.part.as_ref().filter(|p| **p != title(o, content));
    let given = [("part", part), ("serial", o.serial.as_ref()), ("operator", o.operator.as_ref())];
    let given: Vec<(&str, &String)> =
        given.into_iter().filter_map(|(key, value)| Some((key, value?))).collect();
    html! {
        @if !given.is_empty() {
            p.identification {
                @for (key, value) in given { span { (s.word(key)) ": " (Name(value)) } " " }
            }
            "\n"
        }
    }
}

/// The line at the foot: what is shown, what was left out, how it was computed.
pub fn status(s: Style, content: &Content, payload: &Payload) -> Markup {
    let [_, version, _] = content.marks;
    let (shown, given) = payload.points;
    html! {
        footer.status {
            output id="readout" class="readout" {}
            p {
                @if given > 0 {
                    (s.word("shown")) " " (s.count(shown as u64)) " / "
                    (s.count(content.points.unwrap_or(given as u64))) " " (s.word("points.of")) " · "
                }
                @if payload.simplified {
                    (s.word("simplified")) " ≤ " (s.number(1000.0 * payload.display_error, 1)) " µm · "
                }
                (content.how) " · trueness " (Text(version))
            }
        }
        "\n"
    }
}
