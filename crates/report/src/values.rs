//! What stands in the templates of a page: words, names, texts, numbers. None of it can become markup.
//!
//! A part of the page is a function that gives [`Markup`]; its template names the [`Style`] `s`:
//! `html! { td.r { (s.number(x, 3)) "\u{a0}mm" } }`. The script can exchange words and numbers for those of another language,
//! by their attributes.
//!
//! A text from outside stands as [`Text`] or [`Name`], never bare: bare strings are our own.

use super::number::{Style, decimals};
use super::text::word;
use maud::{Escaper, Markup, Render, html};
use std::fmt::Write;

/// Text from anywhere, as text: control characters dropped, and no character left that means something in HTML.
pub struct Text<T>(pub T);

impl<T: AsRef<str>> Render for Text<T> {
    fn render_to(&self, page: &mut String) {
        for c in self.0.as_ref().chars() {
            // The quote of one stroke too, though no attribute of ours stands in such.
            let _ = match c {
                '\'' => page.write_str("&#39;"),
                c if c.is_control() => page.write_char(char::REPLACEMENT_CHARACTER),
                c => Escaper::new(page).write_char(c),
            };
        }
    }
}

/// A name from outside: as text, and whatever direction it is written in ends with it.
pub struct Name<T>(pub T);

impl<T: AsRef<str>> Render for Name<T> {
    fn render(&self) -> Markup {
        let text = Text(self.0.as_ref());
        html! { bdi.name title=(text) { (text) } }
    }
}

/// A word of the table.
pub struct Word<K> {
    key: K,
    style: Style,
}

impl<K: AsRef<str>> Render for Word<K> {
    fn render(&self) -> Markup {
        let key = self.key.as_ref();
        html! { span data-t=(key) { (Text(word(key, self.style.language))) } }
    }
}

/// A number.
#[derive(Clone, Copy)]
pub struct Number {
    value: f64,
    decimals: usize,
    signed: bool,
    style: Style,
}

impl Number {
    /// With a plus sign before what is above zero.
    pub fn signed(self) -> Number {
        Number { signed: true, ..self }
    }
}

impl Render for Number {
    fn render(&self) -> Markup {
        let Number { value, decimals, signed, style } = *self;
        let text = if signed { style.signed(value, decimals) } else { style.fixed(value, decimals) };
        html! { span.n data-n=(value) data-d=(decimals) data-s[signed] { (text) } }
    }
}

/// A number above zero that is too small for digits after the point.
pub struct Scientific {
    value: f64,
    decimals: usize,
    style: Style,
}

impl Render for Scientific {
    fn render(&self) -> Markup {
        let Scientific { value, decimals, style } = *self;
        html! { span.n data-e=(value) data-d=(decimals) { (style.exponent(value, decimals)) } }
    }
}

/// A share (0 to 1) in percent.
#[derive(Clone, Copy)]
pub struct Percent(Number);

impl Render for Percent {
    fn render_to(&self, page: &mut String) {
        self.0.render_to(page);
        page.push_str("\u{a0}%");
    }
}

/// A value, or a dash with the reason why there is none as its tooltip.
pub struct Optional<'a, T> {
    value: Option<T>,
    reason: Option<&'a str>,
}

impl<'a, T> Optional<'a, T> {
    /// Says why there is none, where there is none.
    pub fn because(self, reason: Option<&'a str>) -> Optional<'a, T> {
        Optional { reason, ..self }
    }
}

impl Optional<'_, Number> {
    /// With a plus sign before what is above zero.
    pub fn signed(self) -> Self {
        self.with_sign(true)
    }

    /// The same, if it is `signed`.
    pub fn with_sign(self, signed: bool) -> Self {
        Optional { value: self.value.map(|value| Number { signed, ..value }), ..self }
    }
}

impl<T: Render> Render for Optional<'_, T> {
    fn render_to(&self, page: &mut String) {
        match &self.value {
            Some(value) => value.render_to(page),
            None => html! { span.none title=(Text(self.reason.unwrap_or(""))) { "–" } }.render_to(page),
        }
    }
}

impl Style {
    /// A word of the table.
    pub fn word<K: AsRef<str>>(self, key: K) -> Word<K> {
        Word { key, style: self }
    }

    /// A word of the table as text alone, for titles and attributes.
    pub fn bare_word(self, key: &str) -> Text<&str> {
        Text(word(key, self.language))
    }

    /// A number with so many digits after the point.
    pub fn number(self, value: f64, decimals: usize) -> Number {
        Number { value, decimals, signed: false, style: self }
    }

    /// A number above zero that is too small for digits after the point.
    pub fn scientific(self, value: f64, decimals: usize) -> Scientific {
        Scientific { value, decimals, style: self }
    }

    /// A small length: two digits of it, as 1.5e−7 where it would need many zeros.
    pub fn small(self, x: f64) -> Markup {
        match x {
            0.0 => html! { "0" },
            x if x < 1e-5 => self.scientific(x, 1).render(),
            x => self.number(x, decimals(Some(x), 4)).render(),
        }
    }

