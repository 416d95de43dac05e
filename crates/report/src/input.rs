//! What a report is made of.

use super::marks::Marks;
use super::object::ViewObject;
use super::subject::Subject;
use super::text::Language;
use super::up::Up;

/// What a report is made of.
pub struct ReportInput<'a> {
    /// The result document; every number on the page is from here.
    pub result: &'a dyn Subject,
    /// What is drawn, the first being what the marks lie on. In a comparison: the measured object, then the references. Of
    /// sections: the points of each contour in its plane, the third coordinate 0 ([`flat`](super::flat)).
    pub objects: &'a [ViewObject<'a>],
    /// What is drawn over it, in the order of the numbers that the list's rows lead to.
    pub marks: &'a [Marks],
    /// Words and limits.
    pub options: &'a ReportOptions,
}

/// Header fields, language, size.
#[derive(Clone, Debug)]
pub struct ReportOptions {
    /// Heading; the name of the measured file where absent.
    pub title: Option<String>,
    /// Name or number of the part.
    pub part: Option<String>,
    /// Serial number.
    pub serial: Option<String>,
    /// Who measured.
    pub operator: Option<String>,
    /// Bytes of the whole file that are aimed at.
    pub budget: usize,
    /// Language of the page as it is written; the reader can switch.
    pub language: Language,
    /// Decimal sign; by the language where absent.
    pub decimal: Option<char>,
    /// Which axis of the model points up on the screen.
    pub up: Up,
}

impl Default for ReportOptions {
    fn default() -> ReportOptions {
        ReportOptions {
            title: None,
            part: None,
            serial: None,
            operator: None,
            budget: 10_000_000,
            language: Language::En,
            decimal: None,
            up: Up::Z,
        }
    }
}
