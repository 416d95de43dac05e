//! Ctrl-C ends every command, wherever it is, before a person notices.
#![cfg(unix)]
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;
use common::*;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Time from the signal to the end of the program, as promised.
const BOUND: Duration = Duration::from_millis(200);
/// How often a run may be tried again until it ends within the bound: other work on the machine only ever makes it later, and a
/// loop that does not hear the signal is late every time.
const TRIES: usize = 8;
/// Where in its run each command is interrupted, as shares of the time that it takes when left alone.
const MOMENTS: [f64; 3] = [0.15, 0.5, 0.85];

/// What the runs write.
const NEW: [&str; 4] = ["new", "new.off", "new.ply", "new.html"];

/// A bumpy sphere of 2 n² facets as an OFF file.
fn bumpy_sphere(n: usize) -> String {
    let mut off = format!("OFF\n{} {} 0\n", (n + 1) * n, 2 * n * n);
    for i in 0..=n {
        for j in 0..n {
            let theta = std::f64::consts::PI * i as f64 / n as f64;
            let phi = std::f64::consts::TAU * j as f64 / n as f64;
            let r = 1.0 + 0.05 * (7.0 * theta).sin() * (9.0 * phi).cos();
            let (x, y) = (r * theta.sin() * phi.cos(), r * theta.sin() * phi.sin());
            writeln!(off, "{x} {y} {}", r * theta.cos()).unwrap();
        }
    }
    for i in 0..n {
        for j in 0..n {
            let (a, b) = (i * n + j, i * n + (j + 1) % n);
            let (c, d) = (a + n, b + n);
            writeln!(off, "3 {a} {c} {b}\n3 {b} {c} {d}").unwrap();
        }
    }
    off
}

/// `n` points near a sphere, evenly turned by the golden angle, their radii spread by a few hundredths.
fn points(n: usize) -> String {
    let mut xyz = String::new();
    for i in 0..n {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / n as f64;
        let r = 1.0 + 0.03 * (i as f64 * 12.9898).sin();
        let (s, phi) = ((1.0 - z * z).sqrt(), i as f64 * 2.399_963_229_728_653);
        writeln!(xyz, "{:.6} {:.6} {:.6}", r * s * phi.cos(), r * s * phi.sin(), r * z).unwrap();
    }
    xyz
}

/// `n` triangles of which each crosses hundreds of others, as an OFF file.
fn tangle(n: usize) -> String {
    let mut off = format!("OFF\n{} {n} 0\n", 3 * n);
    for i in 0..3 * n {
        let [x, y, z] = [0.754_877_67, 0.569_840_29, 0.437_016_02].map(|k| (i as f64 * k).fract());
        writeln!(off, "{x} {y} {z}").unwrap();
    }
    (0..n).for_each(|i| writeln!(off, "3 {} {} {}", 3 * i, 3 * i + 1, 3 * i + 2).unwrap());
    off
}

/// Whether this process ignores the signal of that number, as in the background of a script: then its children do too.
fn is_ignored(number: u32) -> bool {
    let own = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = own.lines().find_map(|l| l.strip_prefix("SigIgn:")).map(str::trim);
    mask.and_then(|m| u64::from_str_radix(m, 16).ok()).is_some_and(|m| m >> (number - 1) & 1 == 1)
}

fn start(folder: &Path, words: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trueness"));
    command.current_dir(folder).args(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

/// How long the run lasts when left alone.
fn whole(folder: &Path, words: &[&str]) -> Duration {
    let begun = Instant::now();
    let status = start(folder, words).wait().unwrap();
    assert!(matches!(status.code(), Some(0 | 1)), "{words:?}: {status}");
    begun.elapsed()
}

/// Interrupts the run after `wait`: how long it then goes on, and its exit status; `None` where it had ended before.
fn interrupted(
    folder: &Path,
    words: &[&str],
    wait: Duration,
    signal: &str,
) -> Option<(Duration, Option<i32>)> {
    let mut child = start(folder, words);
    std::thread::sleep(wait);
    if child.try_wait().unwrap().is_some() {
        return None;
    }
    let begun = Instant::now();
    Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    let status = child.wait().unwrap();
    let lasted = begun.elapsed();
    // It may have been about to end by itself.
    (!matches!(status.code(), Some(0 | 1))).then_some((lasted, status.code()))
}

#[test]
fn ctrl_c_ends_every_command_within_a_fifth_of_a_second() {
    let (signal, status) = if is_ignored(2) { ("-TERM", 143) } else { ("-INT", 130) };
    let f = Folder::new();
    f.write("mesh.off", bumpy_sphere(140));
    f.write("tangle.off", tangle(2000));
    f.write("points.xyz", points(50_000));
    f.write("many.xyz", points(600_000));
    let commands: [&[&str]; 8] = [
        &["fit", "many.xyz", "--shape", "plane"],
        &["check", "tangle.off", "--json", "new"],
        &["repair", "tangle.off", "-o", "new.off"],
        &["repair", "mesh.off", "-o", "new.off"],
        &["compare", "points.xyz", "mesh.off", "--out", "new.ply"],
        &["compare", "points.xyz", "mesh.off", "--html", "new.html"],
        &["segment", "mesh.off", "--json", "new"],
        &["fit", "points.xyz", "--shape", "cylinder", "--method", "minimum-zone", "--json", "new"],
    ];
    for words in commands {
        let mut all = whole(&f.0, words);
        for share in MOMENTS {
            let mut least = Duration::MAX;
            for _ in 0..TRIES {
                NEW.iter().for_each(|name| drop(std::fs::remove_file(f.file(name))));
                let Some((lasted, ended)) = interrupted(&f.0, words, all.mul_f64(share), signal) else {
                    // Other work had made the run longer when it was left alone.
                    all = all.mul_f64(0.8);
                    continue;
                };
                assert_eq!(ended, Some(status), "{words:?} at {share}");
                assert_eq!(f.names(), ["many.xyz", "mesh.off", "points.xyz", "tangle.off"], "{words:?}");
                least = least.min(lasted);
                if least <= BOUND {
                    break;
                }
            }
            assert!(least <= BOUND, "{words:?}: {least:?} after the signal, at {share} of {all:?}");
        }
    }
}