    /// A count.
    pub fn count(self, count: u64) -> Number {
        self.number(count as f64, 0)
    }

    /// A count of what a list holds.
    pub fn len<T>(self, list: &[T]) -> Number {
        self.count(list.len() as u64)
    }

    /// A share (0 to 1) in percent.
    pub fn percent(self, share: f64, decimals: usize) -> Percent {
        Percent(self.number(percent(share, decimals), decimals))
    }

    /// A number that there may not be; none is what is not finite.
    pub fn optional(self, value: Option<f64>, decimals: usize) -> Optional<'static, Number> {
        let value = value.filter(|v| v.is_finite()).map(|v| self.number(v, decimals));
        Optional { value, reason: None }
    }

    /// A share that there may not be.
    pub fn optional_percent(self, share: Option<f64>, decimals: usize) -> Optional<'static, Percent> {
        Optional { value: share.map(|share| self.percent(share, decimals)), reason: None }
    }
}

/// A share in percent that rounds to 100 or to 0 only where it is that: 99.9996 % in tolerance is not 100.00 %.
pub fn percent(share: f64, decimals: usize) -> f64 {
    let unit = 10f64.powi(-(decimals as i32));
    let p = 100.0 * share;
    if share < 1.0 && p > 100.0 - unit {
        100.0 - unit
    } else if share > 0.0 && p < unit {
        unit
    } else {
        p
    }
}

/// An element of a drawing without content, closed in itself: a template would close it by a second tag, which thousands of
/// paths need not carry.
pub fn leaf(name: &'static str, attributes: &[(&'static str, &dyn Render)]) -> Markup {
    let mut text = format!("<{name}");
    for (key, value) in attributes {
        let _ = write!(text, " {key}=\"");
        value.render_to(&mut text);
        text.push('"');
    }
    text.push_str("/>");
    maud::PreEscaped(text)
}

/// JSON to stand inside a `<script>` element: nothing in it can end the element.
pub fn json(value: &impl serde::Serialize) -> serde_json::Result<String> {
    Ok(serde_json::to_string(value)?.replace('<', "\\u003c"))
}

#[cfg(test)]
mod tests {
    use super::super::Language;
    use super::*;

    const S: Style = Style { language: Language::De, decimal: None };

    fn written(part: impl Render) -> String {
        part.render().into_string()
    }

    #[test]
    fn no_text_becomes_markup() {
        let foreign = "<img src=x onerror=\"alert('&')\">\u{0}";
        let safe = "&lt;img src=x onerror=&quot;alert(&#39;&amp;&#39;)&quot;&gt;\u{fffd}";
        assert_eq!(written(Text(foreign)), safe);
        assert_eq!(written(Name(foreign)), format!("<bdi class=\"name\" title=\"{safe}\">{safe}</bdi>"));
        let none = S.optional(None, 2).because(Some(foreign)).render().into_string();
        assert_eq!(none, format!("<span class=\"none\" title=\"{safe}\">–</span>"));
        assert_eq!(written(leaf("path", &[("d", &Text(foreign))])), format!("<path d=\"{safe}\"/>"));
        let value = serde_json::json!({"name": "</script><!--"});
        let safe = json(&value).unwrap();
        assert_eq!(safe, r#"{"name":"\u003c/script>\u003c!--"}"#);
        assert_eq!(serde_json::from_str::<serde_json::Value>(&safe).unwrap(), value);
    }

    #[test]
    fn numbers_keep_all_digits_for_the_script() {
        assert_eq!(
            written(S.number(1234.56789, 2).signed()),
            "<span class=\"n\" data-n=\"1234.56789\" data-d=\"2\" data-s>+1.234,57</span>"
        );
        assert_eq!(
            written(S.scientific(1.5e-7, 1)),
            "<span class=\"n\" data-e=\"0.00000015\" data-d=\"1\">1,5e\u{2212}7</span>"
        );
        assert_eq!(written(S.word("verdict.pass")), "<span data-t=\"verdict.pass\">In Ordnung</span>");
    }

    #[test]
    fn what_is_no_number_is_a_dash() {
        for none in [None, Some(f64::NAN), Some(f64::INFINITY)] {
            assert_eq!(written(S.optional(none, 2)), "<span class=\"none\" title=\"\">–</span>");
        }
        assert!(written(S.optional(Some(-2.0), 1).signed()).ends_with("data-s>\u{2212}2,0</span>"));
    }

    #[test]
    fn all_is_all_and_none_is_none() {
        assert_eq!([1.0, 0.0, 0.5].map(|s| percent(s, 2)), [100.0, 0.0, 50.0]);
        assert_eq!([0.999_999, 0.000_001].map(|s| percent(s, 2)), [99.99, 0.01]);
    }
}
