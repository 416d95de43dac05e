//! What the page may do: run its own script, use its own styles, show its own pictures. Nothing else, no request.

use super::super::payload::base64;
use sha2::{Digest, Sha256};

/// The content security policy as a `<meta>` element.
pub fn meta() -> String {
    let hash = |text: &str| format!("'sha256-{}'", base64(&Sha256::digest(text.as_bytes())));
    let script = if trueness_viewer::BUILT { hash(trueness_viewer::SCRIPT) } else { "'none'".into() };
    let policy = [
        "default-src 'none'".to_string(),
        format!("script-src {script}"),
        format!("style-src {}", hash(trueness_viewer::STYLE)),
        "img-src data: blob:".into(),
        "worker-src blob:".into(),
        "connect-src 'none'".into(),
        "base-uri 'none'".into(),
        "form-action 'none'".into(),
        "require-trusted-types-for 'script'".into(),
        "trusted-types trueness".into(),
    ];
    format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">", policy.join("; "))
}
