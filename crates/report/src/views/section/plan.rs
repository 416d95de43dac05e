//! What is drawn of a plane, where it lies on its sheet, and how large it is.

use super::path::{Path, Tooth, teeth};
use crate::Up;
use trueness_document::section::{ContourRecord, FrameRecord, OutlineRecord, SectionDocument};
use trueness_geom::space::dot;

/// Length of the longest tooth of the comb, and of the longest whisker, in sizes of the drawing.
const MAX_COMB_SHARE: f64 = 0.1;
/// Distance between teeth, in sizes of the drawing.
const TOOTH_STEP: f64 = 1.0 / 150.0;
/// Width of what is seen, in widths of the drawing: signs and numbers at the rim have room.
const SHEET_MARGIN: f64 = 1.12;
/// Pixels that the drawing is taken to be wide until the script measures it.
const ASSUMED_PIXELS: f64 = 800.0;
/// A nominal that makes the drawing more than so many times larger is left to be looked for: what was measured would be a speck.
const MAX_NOMINAL_FACTOR: f64 = 3.0;
/// An axis that leans less out of being normal to the plane points nowhere in it: sine of the angle.
const MIN_LEAN_SINE: f64 = 0.1;

/// What is drawn of one plane.
pub struct Sheet<'a> {
    /// Number of the plane; of points in order none.
    pub plane: Option<u64>,
    /// Its contours, with their numbers in the document.
    pub contours: Vec<(usize, &'a ContourRecord)>,
    /// The nominal's outlines, with their numbers in its record.
    pub outlines: Vec<(usize, &'a OutlineRecord)>,
}

/// How a sheet is laid out.
pub struct Plan {
    /// Of each segment of each contour.
    pub paths: Vec<Vec<Path>>,
    /// Of each segment of each contour.
    pub teeth: Vec<Vec<Vec<Tooth>>>,
    /// Middle of what is seen at first as it is turned, and half its width and height.
    pub middle: [f64; 2],
    pub half: [f64; 2],
    /// Middle and half sizes of all, where a nominal is larger by far than what is seen at first.
    pub all: Option<([f64; 2], [f64; 2])>,
    /// Greatest curvature, and millimeters of a tooth for each unit of it.
    pub curvature: f64,
    pub comb: f64,
    /// The direction in the plane that points upward on the sheet.
    pub up: [f64; 2],
    /// Times that whiskers are as long as deviations.
    pub times: f64,
}

/// The sheets of a document: a plane each.
pub fn sheets(document: &SectionDocument) -> Vec<Sheet<'_>> {
    let mut contours = document.contours.iter().enumerate().peekable();
    let outlines = document.nominal.iter().flat_map(|n| n.outlines.iter().enumerate());
    let mut outlines = outlines.filter(|(_, o)| !o.drawn.is_empty()).peekable();
    let mut all: Vec<Sheet> = vec![];
    loop {
        let [a, b] = [contours.peek().map(|(_, c)| c.plane), outlines.peek().map(|(_, o)| o.plane)];
        let Some(plane) = a.into_iter().chain(b).min() else { return all };
        let mut sheet = Sheet { plane, contours: vec![], outlines: vec![] };
        sheet.contours.extend(std::iter::from_fn(|| contours.next_if(|(_, c)| c.plane == plane)));
        sheet.outlines.extend(std::iter::from_fn(|| outlines.next_if(|(_, o)| o.plane == plane)));
        all.push(sheet);
    }
}

/// Middle of the box around places, and half its sides.
fn frame(places: impl Iterator<Item = [f64; 2]>) -> ([f64; 2], [f64; 2]) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in places {
        for k in 0..2 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    if low[0] > high[0] {
        return ([0.0; 2], [1.0; 2]);
    }
    ([0, 1].map(|k| 0.5 * (low[k] + high[k])), [0, 1].map(|k| 0.5 * (high[k] - low[k])))
}

/// The direction in a plane of an axis in space; the second one of the plane, where the axis is nearly normal to it.
fn upward(frame: &FrameRecord, up: Up) -> [f64; 2] {
    let axis = match up {
        Up::Y => [0.0, 1.0, 0.0],
        Up::Z => [0.0, 0.0, 1.0],
    };
    let seen = [dot(frame.x, axis), dot(frame.y, axis)];
    let size = libm::hypot(seen[0], seen[1]);
    if size > MIN_LEAN_SINE { seen.map(|x| x / size) } else { [0.0, 1.0] }
}

/// A place of the plane turned so that `up` points upward.
fn turned(up: [f64; 2], p: [f64; 2]) -> [f64; 2] {
    [up[1] * p[0] - up[0] * p[1], up[0] * p[0] + up[1] * p[1]]
}

