//! What a report draws of sections, in the plane: contours on a sheet for each plane, their residuals beside the length along them.

mod course;
pub mod nominal;
#[cfg(test)]
mod nominal_tests;
mod path;
pub mod pieces;
mod plan;
mod sheet;
#[cfg(test)]
mod tests;

use crate::number::Style;
use crate::subject::Drawn;
use crate::{Up, ViewObject};
use maud::{Markup, html};
use trueness_document::section::SectionDocument;

impl Drawn for SectionDocument {
    fn shown(&self, objects: &[ViewObject], up: Up, room: usize) -> (usize, usize) {
        let places = |o: &ViewObject| o.places().len();
        let stride = nominal::Rooms::of(self, objects, up, room).dots;
        let shown = stride.map_or(0, |stride| objects.iter().map(|o| places(o).div_ceil(stride)).sum());
        (shown, objects.iter().map(places).sum())
    }

    fn draw(&self, s: Style, objects: &[ViewObject], up: Up, room: usize) -> Markup {
        let rooms = nominal::Rooms::of(self, objects, up, room);
        // Teeth and whiskers at once are too much.
        let comb = if self.nominal.is_some() { " no-comb" } else { "" };
        html! {
            div id="drawing" class={ "drawing" (comb) } {
                "\n"
                @for (n, sheet) in plan::sheets(self).iter().enumerate() {
                    div.sheet data-plane=[sheet.plane] hidden[n > 0] {
                        "\n" (sheet.draw(s, self, objects, up, &rooms))
                    }
                    "\n"
                }
            }
            "\n"
            div id="courses" class="courses" {
                "\n"
                @for (n, contour) in self.contours.iter().enumerate() { (course::course(s, n, contour, self.nominal.is_some())) }
            }
            "\n"
        }
    }
}
