//! The numbers under a chart, and the parts that are out of control.

use super::super::super::html::Html;
use super::super::super::page::blocks::file_name;
use super::super::section::{decimals, small};
use super::axes::Axes;
use crate::results::trend::{IndexRecord, RuleRecord, TrendDocument, TrendRecord};

/// Parts out of control that are listed.
const LISTED: usize = 12;

/// Writes the numbers of a characteristic.
pub fn facts(h: &mut Html, document: &TrendDocument, c: &TrendRecord, axes: &Axes) {
    h.raw("<dl class=\"measures\">");
    fact(h, "chart.measured", |h| {
        h.count(c.measured).raw("\u{a0}/\u{a0}").count(c.values.len() as u64);
    });
    fact(h, "mean", |h| {
        h.optional(c.mean, None, axes.decimals, false);
    });
    for (key, sigma) in [("std_dev", c.std_dev), ("chart.within", c.std_dev_within)] {
        fact(h, key, |h| match sigma {
            Some(s) if s > 0.0 && s < 1e-5 => {
                small(h, s);
            }
            s => {
                h.optional(s, None, decimals(s, 0).max(axes.decimals.min(6)), false);
            }
        });
    }
    fact(h, "range", |h| {
        h.optional(c.min, None, axes.decimals, false).raw("\u{2009}…\u{2009}");
        h.optional(c.max, None, axes.decimals, false);
    });
    fact(h, "chart.moving", |h| {
        h.optional(c.control.map(|k| k.moving_range), c.course_reason.as_deref(), axes.decimals, false);
        if let Some(k) = &c.control {
            h.raw(" (≤\u{a0}").number(k.moving_range_upper, axes.decimals, false).raw(")");
        }
    });
    h.raw("</dl>\n<dl class=\"measures\">");
    for (name, value) in [("Cp", c.cp), ("Cpk", c.cpk), ("Pp", c.pp), ("Ppk", c.ppk)] {
        h.raw(&format!("<div><dt>{name}</dt><dd data-index=\"{}\">", name.to_ascii_lowercase()));
        index(h, value, c.course_reason.as_deref().or(c.capability_reason.as_deref()));
        if let Some(i) = value {
            h.raw(" <small>(").number(i.low, 2, false).raw("\u{2009}…\u{2009}");
            h.number(i.high, 2, false).raw(")</small>");
        }
        h.raw("</dd></div>");
    }
    h.raw("</dl>\n");
    if let Some(key) = reason(c) {
        h.raw("<p class=\"note\">").word(key).raw("</p>\n");
    }
    signals(h, document, c);
}

fn fact(h: &mut Html, key: &str, value: impl FnOnce(&mut Html)) {
    h.raw("<div><dt>").word(key).raw("</dt><dd>");
    value(h);
    h.raw("</dd></div>");
}

/// An index of capability without its interval.
pub fn index(h: &mut Html, value: Option<IndexRecord>, reason: Option<&str>) {
    h.optional(value.map(|i| i.value), reason, 2, false);
}

/// Key of the words for why some of the numbers are missing.
fn reason(c: &TrendRecord) -> Option<&'static str> {
    if c.measured == 0 {
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
fn signals(h: &mut Html, document: &TrendDocument, c: &TrendRecord) {
    let mut parts: Vec<(u64, Vec<RuleRecord>)> = Vec::new();
    for o in &c.out_of_control {
        match parts.last_mut() {
            Some((part, rules)) if *part == o.part => rules.push(o.rule),
            _ => parts.push((o.part, vec![o.rule])),
        }
    }
    if parts.is_empty() {
        return;
    }
    h.raw("<table class=\"pick signals\"><caption class=\"warning\">◎ ")
        .word("verdict.out_of_control")
        .raw(" ");
    h.count(parts.len() as u64).raw("</caption><tbody>");
    for (part, rules) in parts.iter().take(LISTED) {
        let number = *part as usize;
        let name = document.parts.get(number).map_or("", |p| file_name(&p.name));
        h.raw(&format!("<tr data-pick=\"{part}\"><td class=\"r\">"))
            .count(part + 1)
            .raw("</td><td>")
            .name(name);
        h.raw("</td><td class=\"r\">");
        h.optional(c.values.get(number).copied().flatten(), None, Axes::of(c).decimals, false)
            .raw("</td><td>");
        for (n, rule) in rules.iter().enumerate() {
            h.raw(if n > 0 { "; " } else { "" }).word(key(*rule));
        }
        h.raw("</td></tr>");
    }
    h.raw("</tbody></table>\n");
    if parts.len() > LISTED {
        h.raw("<p class=\"note\">+\u{a0}")
            .count((parts.len() - LISTED) as u64)
            .raw(" ")
            .word("chart.more")
            .raw("</p>\n");
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
