//! An alignment for people.

use crate::console;
use crate::inputs;
use crate::number::{POINTS, counted, fixed, grouped, scientific, signed, six_digits};
use std::fmt::Write;
use trueness::task::Done;
use trueness_document::align::AlignDocument;

/// The document for people.
pub fn text(done: &Done<AlignDocument>) -> String {
    let document = &done.document;
    let mut out = inputs::notes(&document.inputs);
    let _ = writeln!(out, "reference from measured by {}, mm", document.method);
    let rows: Vec<Vec<String>> =
        document.transform.iter().map(|row| row.iter().map(|x| fixed(*x, 12)).collect()).collect();
    out.push_str(&console::columns(&rows));
    let settled = if document.converged { "settled" } else { "not settled" };
    let _ = writeln!(
        out,
        "rms {}   mean {}   {} after {}",
        six_digits(document.rms),
        six_digits(document.mean_abs),
        settled,
        counted(document.iterations, ["step", "steps"])
    );
    if let (Some(scale), Some(u)) = (document.scale, document.scale_std_uncertainty) {
        let _ = writeln!(
            out,
            "scale {} ± {} (one standard deviation): the scan is made so many times as large",
            fixed(scale, 9),
            scientific(u, 1)
        );
    }
    if let Some(lock) = &document.lock {
        let [x, y, z] = lock.center.map(six_digits);
        let _ = writeln!(out, "locked: {}, about {x}, {y}, {z}", lock.axes.join(", "));
    }
    searched(document, &mut out);
    if let Some(fit) = &document.best_fit {
        let _ = writeln!(
            out,
            "{} count, {} left out   share of the surface {} %   median {}",
            counted(fit.used, POINTS),
            grouped(fit.left_out),
            fixed(100.0 * fit.share, 1),
            six_digits(fit.median)
        );
        let u = fit.std_uncertainty;
        let open = trueness_measure::align::open(document);
        let told = |k: usize, x: f64| if open[k] { "free".into() } else { scientific(x, 1) };
        let degrees = [0, 1, 2].map(|k| told(k, u[k].to_degrees())).join(" ");
        let lengths = [3, 4, 5].map(|k| told(k, u[k])).join(" ");
        let _ = writeln!(out, "standard uncertainty: rotation {degrees} degrees, translation {lengths} mm");
    }
    for pair in &document.pairs {
        let amplified = pair
            .amplification
            .map(|by| format!("   1 mm of error there moves the farthest corner by {} mm", fixed(by, 2)));
        let _ = writeln!(
            out,
            "row {}: {}{}",
            pair.row + 1,
            six_digits(pair.residual),
            amplified.unwrap_or_default()
        );
    }
    for warning in &document.warnings {
        let _ = writeln!(out, "! {}", warning.text);
    }
    for loss in &done.losses {
        let (file, by) = (loss.path.display(), scientific(loss.farthest, 1));
        let _ = writeln!(out, "{file}: its format rounds by up to {by} mm");
    }
    out
}

/// What a search that began with the best fit found.
fn searched(document: &AlignDocument, out: &mut String) {
    if let Some(found) = &document.chebyshev {
        let [x, y, z] = found.at.map(six_digits);
        let _ = writeln!(
            out,
            "greatest distance {} at {x}, {y}, {z}: the least near the best fit",
            six_digits(found.greatest)
        );
        let _ = writeln!(
            out,
            "{} count, {} left out; of the best fit:",
            counted(found.used, POINTS),
            grouped(found.left_out)
        );
    }
    if let Some(found) = &document.zones {
        let [x, y, z] = found.at.map(six_digits);
        let [lower, upper] = found.tolerance.map(signed);
        let _ = writeln!(
            out,
            "greatest excess {} at {x}, {y}, {z} (deviation {}, allowed {lower} … {upper}){}",
            signed(found.excess),
            signed(found.deviation),
            match found.left_out {
                0 => ": the least near the best fit".into(),
                _ => format!("; of the points that count in the search {}", signed(found.least)),
            }
        );
        let within = match found.beyond {
            0 => format!("all {} within", counted(found.used, POINTS)),
            beyond => format!("{} of {} beyond", grouped(beyond), counted(found.used, POINTS)),
        };
        let (without, left_out) = (grouped(found.without_zone), grouped(found.left_out));
        let _ = writeln!(
            out,
            "{within}, {without} at places without a tolerance, {left_out} left out in the search; of the best fit:"
        );
    }
}
