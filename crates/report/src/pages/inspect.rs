//! The page of an inspection: the verdict, every characteristic with its value, the features.

use crate::headline::Headline;
use crate::number::Style;
use crate::page::parts::{badge, fact, key_number, section};
use crate::page::symbols::{datum_name, path, requirement, symbol};
use crate::pages::align::{Facts, alignment, chip};
use crate::pages::compare;
use crate::subject::{Frame, Head, Map, Pick, Subject};
use crate::values::{Name, Optional, Percent, Text};
use maud::{Markup, html};
use serde_json::Value;
use trueness_document::Verdict;
use trueness_document::compare::{Comparison, ToleranceShares};
use trueness_document::inspect::{
    AlignmentRecord, CharacteristicRecord, FeatureRecord, FrameSource, InspectDocument, MeasuredPlace,
    PlaceRecord,
};
use trueness_document::scale::Scale;

impl Subject for InspectDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        self.verdict.into()
    }

    fn title(&self) -> Option<&str> {
        self.title.as_deref()
    }

    fn picture(&self) -> &'static str {
        "picture.inspect"
    }

    fn numbers(&self, s: Style) -> Markup {
        let regions = self.deviation.as_ref().filter(|d| !d.regions.is_empty());
        let within = self.deviation.as_ref().filter(|_| regions.is_none()).and_then(|d| d.tolerance.as_ref());
        let outside = (within.is_some() || regions.is_some())
            && self.deviation.as_ref().and_then(|d| d.verdict) != Some(Verdict::Pass);
        // Where the deviations alone fail, they lead.
        let alone = outside && self.counts.fail == 0;
        let share = |t| html! { (share(s, t)) @if t.required < 1.0 { " " small { (required(s, t)) } } };
        let all = s.len(&self.characteristics);
        let of = facts(&self.alignment);
        let told = Some(&of).filter(|of| of.left_out.is_some_and(|n| n > 0) || !of.warnings.is_empty());
        html! {
            dl.key-numbers {
                @if let Some(c) = regions.filter(|_| alone) {
                    (key_number(s, "regions.pass", "lead", compare::passing(s, c)))
                }
                @if let Some(t) = within.filter(|_| alone) { (key_number(s, "deviations.within", "lead", share(t))) }
                @for (key, class, count) in counts(self, !alone) {
                    (key_number(s, key, class, html! {
                        (s.count(count)) @if class == "lead" { " " small { "/\u{a0}" (all) } }
                    }))
                }
                (compare::because(s, &self.verdict_reasons))
                (key_number(s, "characteristics", "", all))
                @if let Some(c) = regions.filter(|_| !alone) {
                    (key_number(s, "regions.pass", if outside { "warn" } else { "" }, compare::passing(s, c)))
                }
                @if let Some(t) = within.filter(|_| !alone) {
                    (key_number(s, "deviations.within", if outside { "warn" } else { "" }, share(t)))
                }
                @if let Some(chip) = told.and_then(|of| chip(s, of, 4)) { (chip) }
            }
        }
    }

    fn list(&self, s: Style) -> Markup {
        let (of, facts) = (&self.alignment, facts(&self.alignment));
        // Where nothing else can be believed, this comes first.
        let (first, last) =
            if of.doubts().next().is_some() { (Some(&facts), None) } else { (None, Some(&facts)) };
        html! {
            (compare::reasons(s, &self.verdict_reasons))
            @if let Some(facts) = first { (alignment(s, facts)) }
            (section(s, "characteristics", characteristics(s, self)))
            @if let (Some(c), Some(scale)) = (&self.deviation, &self.scale) {
                (deviations(s, c, scale.decimals as usize, self.characteristics.len()))
            }
            (section(s, "features", features(s, self)))
            @if let Some(facts) = last { (alignment(s, facts)) }
        }
    }

    fn method(&self, s: Style) -> Markup {
        let mut standards: Vec<&str> = self.characteristics.iter().map(|c| c.standard.as_str()).collect();
        standards.sort_unstable();
        standards.dedup();
        html! {
            p { (s.word("method.inspect.text")) }
            p { (s.word(format!("decision.{}.text", self.decision_rule))) }
            ul { @for standard in standards { li { (Text(standard)) } } }
        }
    }

    fn how(&self, s: Style) -> Markup {
        html! { (s.word("decision")) ": " (s.word(format!("decision.{}", self.decision_rule))) }
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

    fn json(&self) -> serde_json::Result<Value> {
        let mut document = serde_json::to_value(self)?;
        // The page has a map of its own.
        document.as_object_mut().and_then(|members| members.shift_remove("deviation_map"));
        Ok(document)
    }
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

/// How many characteristics have each verdict, the worst first, with the class of that number: the worst one leads, if they do.
fn counts(d: &InspectDocument, mut lead: bool) -> Vec<(&'static str, &'static str, u64)> {
    let n = &d.counts;
    let all = [
        ("verdict.fail", n.fail, "warn"),
        ("verdict.undecided", n.undecided, "warn"),
        ("verdict.not_measured", n.not_measured, "warn"),
        ("verdict.pass", n.pass, ""),
    ];
    let shown = all.into_iter().filter(|(key, count, _)| *count > 0 || *key == "verdict.pass");
    shown
        .map(|(key, count, class)| {
            let leads = count > 0 && std::mem::take(&mut lead);
            (key, if leads { "lead" } else { class }, count)
        })
        .collect()
}

/// The share of the deviations within tolerance.
fn share<'a>(s: Style, t: &'a ToleranceShares) -> Optional<'a, Percent> {
    s.optional_percent(t.inside, 2).because(t.inside_reason.as_deref())
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
            (_, Some([from, to]), Some(_)) => { br; small { "[" (number(from)) "\u{2009}…\u{2009}" (number(to)) "]" (degrees(c)) } }
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
                    (fact(s, "tolerance", html! { (limit(t.lower)) "\u{2009}…\u{2009}" (limit(t.upper)) }))
                    (fact(s, "within", html! { (share(s, t)) @if t.required < 1.0 { " " (required(s, t)) } }))
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
    html! {
        table {
            thead {
                tr {
                    th {} th.r { (s.word("points")) } th.r { (s.word("form_error")) } th.r { (s.word("coverage")) }
                }
            }
            tbody {
                @for f in &d.features {
                    tr {
                        td { (Name(&f.id)) " " (s.word(format!("shape.{}", f.shape))) }
                        td.r { (s.count(f.points)) }
                        td.r { (s.optional(f.form_error, 4).because(reason(f))) }
                        td.r { (s.optional_percent(f.coverage, 1).because(f.coverage_reason.as_deref())) }
                    }
                    @let classes = f.classes();
                    @if !classes.is_empty() {
                        tr { td colspan="4" class="note" {
                            @for (k, (class, count)) in classes.into_iter().enumerate() {
                                @if k > 0 { " · " } (s.count(count)) " " (s.word(class))
                            }
                        } }
                    }
                    @if let Some(measured) = &f.measured {
                        tr { td colspan="4" class="note" {
                            (s.word("place.measured")) " " (place(s, measured))
                            @if let Some(nominal) = &f.nominal { br; (s.word("place.nominal")) " " (place(s, nominal)) }
                        } }
                    }
                }
            }
        }
    }
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
