//! Tables of the list: heads by the keys of their words, rows as plain values.

use super::super::number::Style;
use maud::{Markup, Render, html};
use trueness_geom::space::Point;

/// A row of a table.
#[derive(Default)]
pub struct Row {
    cells: Vec<Markup>,
    pick: Option<usize>,
    choose: Option<usize>,
    contour: Option<u64>,
    class: Option<&'static str>,
    title: Option<u64>,
    is_named: bool,
    then: Markup,
}

impl Row {
    /// The values of the columns.
    pub fn of(cells: &[&dyn Render]) -> Row {
        Row { cells: cells.iter().map(|cell| cell.render()).collect(), ..Row::default() }
    }

    /// A name, a value and the place that has it.
    pub fn at(s: Style, name: &dyn Render, value: &dyn Render, place: Point) -> Row {
        let [x, y, z] = place.map(|x| s.number(x, 2));
        Row::of(&[name, value, &x, &y, &z])
    }

    /// Leads to this pick.
    pub fn pick(self, pick: usize) -> Row {
        Row { pick: Some(pick), ..self }
    }

    /// Shows this map, the first of which is shown already.
    pub fn choose(self, map: usize) -> Row {
        Row { choose: Some(map), ..self }
    }

    /// Is about this contour.
    pub fn contour(self, contour: u64) -> Row {
        Row { contour: Some(contour), ..self }
    }

    /// Has a class, if there is one.
    pub fn class(self, class: Option<&'static str>) -> Row {
        Row { class, ..self }
    }

    /// The first cell tells the number of a point or vertex when it is pointed at.
    pub fn title(self, title: u64) -> Row {
        Row { title: Some(title), ..self }
    }

    /// The first cell is the row's name.
    pub fn named(self) -> Row {
        Row { is_named: true, ..self }
    }

    /// Has further rows under it.
    pub fn then(self, then: Markup) -> Row {
        Row { then, ..self }
    }

    /// `texts` is the number of columns that hold no numbers.
    fn markup(&self, texts: usize) -> Markup {
        html! {
            tr data-pick=[self.pick] data-contour=[self.contour] data-choose=[self.choose] aria-selected=[self.choose.map(|map| map == 0)]
                class=[self.class] {
                @for (n, cell) in self.cells.iter().enumerate() {
                    @if n == 0 && self.is_named { th scope="row" { (cell) } }
                    @else if n < texts { td title=[self.title.filter(|_| n == 0)] { (cell) } }
                    @else { td.r { (cell) } }
                }
            }
            (self.then)
        }
    }
}

/// A table with columns of texts, then of numbers, by the keys of their words. A single letter is called so in all languages; a
/// column may have no name.
pub fn table<'a>(
    s: Style,
    class: impl Into<Option<&'a str>>,
    [texts, numbers]: [&[&str]; 2],
    rows: impl IntoIterator<Item = Row>,
) -> Markup {
    let name = |key: &str| html! { @if key.len() < 2 { (key) } @else { (s.word(key)) } };
    html! {
        table class=[class.into()] {
            thead { tr { @for key in texts { th { (name(key)) } } @for key in numbers { th.r { (name(key)) } } } }
            tbody { @for row in rows { (row.markup(texts.len())) } }
        }
    }
}

/// A table of [`Row::at`], whose values are called by the key `word`.
pub fn places(s: Style, word: &str, rows: impl IntoIterator<Item = Row>) -> Markup {
    table(s, "pick", [&[""], &[word, "x", "y", "z"]], rows)
}

/// Rows of a list of places that are printed; the screen has all that are listed.
const MAX_PRINTED_ROWS: usize = 12;

/// Class of row `n` of a list of places.
pub fn row_class(n: usize) -> Option<&'static str> {
    (n >= MAX_PRINTED_ROWS).then_some("more")
}

/// Says on paper how many of `rows` are not printed.
pub fn not_printed(s: Style, rows: usize) -> Markup {
    html! {
        @if rows > MAX_PRINTED_ROWS {
            p.note.paper { "+\u{a0}" (s.count((rows - MAX_PRINTED_ROWS) as u64)) " " (s.word("more.not_printed")) }
        }
    }
}

/// Says how many of all are listed.
pub fn listed(s: Style, key: &str, shown: usize, total: u64) -> Markup {
    html! {
        @if (shown as u64) < total {
            p.note { (s.word(key)) " " (s.count(shown as u64)) " / " (s.count(total)) }
        }
    }
}
