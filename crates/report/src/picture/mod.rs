//! The picture that is stored in the report: for readers without WebGL, and for print.
//!
//! A plain software rasterizer. Like the script's, it colors each pixel from the value interpolated there.

mod camera;
mod canvas;
mod direction;
mod edges;
mod overlay;
mod paint;
mod png;

pub use direction::{flagged, others, reached};

use super::shown::{mapped, shown_objects};
use super::subject::Pick;
use super::{Geometry, ReportInput, ViewRole};
use camera::Camera;
use canvas::{Canvas, SAMPLES_PER_PIXEL};
use paint::{Colors, Paint};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, Vector};

const PICTURE_WIDTH: u32 = 1200;
const PICTURE_HEIGHT: u32 = 900;
/// Room for the flags on the left and on the right, where there are any.
const FLAG_ROOM: u32 = 170;
/// The same for the frames of characteristics.
const FRAME_ROOM: u32 = 250;
/// How the report is looked at first: the direction, and where the picks lie in the stored picture.
pub struct FirstView {
    /// From the part to the eye, of length 1.
    pub toward: Vector,
    /// The picks that it was chosen for, most important first, and whether each is hidden.
    pub places: Vec<(usize, bool)>,
    /// For each pick, whether it lies so far off that it is not on the part.
    pub off: Vec<bool>,
    /// For each pick that may have a flag in this view, whether it is hidden.
    pub hidden: Vec<bool>,
    /// For each pick, where its leader ends.
    pub ends: Vec<Point>,
    /// For each pick, whether its value is reached where its leader ends.
    pub reached: Vec<bool>,
    /// Whether it shows values as colors, and so flags.
    pub mapped: bool,
    camera: Camera,
}

impl FirstView {
    /// Of a report with these picks.
    pub fn of(input: &ReportInput, picks: &[Pick]) -> FirstView {
        let direction::Direction { toward, places, off, hidden, ends, reached } =
            direction::direction(input, picks);
        let shown = shown_objects(input.objects);
        let mapped = mapped(&shown);
        let finite = |p: &&Point| p.iter().all(|x| x.is_finite());
        let flagged = flagged(picks, mapped);
        let beside = flagged.iter().filter(|n| off[**n]).map(|n| &picks[*n].position);
        let all = shown.iter().flat_map(|o| o.places()).chain(beside).filter(finite);
        let margin = match flagged.is_empty() {
            true => 0,
            false if mapped => FLAG_ROOM,
            false => FRAME_ROOM,
        };
        let camera = Camera::first_view(
            all,
            input.options.up,
            toward,
            [PICTURE_WIDTH, PICTURE_HEIGHT, margin].map(|n| SAMPLES_PER_PIXEL * n),
        );
        FirstView { toward, places, off, hidden, ends, reached, mapped, camera }
    }

    /// Width and height of the picture in pixels.
    pub const SIZE: [u32; 2] = [PICTURE_WIDTH, PICTURE_HEIGHT];

    /// Where a place lies in the picture, pixels from the top left.
    pub fn pixel(&self, place: &Point) -> [f64; 2] {
        let [x, y, _] = self.camera.project(place);
        [x, y].map(|x| x / f64::from(SAMPLES_PER_PIXEL))
    }
}

/// The first view of a report as a PNG on a transparent ground. `progress` hears of the places of all objects.
pub fn png(input: &ReportInput, view: &FirstView, progress: &dyn Progress) -> Result<Vec<u8>, Cancelled> {
    let (objects, camera) = (input.objects, &view.camera);
    let scale = input.result.scale();
    let mut canvas = Canvas::new(SAMPLES_PER_PIXEL * PICTURE_WIDTH, SAMPLES_PER_PIXEL * PICTURE_HEIGHT);
    for object in shown_objects(objects) {
        let paint = Paint {
            base: object.color(),
            edges: object.faces.map(|faces| faces.drawn.edges.as_slice()),
            values: object.field(0).map(|f| f.values).zip(scale.map(Colors::of)),
        };
        match object.geometry {
            // Translucent things are there as their outlines, which are marks.
            Geometry::Mesh(_) if object.role == ViewRole::Element => {}
            Geometry::Mesh(mesh) => canvas.mesh(mesh, &paint, camera, progress)?,
            Geometry::Points(points) => canvas.points(points, &paint, camera, progress)?,
        }
    }
    progress.advance(objects.iter().map(|o| o.places().len() as u64).sum());
    // The first marks lie over the others.
    for marks in input.marks.iter().filter(|m| m.shown()).rev() {
        let all: Vec<_> = marks.colored().collect();
        for (mark, color) in all.into_iter().rev() {
            overlay::draw(&mut canvas, mark, color, camera, marks.role.shows_through());
        }
    }
    Ok(png::encode(PICTURE_WIDTH, PICTURE_HEIGHT, &canvas.reduced()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a flag is hidden costs a search of all that is drawn: of thousands of rows only the first are asked.
    #[test]
    fn only_the_first_of_many_have_flags() {
        let valued = |n: u32| Pick { value: n.is_multiple_of(2).then_some(f64::from(n)), ..Pick::default() };
        let picks: Vec<Pick> = (0..5000).map(valued).collect();
        let found = flagged(&picks, true);
        assert_eq!((found.len(), found[0], found[1], found[199]), (200, 0, 2, 398));
        assert_eq!(flagged(&picks[..7], true), [0, 2, 4, 6]);
        assert!(flagged(&picks, false).is_empty());
    }
}
