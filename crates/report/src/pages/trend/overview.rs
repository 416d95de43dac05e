//! All characteristics in a few lines, the worst first, each with its course in small.

use super::facts::index;
use crate::headline::Headline;
use crate::number::Style;
use crate::page::parts::badge;
use crate::page::symbols::symbol;
use crate::values::{Name, leaf};
use crate::views::trend::axes::{Axes, CHART_WIDTH};
use crate::views::trend::chart::{ORDER, band, course, dots};
use maud::{Markup, html};
use trueness_document::Verdict;
use trueness_document::trend::{TrendDocument, TrendRecord};

/// Height of a small course.
const SPARK_HEIGHT: f64 = 34.0;

/// The table; `rows` are the numbers of the characteristics.
pub fn overview(s: Style, document: &TrendDocument, rows: &[usize]) -> Markup {
    html! {
        table.overview {
            thead {
                tr {
                    th { (s.word("characteristic")) } th { (s.word("course")) }
                    th.r.within { "Cpk" } th.r { "Ppk" } th { (s.word("verdict")) }
                }
            }
            tbody {
                @for n in rows {
                    @let c = &document.characteristics[*n];
                    tr data-of=(n) {
                        td {
                            a href={ "#course-" (n) } { (Name(&c.id)) } " " (symbol(&c.kind))
                            small { (s.word(format!("kind.{}", c.kind))) }
                        }
                        td.small { (small(c)) }
                        td.r.within { (index(s, c.cpk)) }
                        td.r { (index(s, c.ppk)) }
                        td { (badge(s, Headline::from(c.verdict()))) (counts(s, c)) }
                    }
                }
            }
        }
        "\n"
    }
}

/// How many parts have the worst verdict, and how many are out of control.
fn counts(s: Style, c: &TrendRecord) -> Markup {
    let worst = c.verdict();
    let have = c.verdicts.iter().filter(|v| **v == worst).count() as u64;
    let mut out: Vec<u64> = c.out_of_control.iter().map(|o| o.part).collect();
    out.dedup();
    html! {
        " " small { (s.count(have)) "\u{a0}/\u{a0}" (s.len(&c.verdicts)) }
        @if !out.is_empty() {
            br; small.warning { "◎\u{a0}" (s.len(&out)) " " (s.word("verdict.out_of_control")) }
        }
    }
}

fn small(c: &TrendRecord) -> Markup {
    let axes = Axes::of(c);
    // What passes is the line alone; of one part there is no line.
    let lone = c.values.iter().flatten().count() < 2;
    html! {
        svg.spark viewBox={ "0 0 " (CHART_WIDTH) " " (SPARK_HEIGHT) } preserveAspectRatio="none" data-from=(axes.from)
            data-to=(axes.to) aria-hidden="true" {
            (band(c, &axes, SPARK_HEIGHT))
            (course(c, &axes, [CHART_WIDTH, SPARK_HEIGHT]))
            @for verdict in ORDER.into_iter().filter(|v| lone || *v != Verdict::Pass) {
                @let d = dots(c, &axes, [SPARK_HEIGHT, 3.0], |n| c.verdicts.get(n) == Some(&verdict));
                @if !d.is_empty() {
                    (leaf("path", &[("class", &format!("dots {}", Headline::from(verdict).key)), ("d", &d)]))
                }
            }
        }
    }
}
