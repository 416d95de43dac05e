//! First sight: the verdict, what was looked at, the key numbers; and the line at the foot.

use super::super::ReportInput;
use super::super::number::Style;
use super::super::payload::Payload;
use super::super::values::{Name, Text};
use super::parts::{badge, file_name, role_key};
use maud::{Markup, html};
use trueness_document::Role;

/// The heading: the title given, else the document's own, else the part's name, else the first file's.
pub fn title(input: &ReportInput) -> String {
    let subject = input.result;
    let first = subject.head().inputs.first().map(|i| file_name(&i.path));
    let given = input.options.title.as_deref().or(subject.title()).or(input.options.part.as_deref());
    given.or(first).unwrap_or("trueness").to_string()
}

/// The header of the page.
pub fn header(s: Style, input: &ReportInput) -> Markup {
    let subject = input.result;
    let headline = subject.headline();
    html! {
        header class={ "header h-" (headline.tone.name()) } {
            "\n"
            div.row {
                h1 { (badge(s, headline)) }
                p.title { (Name(title(input))) }
                p.who { (who(s, input)) }
                p.unit {
                    (Text(subject.head().units))
                    @if let Some(key) = subject.convention() { " · " (s.word(key)) }
                }
                div id="tools" class="tools" {}
            }
            "\n" (identification(s, input))
            div id="numbers" class="numbers" { (subject.numbers(s)) }
            "\n"
        }
        "\n"
    }
}

/// The files and what they are. Of several references that of the comparison on the stage, and how many there are.
fn who(s: Style, input: &ReportInput) -> Markup {
    let files = input.result.head().inputs;
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

fn identification(s: Style, input: &ReportInput) -> Markup {
    let o = input.options;
    // Without a title the part's name is the heading already.
    let part = o.part.as_ref().filter(|p| **p != title(input));
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
pub fn status(s: Style, input: &ReportInput, payload: &Payload) -> Markup {
    let subject = input.result;
    let (shown, given) = payload.points;
    html! {
        footer.status {
            output id="readout" class="readout" {}
            p {
                @if given > 0 {
                    (s.word("shown")) " " (s.count(shown as u64)) " / "
                    (s.count(subject.points().unwrap_or(given as u64))) " " (s.word("points.of")) " · "
                }
                @if payload.simplified {
                    (s.word("simplified")) " ≤ " (s.number(1000.0 * payload.display_error, 1)) " µm · "
                }
                (subject.how(s)) " · trueness " (Text(subject.head().version))
            }
        }
        "\n"
    }
}
