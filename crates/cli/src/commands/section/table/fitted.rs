//! Best fit onto the nominal and verdict, for people.

use crate::console;
use crate::number::{fixed, grouped, scientific};
use std::fmt::Write;
use trueness_document::section::{FitRecord, NominalRecord};

/// Planes whose fits are shown.
const MAX_FIT_ROWS: usize = 40;

/// The best fit of each plane; nothing where none was asked for.
pub fn fits(all: &[FitRecord], several: bool) -> String {
    let Some(first) = all.first() else { return String::new() };
    let mut out = format!("best fit onto the nominal: {}\n", first.freedom);
    let head = ["", "shift x", "±", "shift y", "±", "turn", "±", "rms before", "rms", "points", "left out"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for fit in all.iter().take(MAX_FIT_ROWS) {
        let u = |u: Option<f64>| u.map_or("held".into(), |u| scientific(u, 2));
        let plane = fit.plane.filter(|_| several).map_or(String::new(), |n| format!("plane {}", n + 1));
        rows.push(vec![
            plane,
            fixed(fit.shift[0], 6),
            u(fit.shift_uncertainty[0]),
            fixed(fit.shift[1], 6),
            u(fit.shift_uncertainty[1]),
            format!("{}°", fixed(fit.turn.to_degrees(), 6)),
            u(fit.turn_uncertainty.map(f64::to_degrees)),
            scientific(fit.rms_before, 2),
            scientific(fit.rms, 2),
            grouped(fit.used),
            grouped(fit.left_out),
        ]);
    }
    out.push_str(&console::columns(&rows));
    if all.len() > MAX_FIT_ROWS {
        let _ = writeln!(out, "… and {} more", all.len() - MAX_FIT_ROWS);
    }
    for fit in all.iter().filter(|f| !f.converged).take(1) {
        let _ = writeln!(out, "! the best fit did not come to rest after {} steps", fit.iterations);
    }
    out
}

/// Shares, worst place and verdict against the tolerance; nothing without one.
pub fn verdict(found: &NominalRecord) -> String {
    let (Some(profile), Some(verdict)) = (&found.profile, found.verdict) else { return String::new() };
    let t = &profile.shares;
    let percent = |share: Option<f64>| share.map_or("–".into(), |s| format!("{} %", fixed(100.0 * s, 2)));
    let mut out = format!(
        "tolerance {:+} … {:+} (zone of the width {})   within {}   above {}   below {}\n",
        t.lower,
        t.upper,
        fixed(profile.zone_width, 4),
        percent(t.inside),
        percent(t.above),
        percent(t.below)
    );
    if let Some(w) = &profile.worst {
        let [x, y] = w.point.map(|x| fixed(x, 4));
        let _ = writeln!(out, "worst     {} at {x} {y}   contour {}", fixed(w.deviation, 6), w.contour + 1);
    }
    let _ = writeln!(
        out,
        "covered   {} of the nominal, {} of the points have a counterpart",
        percent(Some(profile.covered)),
        percent(Some(profile.counterparts))
    );
    let reasons: Vec<&str> = found.verdict_reasons.iter().map(|r| r.text.as_str()).collect();
    let because = if reasons.is_empty() { String::new() } else { format!(": {}", reasons.join("; ")) };
    let _ = writeln!(out, "verdict   {}{because}", verdict.word().to_uppercase());
    out
}
