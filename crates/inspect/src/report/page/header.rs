//! First sight: the verdict, what was compared with what, the key numbers; and the line at the foot.

use super::super::html::{Html, percent};
use super::super::payload::Payload;
use super::super::text::{Language, word};
use super::super::{ReportInput, number::Style};
use crate::results::Verdict;
use crate::results::compare::{CompareDocument, Comparison};

/// What the page says first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Headline {
    /// There was a tolerance.
    Judged(Verdict),
    /// There was none: nothing passes or fails.
    NotJudged,
}

/// The document's verdict as a headline.
pub fn verdict(result: &CompareDocument) -> Headline {
    result.verdict.map_or(Headline::NotJudged, Headline::Judged)
}

impl Headline {
    /// Key in the table of words, and name of its colour.
    pub fn key(self) -> &'static str {
        match self {
            Headline::Judged(Verdict::Pass) => "pass",
            Headline::Judged(Verdict::Fail) => "fail",
            Headline::Judged(Verdict::Undecided) => "undecided",
            Headline::Judged(Verdict::NotMeasured) => "not_measured",
            Headline::NotJudged => "not_judged",
        }
    }

    /// The word.
    pub fn word_in(self, language: Language) -> String {
        word(&format!("verdict.{}", self.key()), language).to_string()
    }

    /// Icon, so that colour is never the only sign.
    fn icon(self) -> &'static str {
        match self {
            Headline::Judged(Verdict::Pass) => "✓",
            Headline::Judged(Verdict::Fail) => "✕",
            Headline::Judged(Verdict::Undecided) => "?",
            Headline::Judged(Verdict::NotMeasured) => "–",
            Headline::NotJudged => "i",
        }
    }
}

/// Last part of a path.
pub fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).find(|part| !part.is_empty()).unwrap_or(path)
}

/// The heading: the title given, else the part's name, else the measured file's.
pub fn title(input: &ReportInput) -> String {
    let measured = input.result.inputs.first().map(|i| file_name(&i.path));
    let given = input.options.title.as_deref().or(input.options.part.as_deref());
    given.or(measured).unwrap_or("trueness").to_string()
}

/// A verdict as icon and word in its colour.
pub fn badge(h: &mut Html, verdict: Headline) {
    let key = verdict.key();
    h.raw(&format!("<span class=\"verdict v-{key}\"><span class=\"icon\" aria-hidden=\"true\">"));
    h.raw(verdict.icon()).raw("</span> ").word(&format!("verdict.{key}")).raw("</span>");
}

/// The header of the page.
pub fn header(h: &mut Html, input: &ReportInput) {
    let result = input.result;
    let verdict = verdict(result);
    h.raw(&format!("<header class=\"header h-{}\">\n<div class=\"row\"><h1>", verdict.key()));
    badge(h, verdict);
    h.raw("</h1><p class=\"title\">").name(&title(input)).raw("</p><p class=\"who\">");
    let mut inputs = result.inputs.iter();
    if let Some(measured) = inputs.next() {
        h.raw("<span class=\"chip measured\"><i></i>")
            .word("measured")
            .raw(" ")
            .name(file_name(&measured.path));
        h.raw("</span>");
    }
    for reference in inputs {
        h.raw("<span class=\"to\" aria-hidden=\"true\">↔</span><span class=\"chip reference\"><i></i>");
        h.word("reference").raw(" ").name(file_name(&reference.path)).raw("</span>");
    }
    h.raw("</p><p class=\"unit\">").text(&result.units).raw(" · ").word("sign.short").raw("</p>");
    h.raw("<div id=\"tools\" class=\"tools\"></div></div>\n");
    identification(h, input);
    h.raw("<div id=\"numbers\" class=\"numbers\">");
    for (n, comparison) in result.comparisons.iter().enumerate() {
        numbers(h, comparison, result.scale.decimals as usize, n);
    }
    h.raw("</div>\n</header>\n");
}

