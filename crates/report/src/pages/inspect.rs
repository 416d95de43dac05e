//! The page of an inspection: the verdict, every characteristic with its value, the features.

use crate::headline::Headline;
use crate::number::Style;
use crate::page::parts::{badge, fact, inside, key_number, paragraphs, range, section, verdicts};
use crate::page::symbols::{datum_name, path, requirement, symbol};
use crate::page::table::{Row, table};
use crate::pages::align::{Facts, alignment, chip};
use crate::pages::compare;
use crate::subject::{Content, Frame, Map, Pick, Subject};
use crate::values::{Name, Text};
use maud::{Markup, html};
use trueness_document::Verdict;
use trueness_document::compare::{Comparison, ToleranceShares};
use trueness_document::inspect::{
    AlignmentRecord, CharacteristicRecord, FeatureRecord, FrameSource, InspectDocument, MeasuredPlace,
    PlaceRecord,
};
use trueness_document::scale::Scale;

impl Subject for InspectDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        let mut json = serde_json::to_value(self)?;
        // The page has a map of its own.
        json.as_object_mut().and_then(|members| members.shift_remove("deviation_map"));
        let decision = format!("decision.{}", self.decision_rule);
        Ok(Content {
            title: self.title.as_deref(),
            picture: "picture.inspect",
            numbers: numbers(s, self),
            list: list(s, self),
            method: html! {
                (paragraphs(s, ["method.inspect.text", &format!("{decision}.text")]))
                ul { @for standard in standards(self) { li { (Text(standard)) } } }
            },
            how: html! { (s.word("decision")) ": " (s.word(&decision)) },
            json,
            ..Content::of(self.verdict.into(), [&self.schema, &self.version, &self.units], &self.inputs)
        })
    }

    fn picks(&self) -> Vec<Pick> {
        let of = |(n, c): (usize, &CharacteristicRecord)| Pick {
            position: c.anchor.unwrap_or([0.0; 3]),
            mark: Some(n),
            frame: c.anchor.map(|_| frame(c)),
            ..Pick::default()
        };
        let judged = self.deviation.iter().zip(&self.scale);
        let worst = judged.flat_map(|(c, scale)| compare::listed_worst(c, scale.decimals as usize));
        let worst = worst.map(|w| compare::pick(w, 0));
        self.rows().into_iter().enumerate().map(of).chain(worst).collect()
    }

    fn important(&self, _: &[Pick]) -> Vec<usize> {
        (0..self.characteristics.len()).collect()
    }

    fn scale(&self) -> Option<&Scale> {
        self.scale.as_ref()
    }

    fn maps(&self) -> Vec<Map<'_>> {
        self.deviation.iter().map(compare::map).collect()
    }
}

fn numbers(s: Style, d: &InspectDocument) -> Markup {
    let regions = d.deviation.as_ref().filter(|d| !d.regions.is_empty());
    let within = d.deviation.as_ref().filter(|_| regions.is_none()).and_then(|d| d.tolerance.as_ref());
    let has_limits = within.is_some() || regions.is_some();
    let outside = has_limits && d.deviation.as_ref().and_then(|d| d.verdict) != Some(Verdict::Pass);
    // Where the deviations alone fail, they lead.
    let alone = outside && d.counts.fail == 0;
    let class = match (alone, outside) {
        (true, _) => "lead",
        (false, true) => "warn",
        (false, false) => "",
    };
    let judged = html! {
        @if let Some(c) = regions { (key_number(s, "regions.pass", class, compare::passing(s, c))) }
        @if let Some(t) = within {
            (key_number(s, "deviations.within", class, html! {
                (inside(s, t)) @if t.required < 1.0 { " " small { (required(s, t)) } }
            }))
        }
    };
    let n = &d.counts;
    let counts = verdicts([n.fail, n.undecided, n.not_measured, n.pass], !alone);
    let all = s.len(&d.characteristics);
    let of = facts(&d.alignment);
    let told = Some(&of).filter(|of| of.left_out.is_some_and(|n| n > 0) || !of.warnings.is_empty());
    html! {
        dl.key-numbers {
            @if alone { (judged) }
            @for (key, class, count) in counts {
                (key_number(s, key, class, html! {
                    (s.count(count)) @if class == "lead" { " " small { "/\u{a0}" (all) } }
                }))
            }
            (compare::because(s, &d.verdict_reasons))
            (key_number(s, "characteristics", "", all))
            @if !alone { (judged) }
            @if let Some(chip) = told.and_then(|of| chip(s, of, 4)) { (chip) }
        }
    }
}

