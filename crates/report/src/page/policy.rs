//! What the page may do: run its own script, use its own styles, show its own pictures. Nothing else, no request.

use super::super::payload::base64;
use maud::{Markup, html};
use sha2::{Digest, Sha256};

/// Letters of a running head, at most.
const MAX_HEAD_LETTERS: usize = 90;

/// The style that prints names at the head of each page but the first, which has them already.
pub fn running_head(names: &[Option<&str>]) -> String {
    let mut given: Vec<&str> = vec![];
    for name in names.iter().flatten() {
        if !given.contains(name) {
            given.push(name);
        }
    }
    let text = given.join(" · ");
    let cut = text.chars().count() > MAX_HEAD_LETTERS;
    let mut content: String = text.chars().take(MAX_HEAD_LETTERS).map(in_string).collect();
    content.push_str(if cut { "\\2026 " } else { "" });
    format!(
        "@media print{{@page{{@top-left{{content:\"{content}\";font:9pt system-ui,sans-serif;width:100%}}}}\
         @page:first{{@top-left{{content:none}}}}}}"
    )
}

/// A letter of a string in a style sheet: all but plain letters, digits and blanks as their numbers, so that nothing can end
/// the string or the element.
fn in_string(c: char) -> String {
    match c {
        ' ' | '0'..='9' | 'A'..='Z' | 'a'..='z' => c.to_string(),
        c if c.is_control() => "\\fffd ".into(),
        c => format!("\\{:x} ", u32::from(c)),
    }
}

/// The content security policy as a `<meta>` element; `running` is the page's own style.
pub fn meta(running: &str) -> Markup {
    let hash = |text: &str| format!("'sha256-{}'", base64(&Sha256::digest(text.as_bytes())));
    let script = if trueness_viewer::BUILT { hash(trueness_viewer::SCRIPT) } else { "'none'".into() };
    let policy = [
        "default-src 'none'".to_string(),
        format!("script-src {script}"),
        format!("style-src {} {}", hash(trueness_viewer::STYLE), hash(running)),
        "img-src data: blob:".into(),
        "worker-src blob:".into(),
        "connect-src 'none'".into(),
        "base-uri 'none'".into(),
        "form-action 'none'".into(),
        "require-trusted-types-for 'script'".into(),
        "trusted-types trueness".into(),
    ];
    html! { meta http-equiv="Content-Security-Policy" content=(policy.join("; ")); }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_ends_the_running_head() {
        let head = running_head(&[Some("a\"}</style><script>\\"), Some("№ 7"), None, Some("№ 7")]);
        assert!(
            head.contains("content:\"a\\22 \\7d \\3c \\2f style\\3e \\3c script\\3e \\5c  \\b7  \\2116  7\""),
            "{head}"
        );
        assert!(!head.contains("</") && head.matches('"').count() == 2);
        let long = running_head(&[Some(&"x".repeat(300))]);
        assert!(long.contains(&format!("\"{}\\2026 \"", "x".repeat(MAX_HEAD_LETTERS))));
    }
}
