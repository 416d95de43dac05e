//! Progress on stderr.

use crate::options::ProgressStyle;
use crate::time_left::{TimeLeft, shown};
use crate::{console, number, signals};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle as BarStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use trueness_geom::progress::Progress;

/// One stage of work with a known or unknown number of items.
pub struct Stage {
    name: &'static str,
    unit: &'static str,
    total: Option<u64>,
    done: AtomicU64,
    start: Instant,
    next: Mutex<Instant>,
    left: Arc<Mutex<TimeLeft>>,
    shown: Shown,
}

enum Shown {
    Bar(ProgressBar),
    Plain,
    Json,
    Nothing,
}

/// Time between two lines of the plain and JSON styles.
const PAUSE: Duration = Duration::from_secs(2);

impl Stage {
    /// Starts a stage of `total` items (unknown: `None`), called `unit` in the display.
    pub fn new(style: ProgressStyle, name: &'static str, unit: &'static str, total: Option<u64>) -> Stage {
        let left = Arc::new(Mutex::new(TimeLeft::default()));
        let shown = match style {
            ProgressStyle::Auto if std::io::stderr().is_terminal() => {
                Shown::Bar(bar(name, unit, total, left.clone()))
            }
            ProgressStyle::Plain => Shown::Plain,
            ProgressStyle::Json => Shown::Json,
            ProgressStyle::Auto | ProgressStyle::None => Shown::Nothing,
        };
        let now = Instant::now();
        Stage {
            name,
            unit,
            total,
            done: AtomicU64::new(0),
            start: now,
            next: Mutex::new(now + PAUSE),
            left,
            shown,
        }
    }

    fn line(&self, done: u64) {
        let time = self.start.elapsed();
        let (rate, left) = match self.left.lock() {
            Ok(left) => (left.rate(time, done), self.total.and_then(|total| left.seconds(time, done, total))),
            Err(_) => (None, None),
        };
        // Of a short stage, or before much is done, what is known is the mean since its start.
        let rate = rate.unwrap_or(done as f64 / time.as_secs_f64().max(1e-9));
        if let Shown::Json = self.shown {
            let line = serde_json::json!({"event": "progress", "stage": self.name, "unit": self.unit, "done": done, "total": self.total, "per_second": rate.round(), "seconds_left": left});
            return console::note(&line.to_string());
        }
        let of = self.total.map(|t| format!(" of {}", number::grouped(t))).unwrap_or_default();
        let left = left.map(|s| format!(", {} left", shown(s))).unwrap_or_default();
        let text = format!(
            "{}: {}{of} {}, {:.2} M/s{left}",
            self.name,
            number::grouped(done),
            self.unit,
            rate / 1e6
        );
        console::note(&text);
    }
}

fn bar(
    name: &'static str,
    unit: &'static str,
    total: Option<u64>,
    left: Arc<Mutex<TimeLeft>>,
) -> ProgressBar {
    let b = ProgressBar::with_draw_target(total, ProgressDrawTarget::stderr_with_hz(10));
    let template = match total {
        Some(_) => "{prefix} {wide_bar} {human_pos}/{human_len} {msg}{left}",
        None => "{prefix} {spinner} {human_pos} {msg}{left}",
    };
    if let Ok(style) = BarStyle::with_template(template) {
        b.set_style(style.with_key("left", move |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            let Ok(left) = left.lock() else { return };
            let (time, done) = (state.elapsed(), state.pos());
            if let Some(rate) = left.rate(time, done) {
                let _ = write!(out, " {}/s", number::grouped(rate as u64));
            }
            if let Some(seconds) = state.len().and_then(|total| left.seconds(time, done, total)) {
                let _ = write!(out, " {} left", shown(seconds));
            }
        }));
    }
    b.set_prefix(name);
    b.set_message(unit);
    b
}

impl Progress for Stage {
    fn advance(&self, items: u64) {
        let done = self.done.fetch_add(items, Ordering::Relaxed) + items;
        if !matches!(self.shown, Shown::Nothing)
            && let Ok(mut left) = self.left.try_lock()
        {
            left.mark(self.start.elapsed(), done);
        }
        match &self.shown {
            Shown::Bar(b) => b.set_position(done),
            Shown::Nothing => {}
            Shown::Plain | Shown::Json => {
                let now = Instant::now();
                if let Ok(mut next) = self.next.try_lock()
                    && now >= *next
                {
                    *next = now + PAUSE;
                    self.line(done);
                }
            }
        }
    }
    fn cancelled(&self) -> bool {
        signals::received()
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        match &self.shown {
            Shown::Bar(b) => b.finish_and_clear(),
            Shown::Plain | Shown::Json => self.line(self.done.load(Ordering::Relaxed)),
            Shown::Nothing => {}
        }
    }
}
