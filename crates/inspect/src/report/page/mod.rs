//! The whole HTML page. All of it but the 3D stage can be read with scripts off.

pub mod blocks;
mod data;
mod figure;
mod flags;
mod header;
mod policy;
pub mod symbols;

pub use data::maps;

use super::documents::Drawn;
use super::html::{Html, escaped};
use super::number::Style;
use super::payload::Payload;
use super::picture::FirstView;
use super::{ReportError, ReportInput};
use serde_json::Value;

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
pub fn page(input: &ReportInput, payload: &Payload, on: &Stage, maps: &Value) -> Result<String, ReportError> {
    let (options, subject) = (input.options, input.result.subject());
    let mut h = Html::new(Style { language: options.language, decimal: options.decimal });
    h.raw("<!doctype html>\n<html lang=\"")
        .raw(options.language.code())
        .raw("\">\n<head>\n<meta charset=\"utf-8\">\n");
    let title = header::title(input);
    let running =
        policy::running_head(&[Some(title.as_str()), options.part.as_deref(), options.serial.as_deref()]);
    h.raw(&policy::meta(&running))
        .raw("\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    h.raw("<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"referrer\" content=\"no-referrer\">\n");
    let headline = subject.headline();
    h.raw(&format!("<title data-word=\"verdict.{}\" data-name=\"{}\">", headline.key, escaped(&title)));
    h.text(&format!("{} · {title}", headline.word_in(options.language)));
    h.raw("</title>\n<style>").raw(trueness_viewer::STYLE).raw("</style>\n");
    h.raw("<style>").raw(&running).raw("</style>\n</head>\n");
    let scale = subject.scale();
    match on {
        Stage::Drawing(drawing, _) => h.raw(&format!("<body class=\"no-scale {}\">\n", drawing.classes()[0])),
        Stage::Part(picture) if !picture.view.mapped => h.raw("<body class=\"no-scale\">\n"),
        Stage::Part(_) => h.raw("<body>\n"),
    };
    header::header(&mut h, input);
    h.raw("<main>\n<aside id=\"list\" class=\"list\">\n");
    subject.list(&mut h);
    blocks::files(&mut h, subject.head().inputs);
    blocks::section(&mut h, "method", |h| {
        subject.method(h);
        h.raw("<p class=\"note\">trueness ").text(subject.head().version).raw(" · ");
        h.text(subject.head().schema);
        if let Some(seed) = subject.seed() {
            h.raw(" · ").word("seed").raw("\u{a0}").text(&seed.to_string());
        }
        h.raw("</p>");
    });
    h.raw("</aside>\n");
    match on {
        Stage::Part(picture) => stage(&mut h, input, picture),
        Stage::Drawing(drawing, room) => {
            h.raw(&format!("<section id=\"stage\" class=\"stage {}\">\n", drawing.classes()[1]));
            drawing.draw(&mut h, input.objects, *room);
            h.raw("</section>\n");
        }
    }
    if scale.is_some() {
        h.raw("<aside id=\"scale\" class=\"scale\" hidden></aside>\n");
    }
    h.raw("</main>\n");
    header::status(&mut h, input, payload);
    let first = match on {
        Stage::Part(picture) => Some(&picture.view),
        Stage::Drawing(..) => None,
    };
    data::data(&mut h, input, payload, first, maps)?;
    if trueness_viewer::BUILT {
        h.raw("<script>").raw(trueness_viewer::SCRIPT).raw("</script>\n");
    }
    h.raw("</body>\n</html>\n");
    Ok(h.finish())
}

/// The stored picture and the distribution under it; the script draws over the one and redraws the other.
fn stage(h: &mut Html, input: &ReportInput, picture: &Picture) {
    let subject = input.result.subject();
    h.raw("<section id=\"stage\" class=\"stage\">\n<img id=\"picture\" class=\"picture\" alt=\"");
    h.text(super::text::word(subject.picture(), input.options.language));
    h.raw(&format!("\" data-t-alt=\"{}\" src=\"data:image/png;base64,", subject.picture()));
    h.raw(&picture.png).raw("\">\n");
    flags::flags(h, &subject.picks(), &picture.view, subject.scale());
    flags::hidden(h, &picture.view);
    h.raw("</section>\n");
    if let Some(scale) = subject.scale() {
        // The colors of what the picture does not show would be taken for the picture's.
        let hidden = if picture.view.mapped { "" } else { " hidden" };
        h.raw(&format!("<figure id=\"figure\" class=\"figure\"{hidden}>"));
        let histogram = subject.maps().first().and_then(|m| m.histogram);
        figure::figure(h, scale, histogram, subject.quantity());
        h.raw("</figure>\n");
    }
}