impl Plan {
    /// Of a sheet that lies in this frame.
    pub fn of(sheet: &Sheet, document: &SectionDocument, lies: &FrameRecord, axis: Up) -> Plan {
        let up = upward(lies, axis);
        let each = |c: &ContourRecord| c.segments.iter().map(Path::of).collect::<Vec<_>>();
        let paths: Vec<Vec<Path>> = sheet.contours.iter().map(|(_, c)| each(c)).collect();
        let drawn = || paths.iter().flatten().flat_map(|p| p.places()).map(|p| turned(up, *p));
        let nominal: Vec<[f64; 2]> =
            sheet.outlines.iter().flat_map(|(_, o)| corners(o)).map(|p| turned(up, p)).collect();
        let size_of = |half: [f64; 2]| 2.0 * libm::hypot(half[0], half[1]);
        let [own, both] = [frame(drawn()).1, frame(drawn().chain(nominal.iter().copied())).1].map(size_of);
        let larger = !sheet.contours.is_empty() && both > MAX_NOMINAL_FACTOR * own;
        let all = larger.then(|| frame(drawn().chain(nominal.iter().copied())));
        let all = all.map(|(middle, half)| (middle, half.map(|x| SHEET_MARGIN * x)));
        let nominal = if larger { vec![] } else { nominal };
        let size = if sheet.contours.is_empty() { both } else { own };
        let of =
            |c: &ContourRecord| c.segments.iter().map(|s| teeth(s, TOOTH_STEP * size)).collect::<Vec<_>>();
        let teeth: Vec<Vec<Vec<Tooth>>> = sheet.contours.iter().map(|(_, c)| of(c)).collect();
        let curvature = teeth.iter().flatten().flatten().map(|t| t.curvature.abs()).fold(0.0, f64::max);
        let comb = if curvature > 0.0 { MAX_COMB_SHARE * size / curvature } else { 0.0 };
        let tips = teeth.iter().flatten().flatten().map(|t| turned(up, tip(t, comb)));
        let (middle, half) = frame(drawn().chain(tips).chain(nominal.iter().copied()));
        let least = 0.02 * half[0].max(half[1]).max(1e-9);
        let half = half.map(|x| SHEET_MARGIN * x.max(least));
        let times = times(sheet, document, MAX_COMB_SHARE * size);
        Plan { paths, teeth, middle, half, all, curvature, comb, up, times }
    }

    /// A place as SVG has it.
    pub fn at(&self, p: [f64; 2]) -> [f64; 2] {
        let [x, y] = turned(self.up, p);
        // 0 and no minus 0.
        [x - self.middle[0] + 0.0, self.middle[1] - y + 0.0]
    }

    /// The box of all as SVG has it, where that is another than what is seen at first: its least coordinates, width and height.
    pub fn all(&self) -> Option<[f64; 4]> {
        let ([x, y], [w, h]) = self.all?;
        Some([x - w - self.middle[0], self.middle[1] - y - h, 2.0 * w, 2.0 * h])
    }

    /// Millimeters of a pixel at first sight.
    pub fn pixel(&self) -> f64 {
        2.0 * self.half[0].max(self.half[1]) / ASSUMED_PIXELS
    }

    /// Decimals of a ten-millionth of the drawing: finer than what can be seen of it however near one looks.
    pub fn decimals(&self) -> usize {
        let size = self.half[0].max(self.half[1]);
        (7.0 - libm::log10(size).floor()).clamp(0.0, 12.0) as usize
    }
}

/// Outside of the curve: on the right where it turns to the left.
pub fn tip(tooth: &Tooth, comb: f64) -> [f64; 2] {
    [0, 1].map(|k| tooth.at[k] - comb * tooth.curvature * tooth.normal[k])
}

/// The corners of the box around an outline.
fn corners(outline: &OutlineRecord) -> [[f64; 2]; 4] {
    let ([x, y], [w, h]) = (outline.center, outline.size.map(|s| 0.5 * s));
    [[x - w, y - h], [x + w, y - h], [x + w, y + h], [x - w, y + h]]
}

/// How many times longer than deviations whiskers are whose longest is `longest` at most: 1, 2 or 5 times a power of ten, and 1 at least.
fn times(sheet: &Sheet, document: &SectionDocument, longest: f64) -> f64 {
    let of = |n: &usize| document.nominal.as_ref().and_then(|found| found.deviations.get(*n));
    let all = sheet.contours.iter().filter_map(|(n, _)| of(n)).flatten().flatten();
    let greatest = all.fold(0.0, |most: f64, d| most.max(d.abs()));
    let most = longest / greatest;
    if !(most.is_finite() && most >= 1.0) {
        return 1.0;
    }
    let power = libm::pow(10.0, libm::log10(most).floor());
    [5.0, 2.0].into_iter().find(|s| s * power <= most).unwrap_or(1.0) * power
}
