//! The whole HTML page. All of it but the 3D stage can be read with scripts off.

mod data;
mod figure;
mod flags;
mod header;
pub mod parts;
mod policy;
pub mod symbols;
pub mod table;

pub use data::maps;

use super::number::Style;
use super::payload::Payload;
use super::picture::FirstView;
use super::subject::{Content, Drawn, Subject};
use super::values::Text;
use super::{ReportError, ReportInput, ReportOptions};
use data::{Data, MapEntry};
use maud::{Markup, PreEscaped, html};

/// The stored picture.
pub struct Picture {
    /// Base64 of a PNG.
    pub png: String,
    /// What it shows.
    pub view: FirstView,
}

/// What the middle of the page shows.
pub enum Stage<'a> {
    /// A part in space.
    Part(&'a Picture),
    /// A drawing in the plane, with as many measured points as so many bytes hold.
    Drawing(&'a dyn Drawn, usize),
}

/// The page around the payload and what is on its stage. `maps`: see [`maps`].
pub fn page(
    input: &ReportInput,
    payload: &Payload,
    on: &Stage,
    maps: &[MapEntry],
) -> Result<String, ReportError> {
    let (options, subject) = (input.options, input.result);
    let s = Style { language: options.language, decimal: options.decimal };
    let (first, class) = match on {
        Stage::Drawing(drawing, _) => (None, Some(format!("no-scale {}", drawing.classes()[0]))),
        Stage::Part(picture) if !picture.view.mapped => (Some(&picture.view), Some("no-scale".into())),
        Stage::Part(picture) => (Some(&picture.view), None),
    };
    let content = subject.content(s)?;
    let data = Data::of(input, payload, first, maps, &content.json)?;
    let page = html! {
        (PreEscaped("<!doctype html>\n"))
        html lang=(options.language.code()) {
            "\n" (head(s, options, &content)) "\n"
            body class=[class] {
                "\n" (header::header(s, options, &content))
                main {
                    "\n" (list(s, &content)) "\n"
                    @match on {
                        Stage::Part(picture) => { (stage(s, subject, content.picture, picture)) }
                        Stage::Drawing(drawing, room) => {
                            section id="stage" class={ "stage " (drawing.classes()[1]) } {
                                "\n" (drawing.draw(s, input.objects, options.up, *room))
                            }
                            "\n"
                        }
                    }
                    @if subject.scale().is_some() { aside id="scale" class="scale" hidden {} "\n" }
                }
                "\n" (header::status(s, &content, payload))
                (data)
                @if trueness_viewer::BUILT { script { (PreEscaped(trueness_viewer::SCRIPT)) } "\n" }
            }
            "\n"
        }
        "\n"
    };
    Ok(page.into_string())
}

fn head(s: Style, options: &ReportOptions, content: &Content) -> Markup {
    let (title, headline) = (header::title(options, content), content.headline);
    let running =
        policy::running_head(&[Some(title.as_str()), options.part.as_deref(), options.serial.as_deref()]);
    html! {
        head {
            "\n" meta charset="utf-8";
            "\n" (policy::meta(&running))
            "\n" meta name="viewport" content="width=device-width, initial-scale=1";
            "\n" meta name="color-scheme" content="light dark";
            "\n" meta name="referrer" content="no-referrer";
            "\n" title data-word={ "verdict." (headline.key) } data-name=(Text(&title)) {
                (Text(headline.word_in(s.language))) " · " (Text(&title))
            }
            "\n" style { (PreEscaped(trueness_viewer::STYLE)) }
            "\n" style { (PreEscaped(&running)) }
            "\n"
        }
    }
}

/// The list beside the stage, with the files and the method.
fn list(s: Style, content: &Content) -> Markup {
    let [schema, version, _] = content.marks;
    let method = html! {
        (content.method)
        p.note {
            "trueness " (Text(version)) " · " (Text(schema))
            @if let Some(seed) = content.seed { " · " (s.word("seed")) "\u{a0}" (seed) }
        }
    };
    html! {
        aside id="list" class="list" {
            "\n" (content.list)
            (parts::files(s, content.inputs)) (parts::section(s, "method", method))
        }
    }
}

/// The stored picture and the distribution under it; the script draws over the one and redraws the other.
fn stage(s: Style, subject: &dyn Subject, key: &'static str, picture: &Picture) -> Markup {
    let view = &picture.view;
    let histogram = subject.maps().first().and_then(|m| m.histogram);
    html! {
        section id="stage" class="stage" {
            "\n"
            img id="picture" class="picture" alt=(s.bare_word(key)) data-t-alt=(key)
                src={ "data:image/png;base64," (PreEscaped(&picture.png)) };
            "\n" (flags::flags(s, &subject.picks(), view, subject.scale())) (flags::hidden(s, view))
        }
        "\n"
        @if let Some(scale) = subject.scale() {
            // The colors of what the picture does not show would be taken for the picture's.
            figure id="figure" class="figure" hidden[!view.mapped] {
                (figure::figure(s, scale, histogram, subject.quantity()))
            }
            "\n"
        }
    }
}
