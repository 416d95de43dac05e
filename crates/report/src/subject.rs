//! A document as the page sees it.

use super::headline::Headline;
use super::number::Style;
use super::object::ViewObject;
use super::up::Up;
use maud::Markup;
use serde::Serialize;
use serde_json::Value;
use trueness_document::InputRecord;
use trueness_document::compare::{Histogram, ToleranceShares};
use trueness_document::scale::Scale;
use trueness_document::tolerance::badness;
use trueness_geom::space::{Point, Vector};

/// What the page of a document says, beside what is drawn.
pub struct Content<'a> {
    /// Name of the document's schema, version of the program, unit of every length.
    pub marks: [&'a str; 3],
    /// Files read.
    pub inputs: &'a [InputRecord],
    /// The first word.
    pub headline: Headline,
    /// What the document itself is called.
    pub title: Option<&'a str>,
    /// Key of a convention that every number on the page follows.
    pub convention: Option<&'static str>,
    /// Key of the stored picture's description.
    pub picture: &'static str,
    /// The line of key numbers under the verdict.
    pub numbers: Markup,
    /// Sections of the list, without files and method. Rows that lead to a place have `data-pick` with their number in
    /// [`Subject::picks`].
    pub list: Markup,
    /// How it was computed, in words.
    pub method: Markup,
    /// The same in a few words, for the foot of the page.
    pub how: Markup,
    /// Points that were measured, where the page may show fewer.
    pub points: Option<u64>,
    /// Seed of everything random.
    pub seed: Option<u64>,
    /// The whole document.
    pub json: Value,
}

impl<'a> Content<'a> {
    /// Of a document with these marks and inputs; the rest is to be filled in.
    pub fn of(headline: Headline, marks: [&'a str; 3], inputs: &'a [InputRecord]) -> Content<'a> {
        Content {
            marks,
            inputs,
            headline,
            title: None,
            convention: None,
            picture: "",
            numbers: Markup::default(),
            list: Markup::default(),
            method: Markup::default(),
            how: Markup::default(),
            points: None,
            seed: None,
            json: Value::Null,
        }
    }
}

/// A result document as its page sees it. Every document has it in a file of `pages/`; the types of its answers are the
/// report's own, so it is implemented here alone.
pub trait Subject: Sync {
    /// What its page says.
    ///
    /// # Errors
    /// A document that is no JSON, which none is.
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>>;
    /// Which way the surface looks that the first view should show, where one side matters.
    fn facing(&self) -> Option<Vector> {
        None
    }
    /// The color scale, if values are mapped; that of the first map, where they have several.
    fn scale(&self) -> Option<&Scale> {
        None
    }
    /// Keys of the words for what is mapped, and for the high and the low end of the scale.
    fn quantity(&self) -> [&'static str; 3] {
        ["deviation", "ends.high", "ends.low"]
    }
    /// The maps of values, in the order of the fields' numbers.
    fn maps(&self) -> Vec<Map<'_>> {
        vec![]
    }
    /// Places that rows of the list lead to.
    fn picks(&self) -> Vec<Pick> {
        vec![]
    }
    /// Numbers of the picks that the first view should show, the most important first: those of the first map with the
    /// values farthest beyond the tolerance, without one the greatest.
    fn important(&self, picks: &[Pick]) -> Vec<usize> {
        let zone = self.maps().first().and_then(|m| m.tolerance.as_ref().map(|t| [t.lower, t.upper]));
        let size = |n: &usize| badness(picks[*n].value.unwrap_or(0.0), zone);
        let mut valued: Vec<usize> = (0..picks.len())
            .filter(|n| picks[*n].value.is_some() && picks[*n].map.unwrap_or(0) == 0)
            .collect();
        valued.sort_by(|a, b| size(b).total_cmp(&size(a)));
        valued
    }
    /// What it draws in the plane; without, the page has a part in space.
    fn drawing(&self) -> Option<&dyn Drawn> {
        None
    }
}

/// A document that draws itself, in the plane.
pub trait Drawn {
    /// Classes of the page and of its stage.
    fn classes(&self) -> [&'static str; 2] {
        ["drawn", "flat"]
    }
    /// Of the places of the objects how many are drawn in so many bytes, and how many there are.
    fn shown(&self, objects: &[ViewObject], up: Up, room: usize) -> (usize, usize);
    /// The drawing, with as many places of the objects as `room` bytes hold.
    /// `up` is the model's axis that points upward, where the plane lies in space.
    fn draw(&self, s: Style, objects: &[ViewObject], up: Up, room: usize) -> Markup;
}

/// Values that can be shown as colors.
#[derive(Default)]
pub struct Map<'a> {
    /// What distinguishes it from the others.
    pub name: &'a str,
    /// Number of values.
    pub count: u64,
    /// Their mean.
    pub mean: Option<f64>,
    /// Shares against the tolerance.
    pub tolerance: Option<ToleranceShares>,
    /// Their counts.
    pub histogram: Option<&'a Histogram>,
    /// Their own color scale, where maps differ in it.
    pub scale: Option<&'a Scale>,
    /// Their own words, as in [`Subject::quantity`].
    pub quantity: Option<[&'static str; 3]>,
}

/// A place that a row of the list leads to.
#[derive(Default)]
pub struct Pick {
    /// Where to look.
    pub position: Point,
    /// The place of the reference that it was measured from.
    pub surface: Option<Point>,
    /// Half the size of what to bring into view, millimeters; without it the view keeps its size.
    pub reach: Option<f64>,
    /// Which way the surface looks there.
    pub normal: Option<Vector>,
    /// Number of what is drawn there, over all marks.
    pub mark: Option<usize>,
    /// Number of the object that is meant; the others then step back.
    pub object: Option<usize>,
    /// The map that it belongs to.
    pub map: Option<usize>,
    /// The value there, for a flag.
    pub value: Option<f64>,
    /// What stands at the end of a leader to the place, where it is no value of a map.
    pub frame: Option<Frame>,
}

/// A characteristic as a drawing has it, with what was found: sign, what is allowed, datums, value, verdict.
#[derive(Clone, Debug, Serialize)]
pub struct Frame {
    /// Its name in the plan and the list.
    pub id: String,
    /// The sign as the path of an SVG in a square of 16; none where there is no sign.
    pub sign: Option<&'static str>,
    /// The parameter of a texture, in place of a sign.
    pub parameter: Option<String>,
    /// Whether the zone is a diameter.
    pub diametral: bool,
    /// Least allowed value.
    pub lower: Option<f64>,
    /// Greatest allowed value; with a material requirement, the tolerance without its bonus.
    pub upper: f64,
    /// Unit behind value and limits: `°`, or nothing.
    pub unit: &'static str,
    /// Which size, and where the zone of a profile lies, by the letters of drawings.
    pub letters: Vec<String>,
    /// The letter of a material requirement of the feature.
    pub material: Option<&'static str>,
    /// Datums, the first one first.
    pub datums: Vec<String>,
    /// The value found.
    pub value: Option<f64>,
    /// Decimals of value and limits.
    pub decimals: usize,
    /// Key of the verdict's word.
    pub verdict: &'static str,
}