fn list(s: Style, d: &InspectDocument) -> Markup {
    let aligned = alignment(s, &facts(&d.alignment));
    let is_doubtful = d.alignment.doubts().next().is_some();
    html! {
        (compare::reasons(s, &d.verdict_reasons))
        // Where nothing else can be believed, this comes first.
        @if is_doubtful { (aligned) }
        (section(s, "characteristics", characteristics(s, d)))
        @if let (Some(c), Some(scale)) = (&d.deviation, &d.scale) {
            (deviations(s, c, scale.decimals as usize, d.characteristics.len()))
        }
        (section(s, "features", features(s, d)))
        @if !is_doubtful { (aligned) }
    }
}

fn standards(d: &InspectDocument) -> Vec<&str> {
    let mut standards: Vec<&str> = d.characteristics.iter().map(|c| c.standard.as_str()).collect();
    standards.sort_unstable();
    standards.dedup();
    standards
}

/// What there is to be said of the alignment.
fn facts(of: &AlignmentRecord) -> Facts<'_> {
    Facts {
        method: &of.method,
        rms: of.rms,
        greatest: of.greatest,
        excess: of.excess,
        left_out: of.left_out,
        warnings: &of.warnings,
    }
}

/// What stands at the end of its leader.
fn frame(c: &CharacteristicRecord) -> Frame {
    Frame {
        id: c.id.clone(),
        sign: path(&c.kind),
        parameter: c.parameter().map(String::from),
        diametral: c.diametral(),
        lower: c.lower,
        upper: c.requirement().map_or(c.upper, |(tolerance, _)| tolerance),
        unit: degrees(c),
        letters: c.letters().map(String::from).collect(),
        material: c.requirement().map(|(_, material)| material.word()),
        datums: c.datums.clone(),
        value: c.value,
        decimals: digits(c),
        verdict: Headline::from(c.verdict).key,
    }
}

/// The share that is asked for.
fn required(s: Style, t: &ToleranceShares) -> Markup {
    html! { "(≥\u{a0}" (s.percent(t.required, 2)) ")" }
}

/// Three columns, so that the verdict stands in view beside the part: what and of which feature, value over what is allowed,
/// verdict.
fn characteristics(s: Style, d: &InspectDocument) -> Markup {
    html! {
        table.pick {
            thead {
                tr {
                    th { (s.word("feature")) }
                    th.r { (s.word("value")) br; small { (s.word("allowed")) } }
                    th { (s.word("verdict")) }
                }
            }
            tbody {
                @for (n, c) in d.rows().into_iter().enumerate() {
                    tr data-pick=(n) {
                        td {
                            (Name(&c.id)) " " (symbol(&c.kind)) (s.word(format!("kind.{}", c.kind)))
                            @for letters in c.letters().chain(c.parameter()) { " " (Text(letters)) }
                            br;
                            small { (Name(&c.feature)) @for datum in &c.datums { " | " (datum_name(datum)) } }
                        }
                        td.r {
                            (s.optional(c.value, digits(c)).because(c.reason.as_deref()))
                            @if c.value.is_some() { (degrees(c)) (uncertain(s, c)) }
                            br; small { (allowed(s, c)) }
                        }
                        td { (badge(s, c.verdict.into())) }
                    }
                    @if let Some(place) = &c.place { (place_row(s, c, place)) }
                    @for note in c.reason.iter().chain(&c.notes) { tr { td colspan="3" class="note" { (Text(note)) } } }
                }
            }
        }
    }
}

/// How far its feature is from its true place along each axis, and of what frame these are.
fn place_row(s: Style, c: &CharacteristicRecord, place: &PlaceRecord) -> Markup {
    html! {
        tr {
            td colspan="3" class="note" {
                @for (name, _, _, off) in place.coordinates() { "d" (name) "\u{a0}" (s.number(off, 4).signed()) " " }
                @match *place.frame {
                    FrameSource::Datums => { @for datum in &c.datums { " | " (datum_name(datum)) } }
                    FrameSource::Plan => { (s.word("place.plan")) }
                    FrameSource::Aligned => { (s.word("place.aligned")) }
                }
            }
        }
    }
}

/// Its uncertainty; where noise leads to one side, from and to where the true value lies, on a line of its own: beside the value it would push the
/// verdict out of view.
fn uncertain(s: Style, c: &CharacteristicRecord) -> Markup {
    let number = |x| s.number(x, digits(c));
    html! {
        @match (c.uncertainty, c.interval, c.noise_bias) {
            (_, Some([from, to]), Some(_)) => { br; small { "[" (range(number(from), number(to))) "]" (degrees(c)) } }
            (Some(u), ..) => { " ±\u{a0}" (number(u)) (degrees(c)) }
            _ => {}
        }
    }
}

