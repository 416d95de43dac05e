//! The residuals of a contour beside the length along it, as SVG.
//!
//! The axes are stretched to the room there is; the words stand around the figure, so that they are not.

use super::pieces::kind;
use crate::number::Style;
use crate::values::leaf;
use maud::{Markup, html};
use std::fmt::Write;
use trueness_document::section::{ContourRecord, JoinRecord};

/// Width of the figure, and half its height, in units of its own.
pub const COURSE_WIDTH: f64 = 1000.0;
pub const COURSE_HALF_HEIGHT: f64 = 100.0;
/// More points than this are drawn as their range over columns.
const MAX_COURSE_DOTS: usize = 6000;
/// Columns.
const COURSE_COLUMNS: usize = 1000;
/// Standard deviations that the figure shows at least.
const MIN_SHOWN_SIGMAS: f64 = 3.0;

/// Length and greatest distance that the figure shows.
struct Axes {
    length: f64,
    range: f64,
}

impl Axes {
    /// Outliers and points of segments astray do not widen it: they would make a line of all others.
    fn of(contour: &ContourRecord) -> Axes {
        let greatest = |counts: &dyn Fn(usize) -> bool| {
            let all = contour.residuals.iter().enumerate().filter(|(i, _)| counts(*i));
            all.map(|(_, r)| r.abs()).max_by(f64::total_cmp)
        };
        let outlier = |i: usize| contour.is_left_out(i);
        let followed = greatest(&|i| !outlier(i) && !astray(contour, i));
        // Scatter about segments astray is not that of the others.
        let range = match followed.filter(|_| !contour.astray.is_empty()) {
            Some(followed) => followed,
            None => greatest(&|i| !outlier(i)).unwrap_or(0.0).max(MIN_SHOWN_SIGMAS * contour.noise),
        };
        let range = if range > 0.0 { range } else { 1e-9 };
        Axes { length: contour.length.max(f64::MIN_POSITIVE), range: 1.05 * range }
    }

    fn x(&self, station: f64) -> f64 {
        (COURSE_WIDTH * station / self.length).clamp(0.0, COURSE_WIDTH)
    }

    fn y(&self, residual: f64) -> f64 {
        -COURSE_HALF_HEIGHT * residual / self.range
    }
}

/// Whether a point belongs to a segment that does not run along its points.
fn astray(contour: &ContourRecord, point: usize) -> bool {
    let label = contour.labels.get(point).map(|l| u64::from(*l));
    label.is_some_and(|label| contour.astray.contains(&label))
}

/// The figure of contour `number`; of several all but the first wait to be asked for. Its sign is told where the head of the page tells another.
pub fn course(s: Style, number: usize, contour: &ContourRecord, signed: bool) -> Markup {
    let axes = Axes::of(contour);
    let stations = contour.segments.iter().scan(0.0, |start, segment| {
        *start += segment.length;
        Some(*start)
    });
    html! {
        figure.course data-contour=(number) hidden[number > 0] {
            figcaption {
                (s.word("residuals")) ", mm · " (s.word("contour")) " " (number + 1)
                @if signed { " · " (s.word("sign.section")) }
                @if !contour.astray.is_empty() { " · " i.stroke.astray {} " " (s.word("legend.astray")) }
            }
            div.course-y {
                span { "+" (s.small(axes.range)) } span { "0" } span { "\u{2212}" (s.small(axes.range)) }
            }
            svg viewBox={ "0 " (-COURSE_HALF_HEIGHT) " " (COURSE_WIDTH) " " (2.0 * COURSE_HALF_HEIGHT) } preserveAspectRatio="none"
                data-length=(axes.length) data-range=(axes.range) role="img" {
                title { (s.bare_word("course.title")) }
                @for (join, station) in contour.joins.iter().zip(stations) { (interval(&axes, join, station)) }
                @for sigma in [-2.0, 2.0] {
                    (path("sigma", &format!("M0 {:.3}H{COURSE_WIDTH}", axes.y(sigma * contour.noise))))
                }
                (path("zero", &format!("M0 0H{COURSE_WIDTH}")))
                (points(&axes, contour))
            }
            div.course-x { span { "0" } (s.word("course.along")) (s.number(axes.length, 2)) }
        }
        "\n"
    }
}

fn path(class: &str, d: &str) -> Markup {
    leaf("path", &[("class", &class), ("d", &d)])
}

/// A join, and how far to either side it may lie. That of a corner lies across the contour too; its length is shown.
fn interval(axes: &Axes, join: &JoinRecord, station: f64) -> Markup {
    let far = |p: [f64; 2]| libm::hypot(p[0] - join.point[0], p[1] - join.point[1]);
    let [from, to] = [station - far(join.interval[0]), station + far(join.interval[1])].map(|s| axes.x(s));
    let [x, width] = [from, to - from].map(|x| format!("{x:.3}"));
    let (y, height) = (-COURSE_HALF_HEIGHT, 2.0 * COURSE_HALF_HEIGHT);
    html! {
        (leaf(
            "rect",
            &[("class", &"interval"), ("x", &x), ("y", &y), ("width", &width), ("height", &height)],
        ))
        (path("join", &format!("M{:.3} {}V{COURSE_HALF_HEIGHT}", axes.x(station), -COURSE_HALF_HEIGHT)))
    }
}

/// Points by the kind of their segment; those of none, and points of segments astray, at the rim where they are beyond it.
fn points(axes: &Axes, contour: &ContourRecord) -> Markup {
    let names = ["line", "arc", "spline", "astray", "outlier"];
    let mut paths = names.map(|k| (k, String::new()));
    let mut columns = vec![[None::<[f64; 2]>; 5]; COURSE_COLUMNS];
    let many = contour.residuals.len() > MAX_COURSE_DOTS;
    let all = contour.residuals.iter().zip(&contour.stations).zip(&contour.labels).enumerate();
    for (i, ((residual, station), label)) in all {
        let Some(segment) = contour.segments.get(*label as usize) else { continue };
        let outlier = contour.is_left_out(i);
        let name = match outlier {
            true => "outlier",
            false if astray(contour, i) => "astray",
            false => kind(segment),
        };
        let slot = paths.iter().position(|(k, _)| *k == name).unwrap_or(4);
        let (x, y) = (axes.x(*station), axes.y(*residual).clamp(-COURSE_HALF_HEIGHT, COURSE_HALF_HEIGHT));
        if many && !outlier {
            let column = ((x / COURSE_WIDTH * COURSE_COLUMNS as f64) as usize).min(COURSE_COLUMNS - 1);
            let range = columns[column][slot].get_or_insert([y, y]);
            *range = [range[0].min(y), range[1].max(y)];
        } else {
            let _ = write!(paths[slot].1, "M{x:.3} {y:.3}h0");
        }
    }
    for (n, column) in columns.iter().enumerate() {
        let x = (n as f64 + 0.5) * COURSE_WIDTH / COURSE_COLUMNS as f64;
        for (slot, range) in column.iter().enumerate() {
            if let Some([low, high]) = range {
                let _ = write!(paths[slot].1, "M{x:.2} {low:.3}V{high:.3}");
            }
        }
    }
    html! {
        @for (name, d) in paths.iter().filter(|(_, d)| !d.is_empty()) { (path(&format!("dots k-{name}"), d)) }
    }
}
