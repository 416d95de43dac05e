//! The oldest compiler that the manifest promises.

use std::fs;
use std::path::Path;
use std::process::Command;

/// Checks the workspace with the `rust-version` of the manifest; rustup brings that compiler if it can.
pub fn run(root: &Path) -> bool {
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap_or_default();
    let written = |line: &str| line.strip_prefix("rust-version = ").map(|v| v.trim_matches('"').to_string());
    let Some(version) = manifest.lines().find_map(written) else {
        eprintln!("Cargo.toml: there is no line `rust-version = \"…\"`");
        return false;
    };
    let done = |words: &[&str]| {
        let mut command = Command::new("rustup");
        // The compiler that runs this task would come first otherwise.
        command.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN").current_dir(root);
        command.args(words).status().is_ok_and(|status| status.success())
    };
    if !done(&["toolchain", "install", &version, "--profile", "minimal", "--no-self-update"]) {
        println!("SKIPPED: the oldest compiler. Rust {version} cannot be had by rustup.");
        return !crate::requires_all();
    }
    let check =
        ["cargo", "check", "--workspace", "--all-targets", "--locked", "--target-dir", "target/oldest"];
    done(&[&["run", version.as_str()][..], &check].concat())
}
