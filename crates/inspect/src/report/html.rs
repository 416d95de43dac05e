//! Writing HTML so that no text can become markup.

use super::Language;
use super::number::Style;
use super::text::word;
use super::values::percent;

/// A page, or a part of one, under construction.
pub struct Html {
    text: String,
    /// How numbers and words are written.
    pub style: Style,
}

impl Html {
    /// Nothing yet.
    pub fn new(style: Style) -> Html {
        Html { text: String::new(), style }
    }

    /// A part that is written piece by piece.
    pub fn part(style: Style, write: impl FnOnce(&mut Html)) -> maud::Markup {
        let mut h = Html::new(style);
        write(&mut h);
        maud::PreEscaped(h.finish())
    }

    /// The text so far.
    pub fn finish(self) -> String {
        self.text
    }

    /// Language of the words.
    pub fn language(&self) -> Language {
        self.style.language
    }

    /// Markup of our own.
    pub fn raw(&mut self, markup: &str) -> &mut Html {
        self.text.push_str(markup);
        self
    }

    /// A part made by a template.
    pub fn add(&mut self, part: impl maud::Render) -> &mut Html {
        part.render_to(&mut self.text);
        self
    }

    /// Text from anywhere, as text.
    pub fn text(&mut self, text: &str) -> &mut Html {
        self.text.push_str(&escaped(text));
        self
    }

    /// A name from outside: as text, and whatever direction it is written in ends with it.
    pub fn name(&mut self, name: &str) -> &mut Html {
        let safe = escaped(name);
        self.raw(&format!("<bdi class=\"name\" title=\"{safe}\">{safe}</bdi>"))
    }

    /// A word of the table, which the script can exchange for another language's.
    pub fn word(&mut self, key: &str) -> &mut Html {
        let text = escaped(word(key, self.language()));
        self.raw(&format!("<span data-t=\"{key}\">{text}</span>"))
    }

    /// A number, which the script can write in another language's way. `signed` puts a plus sign before what is above zero.
    pub fn number(&mut self, value: f64, decimals: usize, signed: bool) -> &mut Html {
        let text =
            if signed { self.style.signed(value, decimals) } else { self.style.fixed(value, decimals) };
        let sign = if signed { " data-s" } else { "" };
        self.raw(&format!("<span class=\"n\" data-n=\"{value}\" data-d=\"{decimals}\"{sign}>{text}</span>"))
    }

    /// A number above zero that is too small for digits after the point.
    pub fn scientific(&mut self, value: f64, decimals: usize) -> &mut Html {
        let text = self.style.exponent(value, decimals);
        self.raw(&format!("<span class=\"n\" data-e=\"{value}\" data-d=\"{decimals}\">{text}</span>"))
    }

    /// A count.
    pub fn count(&mut self, count: u64) -> &mut Html {
        self.number(count as f64, 0, false)
    }

    /// A share (0 to 1) in percent.
    pub fn percent(&mut self, share: f64, decimals: usize) -> &mut Html {
        self.number(percent(share, decimals), decimals, false).raw("\u{a0}%")
    }

    /// A share as a percentage, or a dash with the reason why there is none as its tooltip.
    pub fn optional_percent(
        &mut self,
        share: Option<f64>,
        reason: Option<&str>,
        decimals: usize,
    ) -> &mut Html {
        match share {
            Some(share) => self.percent(share, decimals),
            None => self.optional(None, reason, decimals, false),
        }
    }

    /// A number, or a dash with the reason why there is none as its tooltip.
    pub fn optional(
        &mut self,
        value: Option<f64>,
        reason: Option<&str>,
        decimals: usize,
        signed: bool,
    ) -> &mut Html {
        match value.filter(|v| v.is_finite()) {
            Some(v) => self.number(v, decimals, signed),
            None => {
                let why = escaped(reason.unwrap_or(""));
                self.raw(&format!("<span class=\"none\" title=\"{why}\">–</span>"))
            }
        }
    }
}

/// Text with the five characters that mean something in HTML replaced, and control characters dropped.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            c if c.is_control() => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}