fn identification(h: &mut Html, input: &ReportInput) {
    let o = input.options;
    // Without a title the part's name is the heading already.
    let part = o.part.as_ref().filter(|_| o.title.is_some());
    let given = [("part", part), ("serial", o.serial.as_ref()), ("operator", o.operator.as_ref())];
    let mut given = given.into_iter().filter_map(|(key, value)| Some((key, value?))).peekable();
    if given.peek().is_none() {
        return;
    }
    h.raw("<p class=\"identification\">");
    for (key, value) in given {
        h.raw("<span>").word(key).raw(": ").name(value).raw("</span> ");
    }
    h.raw("</p>\n");
}

/// The line of key numbers for one comparison; the script shows the one chosen.
fn numbers(h: &mut Html, c: &Comparison, decimals: usize, n: usize) {
    let all = &c.deviation.all;
    let shown = if n == 0 { "" } else { " hidden" };
    h.raw(&format!("<dl class=\"key-numbers\" data-comparison=\"{n}\"{shown}>"));
    match &c.tolerance {
        Some(t) => {
            item(h, "within", "lead", |h| h.percent(t.inside, 2));
            item(h, "tolerance", "", |h| {
                h.number(t.lower, decimals, true).raw("\u{2009}…\u{2009}").number(t.upper, decimals, true)
            });
            if t.required < 1.0 {
                item(h, "required", "", |h| h.raw("≥\u{a0}").percent(t.required, 2));
            }
        }
        None => item(h, "most_within", "lead", |h| {
            let p = &all.percentiles;
            h.optional(p.p2_5, None, decimals, true)
                .raw("\u{2009}…\u{2009}")
                .optional(p.p97_5, None, decimals, true)
        }),
    }
    item(h, "range", "", |h| {
        h.optional(all.min, all.min_reason.as_deref(), decimals, true).raw("\u{2009}…\u{2009}");
        h.optional(all.max, all.max_reason.as_deref(), decimals, true)
    });
    item(h, "mean", "", |h| h.optional(all.mean, all.mean_reason.as_deref(), decimals + 1, true));
    item(h, "std_dev", "", |h| h.optional(all.std_dev, all.std_dev_reason.as_deref(), decimals + 1, false));
    item(h, "points", "", |h| h.count(all.count));
    let excluded: u64 = c.excluded.values().sum();
    item(h, "excluded", if excluded > 0 { "warn" } else { "" }, |h| h.count(excluded));
    item(h, "sign.method", "", |h| h.text(&c.sign.method));
    let (class, sign, state) =
        if c.soundness.sound { ("", "✓\u{a0}", "sound.short") } else { ("warn", "⚠\u{a0}", "not_sound") };
    item(h, "soundness", class, |h| h.raw(sign).word(state));
    h.raw("</dl>");
}

fn item(h: &mut Html, key: &str, class: &str, value: impl FnOnce(&mut Html) -> &mut Html) {
    h.raw(&format!("<div class=\"{class}\"><dt>")).word(key).raw("</dt><dd>");
    value(h);
    h.raw("</dd></div>");
}

/// The line at the foot: what is shown, what was left out, how it was computed.
pub fn status(h: &mut Html, input: &ReportInput, payload: &Payload) {
    let result = input.result;
    h.raw("<footer class=\"status\"><output id=\"readout\" class=\"readout\"></output><p>");
    if payload.points.1 > 0 {
        h.word("shown").raw(" ").count(payload.points.0 as u64).raw(" / ").count(result.measured.count);
        h.raw(" ").word("points.of").raw(" · ");
    }
    if payload.simplified {
        h.word("simplified").raw(" ≤ ").number(1000.0 * payload.display_error, 1, false).raw(" µm · ");
    }
    let method = if result.method == "paper" { "method.paper" } else { "method.exact" };
    h.word(method).raw(" · ").word("sign.method").raw(": ").text(&result.sign.method);
    h.raw(" · trueness ").text(&result.version).raw("</p></footer>\n");
}

/// The map in one sentence, for those who cannot see it.
pub fn in_words(c: &Comparison, style: Style) -> Option<String> {
    let t = c.tolerance?;
    let language = style.language;
    let share = |s: f64| format!("{} %", style.fixed(percent(s, 2), 2));
    Some(format!(
        "{} {} · {} {} · {} {}",
        word("within", language),
        share(t.inside),
        word("above", language),
        share(t.above),
        word("below", language),
        share(t.below)
    ))
}
