//! The characteristics of one or several parts as CSV and as JUnit XML.

use trueness_inspect::results::Verdict;
use trueness_inspect::results::inspect::{CharacteristicRecord, InspectDocument};

/// What distinguishes the part: its measured file, or the plan's.
fn part(document: &InspectDocument) -> &str {
    document.inputs.first().map_or(&document.plan.path, |i| &i.path)
}

/// One line a characteristic, numbers with all digits (RFC 4180).
pub fn csv(documents: &[InspectDocument]) -> String {
    let head = [
        "part",
        "id",
        "kind",
        "feature",
        "datums",
        "nominal",
        "lower",
        "upper",
        "value",
        "unit",
        "uncertainty",
        "verdict",
        "utilisation",
        "reason",
    ];
    let mut out = head.join(",") + "\r\n";
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    for document in documents {
        for c in &document.characteristics {
            let cells = [
                part(document).into(),
                c.id.clone(),
                c.kind.clone(),
                c.feature.clone(),
                c.datums.join(" "),
                number(c.nominal),
                number(c.lower),
                c.upper.to_string(),
                number(c.value),
                c.unit.clone(),
                number(c.uncertainty),
                c.verdict.word().into(),
                number(c.utilisation),
                c.reason.clone().unwrap_or_default(),
            ];
            out.push_str(&cells.map(quoted).join(","));
            out.push_str("\r\n");
        }
    }
    out
}

/// A cell, in quotes where it holds what parts cells.
fn quoted(cell: String) -> String {
    match cell.contains([',', '"', '\r', '\n']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell,
    }
}

/// A test suite a part and a test case a characteristic. What fails is a failure, what nobody can tell an error, what was
/// not measured a failure too: a merge must not pass on it.
pub fn junit(documents: &[InspectDocument]) -> String {
    let count = |documents: &[InspectDocument], which: &dyn Fn(Verdict) -> bool| -> usize {
        documents.iter().flat_map(|d| &d.characteristics).filter(|c| which(c.verdict)).count()
    };
    let failed = |v| matches!(v, Verdict::Fail | Verdict::NotMeasured);
    let attributes = |documents: &[InspectDocument]| {
        format!(
            "tests=\"{}\" failures=\"{}\" errors=\"{}\"",
            count(documents, &|_| true),
            count(documents, &failed),
            count(documents, &|v| v == Verdict::Undecided)
        )
    };
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    out.push_str(&format!("<testsuites {}>\n", attributes(documents)));
    for document in documents {
        let one = std::slice::from_ref(document);
        let name = escaped(part(document));
        out.push_str(&format!("  <testsuite name=\"{name}\" {}>\n", attributes(one)));
        for c in &document.characteristics {
            out.push_str(&case(&name, c));
        }
        out.push_str("  </testsuite>\n");
    }
    out.push_str("</testsuites>\n");
    out
}

fn case(class: &str, c: &CharacteristicRecord) -> String {
    let name = escaped(&format!("{} {} {}", c.id, c.kind, c.feature));
    let start = format!("    <testcase classname=\"{class}\" name=\"{name}\"");
    let said = match (c.value, &c.reason) {
        (Some(value), _) => {
            let lower = c.lower.map_or_else(String::new, |l| format!("{l} to "));
            format!("{value} {}, allowed {lower}{}", c.unit, c.upper)
        }
        (None, Some(reason)) => reason.clone(),
        (None, None) => String::new(),
    };
    let message = escaped(&format!("{}: {said}", c.verdict.word()));
    match c.verdict {
        Verdict::Pass => format!("{start}/>\n"),
        Verdict::Undecided => format!("{start}><error message=\"{message}\"/></testcase>\n"),
        Verdict::Fail | Verdict::NotMeasured => {
            format!("{start}><failure message=\"{message}\"/></testcase>\n")
        }
    }
}

/// Text for an attribute of XML 1.0; characters that it cannot hold become U+FFFD.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push_str("&#10;"),
            '\t' => out.push_str("&#9;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_breaks_out_of_its_cell_or_attribute() {
        assert_eq!(quoted("a,\"b\"\n".into()), "\"a,\"\"b\"\"\n\"");
        assert_eq!(escaped("<a b=\"c\">&\u{1}\n"), "&lt;a b=&quot;c&quot;&gt;&amp;\u{fffd}&#10;");
    }
}
