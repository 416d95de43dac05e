//! The whole HTML page. All of it but the 3D stage can be read with scripts off.

mod data;
mod figure;
mod header;
mod list;
mod policy;

use super::html::Html;
use super::number::Style;
use super::payload::Payload;
use super::{ReportError, ReportInput};

/// The page around the payload and the picture (base64 of a PNG).
pub fn page(input: &ReportInput, payload: &Payload, picture: &str) -> Result<String, ReportError> {
    let options = input.options;
    let mut h = Html::new(Style { language: options.language, decimal: options.decimal });
    h.raw("<!doctype html>\n<html lang=\"")
        .raw(options.language.code())
        .raw("\">\n<head>\n<meta charset=\"utf-8\">\n");
    h.raw(&policy::meta())
        .raw("\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    h.raw("<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"referrer\" content=\"no-referrer\">\n<title>");
    h.text(&format!(
        "{} · {}",
        header::verdict(input.result).word_in(options.language),
        header::title(input)
    ));
    h.raw("</title>\n<style>").raw(trueness_viewer::STYLE).raw("</style>\n</head>\n<body>\n");
    header::header(&mut h, input);
    h.raw("<main>\n");
    list::list(&mut h, input);
    stage(&mut h, input, picture);
    h.raw("<aside id=\"scale\" class=\"scale\" hidden></aside>\n</main>\n");
    header::status(&mut h, input, payload);
    data::data(&mut h, input, payload)?;
    if trueness_viewer::BUILT {
        h.raw("<script>").raw(trueness_viewer::SCRIPT).raw("</script>\n");
    }
    h.raw("</body>\n</html>\n");
    Ok(h.finish())
}

/// The stored picture and the distribution under it; the script draws over the one and redraws the other.
fn stage(h: &mut Html, input: &ReportInput, picture: &str) {
    h.raw("<section id=\"stage\" class=\"stage\">\n<img id=\"picture\" class=\"picture\" alt=\"");
    h.text(super::text::word("picture.alt", input.options.language));
    h.raw("\" src=\"data:image/png;base64,")
        .raw(picture)
        .raw("\">\n</section>\n<figure id=\"figure\" class=\"figure\">");
    figure::figure(h, input.result);
    h.raw("</figure>\n");
}
