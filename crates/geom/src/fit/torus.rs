//! Ring tori.

use super::bent::Tube;
use super::family::{Element, Family, Rows};
use super::revolution::{Powers, Profile, directions};
use super::round::{MIN_DIVISOR, round_starts};
use super::sample::Sample;
use super::scatter::Scatter;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::{Point, Vector, unit};

/// Torus about the third axis of its frame; sizes: major and minor radius.
pub(super) struct Torus;

impl Family<7> for Torus {
    const LOCAL: [Local; 7] = [
        Local::Shift(0),
        Local::Shift(1),
        Local::Shift(2),
        Local::Tilt(0),
        Local::Tilt(1),
        Local::Size(0),
        Local::Size(1),
    ];

    #[inline(always)]
    fn rows(size: [f64; 2], [x, y, z]: Point, rows: &mut impl Rows<7>) {
        let rho = (x * x + y * y).sqrt();
        let inverse = 1.0 / rho.max(MIN_DIVISOR);
        let e = rho - size[0];
        let t = (e * e + z * z).sqrt();
        let other = 1.0 / t.max(MIN_DIVISOR);
        let (er, ez) = (e * other, z * other);
        let (nu, nv) = (er * x * inverse, er * y * inverse);
        rows.row(t - size[1], [-nu, -nv, -ez, ez * x - z * nu, ez * y - z * nv, -er, -1.0]);
    }
    #[inline(always)]
    fn distance(size: [f64; 2], [x, y, z]: Point) -> f64 {
        let e = (x * x + y * y).sqrt() - size[0];
        (e * e + z * z).sqrt() - size[1]
    }
    fn sound(size: [f64; 2]) -> bool {
        size[0] > 0.0 && size[1] > 0.0 && size[0].is_finite() && size[1].is_finite()
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let principal = Scatter::of(points).axes;
        let powers = Powers::of(points);
        // A piece of a torus often looks more like a cylinder about a wrong axis: no direction is left out
        // before its torus is known.
        let axes = [Profile::Parabola, Profile::Constant].map(|profile| powers.grid(profile, &principal));
        let mut starts = ranked(axes.into_iter().flatten().map(|axis| axis.pose), points, MAX_TORUS_STARTS);
        starts.extend(bent(&powers, &principal, points));
        starts
    }
    fn more_starts(points: &[Point]) -> Vec<Element> {
        // A short thick piece hardly determines its axis: try directions all around, near and far.
        const DIRECTIONS_AROUND: usize = 12;
        let scatter = Scatter::of(points);
        let frames = scatter.axes.into_iter().chain(directions()).flat_map(|w| {
            let frame = Pose::along(scatter.mean, w);
            (0..DIRECTIONS_AROUND).flat_map(move |k| {
                let (sin, cos) = libm::sincos(k as f64 / DIRECTIONS_AROUND as f64 * std::f64::consts::TAU);
                [0.3, 0.6, 1.0, 1.7, 3.0].map(|far| frame.moved([far * cos, far * sin, 0.0], [0.0; 2], 0.0))
            })
        });
        let judges: Vec<Point> = points.iter().copied().step_by(points.len().div_ceil(60)).collect();
        ranked(frames, &judges, 3 * MAX_TORUS_STARTS)
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        Shape::Torus {
            center: sample.place(element.pose.origin),
            direction: element.pose.axes[2],
            major_radius: element.size[0] / sample.scale,
            minor_radius: element.size[1] / sample.scale,
        }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Torus { center, direction, major_radius, minor_radius } = *shape else { return None };
        let (w, _) = unit(direction)?;
        let size = [major_radius * sample.scale, minor_radius * sample.scale];
        Some(Element { pose: Pose::along(sample.unit(center), w), size })
    }
}

/// Starts that are improved.
const MAX_TORUS_STARTS: usize = 16;
/// Bent tubes that are improved.
const MAX_TUBES: usize = 3;
/// Cylinders from which these tubes are bent.
const TUBE_CYLINDERS: usize = 6;
/// Most points on which tubes are improved.
const MAX_TUBE_POINTS: usize = 64;

/// Sum of the squared distances of the points from the torus, and the torus.
fn judged(element: Element, points: &[Point]) -> (f64, Element) {
    let square = points.iter().map(|&p| Torus::distance(element.size, element.pose.local(p)).powi(2)).sum();
    (square, element)
}

/// The `count` best of the tori.
fn best(mut all: Vec<(f64, Element)>, count: usize) -> Vec<Element> {
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.into_iter().take(count).map(|(_, element)| element).collect()
}

/// Cylinders that are bent: the starts of short pieces.
fn bent(powers: &Powers, principal: &[Vector; 3], points: &[Point]) -> Vec<Element> {
    let subset: Vec<Point> = points.iter().copied().step_by(points.len().div_ceil(MAX_TUBE_POINTS)).collect();
    let cylinders = powers.axes(Profile::Constant, principal, TUBE_CYLINDERS);
    let tubes =
        cylinders.iter().map(|axis| Tube::near(axis.pose, axis.radius_squared.sqrt(), &subset).torus());
    let sound = tubes.filter(|torus| Torus::sound(torus.size));
    best(sound.map(|torus| judged(torus, &subset)).filter(|t| t.0.is_finite()).collect(), MAX_TUBES)
}

/// The `count` best tori about the axes of the frames.
fn ranked(frames: impl Iterator<Item = Pose>, points: &[Point], count: usize) -> Vec<Element> {
    best(
        frames.flat_map(|frame| tori_about(&frame, points)).map(|torus| judged(torus, points)).collect(),
        count,
    )
}

/// Tori about the axis of `frame`: circles through height over distance from it.
fn tori_about(frame: &Pose, points: &[Point]) -> Vec<Element> {
    let section: Vec<Point> = points
        .iter()
        .map(|&p| {
            let [x, y, z] = frame.local(p);
            [libm::hypot(x, y), z, 0.0]
        })
        .collect();
    let circles = round_starts::<2>(&section, &Scatter::flat(&section)).into_iter();
    circles
        .map(|(c, radius)| {
            let pose = frame.moved([0.0, 0.0, c[1]], [0.0; 2], 0.0);
            Element { pose, size: [c[0], radius] }
        })
        .filter(|element| Torus::sound(element.size))
        .collect()
}
