//! Bundles `web/` into one script with Vite, in `OUT_DIR`: the source tree is never written to.
//!
//! `TRUENESS_VIEWER` says what happens: `auto` (the default: build where Node is present, else go on without and warn),
//! `require` (no viewer is an error: releases), `off` (no viewer, no warning), or the path of a script built elsewhere.

#![allow(clippy::unwrap_used, reason = "a build script can tell nobody but cargo, and cargo shows the panic")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// What the bundle is made of. Never `node_modules`: an `npm install` there must not rebuild the crate.
const SOURCES: [&str; 5] = ["src", "package.json", "package-lock.json", "vite.config.ts", "tsconfig.json"];

fn main() {
    let web = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap()).join("web");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap());
    for source in SOURCES {
        println!("cargo::rerun-if-changed=web/{source}");
    }
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=TRUENESS_VIEWER");
    println!("cargo::rustc-check-cfg=cfg(viewer_built)");
    let mode = env::var("TRUENESS_VIEWER").unwrap_or_else(|_| "auto".into());
    let built = match mode.as_str() {
        "off" => Err("TRUENESS_VIEWER=off".to_string()),
        "auto" | "require" if env::var_os("DOCS_RS").is_some() => Err("documentation build".to_string()),
        "auto" | "require" => bundle(&web, &out.join("web")),
        path => {
            println!("cargo::rerun-if-changed={path}");
            Ok(PathBuf::from(path))
        }
    };
    let script = built.and_then(|p| fs::read_to_string(&p).map_err(|e| format!("{}: {e}", p.display())));
    let target = out.join("viewer.js");
    match script {
        Ok(text) => {
            println!("cargo::rustc-cfg=viewer_built");
            fs::write(target, text).unwrap();
        }
        Err(reason) if mode == "require" => {
            println!("cargo::error=the 3D viewer cannot be built: {reason}");
            std::process::exit(1);
        }
        Err(reason) => {
            fs::write(target, "").unwrap();
            if mode != "off" {
                println!(
                    "cargo::warning=built without the 3D viewer (reports keep tables and a picture): {reason}"
                );
                // A path that is not there makes cargo try again on the next build.
                println!("cargo::rerun-if-changed={}", out.join("try-again").display());
            }
        }
    }
}

/// Copies the sources, installs what the lock file names unless that is there already, and runs Vite.
fn bundle(web: &Path, work: &Path) -> Result<PathBuf, String> {
    node_is_new_enough()?;
    let copied = work.join("src");
    if copied.exists() {
        fs::remove_dir_all(&copied).map_err(|e| format!("{}: {e}", copied.display()))?;
    }
    for source in SOURCES {
        copy(&web.join(source), &work.join(source)).map_err(|e| format!("{source}: {e}"))?;
    }
    let lock = fs::read(work.join("package-lock.json")).map_err(|e| format!("package-lock.json: {e}"))?;
    let stamp = work.join("node_modules").join(".installed");
    if fs::read(&stamp).ok().as_deref() != Some(&lock[..]) {
        let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
        let install = ["ci", "--ignore-scripts", "--omit=dev", "--no-audit", "--no-fund", "--prefer-offline"];
        run(Command::new(npm).args(install).current_dir(work))?;
        fs::write(&stamp, &lock).map_err(|e| format!("{}: {e}", stamp.display()))?;
    }
    run(Command::new("node").args(["node_modules/vite/bin/vite.js", "build"]).current_dir(work))?;
    Ok(work.join("dist").join("viewer.js"))
}

fn node_is_new_enough() -> Result<(), String> {
    let version = run(Command::new("node").arg("--version")).map_err(|e| format!("Node.js: {e}"))?;
    let mut numbers = version.trim().trim_start_matches('v').split('.').map(|n| n.parse().unwrap_or(0));
    let (major, minor): (u32, u32) = (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0));
    if (major, minor) >= (20, 19) {
        Ok(())
    } else {
        Err(format!("Node.js {} is older than 20.19", version.trim()))
    }
}

/// Standard output of a command, or the first lines of what it complained about.
fn run(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|e| format!("{name}: {e}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    let lines: Vec<&str> = complaint.lines().filter(|l| !l.contains("npm warn")).take(3).collect();
    Err(format!("{name} failed: {}", lines.join(" / ")))
}

fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    if !from.is_dir() {
        return fs::copy(from, to).map(|_| ());
    }
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        copy(&entry.path(), &to.join(entry.file_name()))?;
    }
    Ok(())
}