/// The deviations from the reference: the verdict, the worst places, the statistics.
fn deviations(s: Style, c: &Comparison, decimals: usize, first_pick: usize) -> Markup {
    let all = c.deviation.all.count + c.excluded.values().sum::<u64>();
    let limit = |x| s.number(x, decimals).signed();
    html! {
        (section(s, "deviations", html! {
            dl.facts.pairs {
                @if let Some(verdict) = c.verdict { (fact(s, "verdict", badge(s, verdict.into()))) }
                @if let Some(t) = c.tolerance.as_ref().filter(|_| c.regions.is_empty()) {
                    (fact(s, "tolerance", range(limit(t.lower), limit(t.upper))))
                    (fact(s, "within", html! { (inside(s, t)) @if t.required < 1.0 { " " (required(s, t)) } }))
                }
                (fact(s, "excluded", compare::excluded(s, c, all)))
                (compare::rules(s, c, decimals))
            }
            @for reason in &c.verdict_reasons { p.note { "⚠ " (Text(&reason.text)) } }
            @for warning in &c.warnings { p.note { "⚠ " (Text(&warning.text)) } }
        }))
        (compare::regions(s, c, decimals))
        (compare::worst(s, c, decimals, first_pick))
        (compare::statistics(s, c, decimals))
        (compare::faces::faces(s, c, decimals))
    }
}

/// The sign of degrees behind numbers of an angle. Lengths have none: the page is in millimeters.
fn degrees(c: &CharacteristicRecord) -> &'static str {
    if c.unit == "deg" { "°" } else { "" }
}

/// Digits after the point of value and limits: so many that a value which is not a limit does not look like it.
fn digits(c: &CharacteristicRecord) -> usize {
    c.decimals(if c.unit == "mm" { 4 } else { 3 })
}

fn allowed(s: Style, c: &CharacteristicRecord) -> Markup {
    let limit = |x| s.number(x, digits(c));
    html! {
        @match (c.nominal, c.lower) {
            (Some(_), Some(lower)) => { (limit(lower)) " … " (limit(c.upper)) (degrees(c)) }
            _ => {
                (if c.diametral() { "≤\u{a0}⌀" } else { "≤\u{a0}" }) (limit(c.upper))
                @if let Some((t, material)) = c.requirement() {
                    " (" (limit(t)) "\u{a0}" (requirement(material.word())) ")"
                }
            }
        }
    }
}

fn features(s: Style, d: &InspectDocument) -> Markup {
    let note = |text: Markup| html! { tr { td colspan="4" class="note" { (text) } } };
    let rows = d.features.iter().map(|f| {
        let called = html! { (Name(&f.id)) " " (s.word(format!("shape.{}", f.shape))) };
        let form = s.optional(f.form_error, 4).because(reason(f));
        let coverage = s.optional_percent(f.coverage, 1).because(f.coverage_reason.as_deref());
        let classes = f.classes();
        let under = html! {
            @if !classes.is_empty() {
                (note(html! {
                    @for (k, (class, count)) in classes.into_iter().enumerate() {
                        @if k > 0 { " · " } (s.count(count)) " " (s.word(class))
                    }
                }))
            }
            @if !f.faces.is_empty() {
                (note(html! {
                    (s.word("partition"))
                    @for (k, face) in f.faces.iter().enumerate() {
                        @if k > 0 { "," } " " (compare::faces::called(face))
                    }
                }))
            }
            @if let Some(measured) = &f.measured {
                (note(html! {
                    (s.word("place.measured")) " " (place(s, measured))
                    @if let Some(nominal) = &f.nominal { br; (s.word("place.nominal")) " " (place(s, nominal)) }
                }))
            }
        };
        Row::of(&[&called, &s.count(f.points), &form, &coverage]).then(under)
    });
    table(s, None, [&[""], &["points", "form_error", "coverage"]], rows)
}

/// A place, and a diameter or angle.
fn place(s: Style, p: &MeasuredPlace) -> Markup {
    html! {
        "(" @for (k, x) in p.place.iter().enumerate() { @if k > 0 { ", " } (s.number(*x, 4)) } ")"
        @if let Some(d) = p.diameter { " ⌀\u{a0}" (s.number(d, 4)) }
        @if let Some(a) = p.angle { " " (s.number(a, 3)) "°" }
    }
}

fn reason(f: &FeatureRecord) -> Option<&str> {
    f.reason.as_deref().or(f.uncertainty_reason.as_deref())
}
