//! The numbers under a chart, and the parts that are out of control.

use crate::number::{Style, decimals};
use crate::page::parts::file_name;
use crate::values::{Name, Number, Optional};
use crate::views::trend::axes::Axes;
use maud::{Markup, Render, html};
use trueness_document::trend::{IndexRecord, RuleRecord, TrendDocument, TrendRecord};

/// Parts out of control that are listed.
const MAX_LISTED_SIGNALS: usize = 12;

/// The numbers of a characteristic.
pub fn facts(s: Style, document: &TrendDocument, c: &TrendRecord, axes: &Axes) -> Markup {
    let value = |x| s.optional(x, axes.decimals);
    let no_course = c.course_reason.as_deref();
    let no_index = no_course.or(c.capability_reason.as_deref());
    let indices = [("Cp", "cp", c.cp), ("Cpk", "cpk", c.cpk), ("Pp", "pp", c.pp), ("Ppk", "ppk", c.ppk)];
    html! {
        dl.measures {
            (fact(s, "chart.measured", html! { (s.count(c.measured)) "\u{a0}/\u{a0}" (s.len(&c.values)) }))
            (fact(s, "mean", value(c.mean)))
            (fact(s, "std_dev", deviation(s, c.std_dev, axes)))
            (fact(s, "chart.within", deviation(s, c.std_dev_within, axes)))
            (fact(s, "range", html! { (value(c.min)) "\u{2009}…\u{2009}" (value(c.max)) }))
            (fact(s, "chart.moving", html! {
                (value(c.control.map(|k| k.moving_range)).because(no_course))
                @if let Some(k) = &c.control { " (≤\u{a0}" (s.number(k.moving_range_upper, axes.decimals)) ")" }
            }))
        }
        "\n"
        dl.measures {
            @for (name, key, value) in indices {
                div {
                    dt { (name) }
                    dd data-index=(key) {
                        (index(s, value).because(no_index))
                        @if let Some(i) = value {
                            " " small { "(" (s.number(i.low, 2)) "\u{2009}…\u{2009}" (s.number(i.high, 2)) ")" }
                        }
                    }
                }
            }
        }
        "\n"
        @if let Some(key) = reason(c) { p.note { (s.word(key)) } "\n" }
        (signals(s, document, c))
    }
}

fn fact(s: Style, key: &str, value: impl Render) -> Markup {
    html! { div { dt { (s.word(key)) } dd { (value) } } }
}

/// A standard deviation, however small.
fn deviation(s: Style, sigma: Option<f64>, axes: &Axes) -> Markup {
    match sigma {
        Some(tiny) if tiny > 0.0 && tiny < 1e-5 => s.small(tiny),
        sigma => s.optional(sigma, decimals(sigma, 0).max(axes.decimals.min(6))).render(),
    }
}

/// An index of capability without its interval.
pub fn index(s: Style, value: Option<IndexRecord>) -> Optional<'static, Number> {
    s.optional(value.map(|i| i.value), 2)
}

/// Key of the words for why some of the numbers are missing.
fn reason(c: &TrendRecord) -> Option<&'static str> {
    if c.kind == "deviation" {
        Some("chart.share")
    } else if c.measured == 0 {
        Some("chart.none")
    } else if c.measured < 2 {
        Some("chart.few")
    } else if c.own_upper.is_some() {
        Some("chart.own_limits")
    } else if c.std_dev == Some(0.0) || c.std_dev_within == Some(0.0) {
        Some("chart.alike")
    } else if c.lower.is_none() {
        Some("chart.one_limit")
    } else {
        None
    }
}

/// The parts that are out of control, in their order, with the rules that say so.
fn signals(s: Style, document: &TrendDocument, c: &TrendRecord) -> Markup {
    let mut parts: Vec<(u64, Vec<RuleRecord>)> = Vec::new();
    for o in &c.out_of_control {
        match parts.last_mut() {
            Some((part, rules)) if *part == o.part => rules.push(o.rule),
            _ => parts.push((o.part, vec![o.rule])),
        }
    }
    if parts.is_empty() {
        return Markup::default();
    }
    let name = |n: usize| document.parts.get(n).map_or("", |p| file_name(&p.name));
    let value = |n: usize| s.optional(c.values.get(n).copied().flatten(), Axes::of(c).decimals);
    html! {
        table.pick.signals {
            caption.warning { "◎ " (s.word("verdict.out_of_control")) " " (s.len(&parts)) }
            tbody {
                @for (part, rules) in parts.iter().take(MAX_LISTED_SIGNALS) {
                    tr data-pick=(part) {
                        td.r { (s.count(part + 1)) }
                        td { (Name(name(*part as usize))) }
                        td.r { (value(*part as usize)) }
                        td {
                            @for (n, rule) in rules.iter().enumerate() { @if n > 0 { "; " } (s.word(key(*rule))) }
                        }
                    }
                }
            }
        }
        "\n"
        @if parts.len() > MAX_LISTED_SIGNALS {
            p.note { "+\u{a0}" (s.count((parts.len() - MAX_LISTED_SIGNALS) as u64)) " " (s.word("chart.more")) } "\n"
        }
    }
}

fn key(rule: RuleRecord) -> &'static str {
    match rule {
        RuleRecord::Beyond => "rule.beyond",
        RuleRecord::Range => "rule.range",
        RuleRecord::Run => "rule.run",
        RuleRecord::Steady => "rule.steady",
    }
}
