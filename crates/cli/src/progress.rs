//! Progress on stderr, and the interrupt key.

use crate::command::ProgressStyle;
use crate::console;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle as BarStyle};
use std::io::IsTerminal;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};
use trueness_geom::progress::Progress;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on the interrupt key cancels what is running; unfinished files are removed on the way out.
pub fn stop_on_interrupt() {
    // Without a handler the key ends the program as it always does: nothing to report.
    let _ = ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed));
}

/// One stage of work with a known or unknown number of items.
pub struct Stage {
    name: &'static str,
    unit: &'static str,
    total: Option<u64>,
    done: AtomicU64,
    start: Instant,
    next: Mutex<Instant>,
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
        let shown = match style {
            ProgressStyle::Auto if std::io::stderr().is_terminal() => Shown::Bar(bar(name, unit, total)),
            ProgressStyle::Plain => Shown::Plain,
            ProgressStyle::Json => Shown::Json,
            ProgressStyle::Auto | ProgressStyle::None => Shown::Nothing,
        };
        let now = Instant::now();
        Stage { name, unit, total, done: AtomicU64::new(0), start: now, next: Mutex::new(now + PAUSE), shown }
    }

    fn line(&self, done: u64) {
        let seconds = self.start.elapsed().as_secs_f64();
        let rate = done as f64 / seconds.max(1e-9);
        let left = self.total.map(|t| t.saturating_sub(done) as f64 / rate.max(1e-9));
        if let Shown::Json = self.shown {
            let line = serde_json::json!({"event": "progress", "stage": self.name, "unit": self.unit, "done": done, "total": self.total, "per_second": rate.round(), "seconds_left": left});
            return console::note(&line.to_string());
        }
        let of = self.total.map(|t| format!(" of {}", console::grouped(t))).unwrap_or_default();
        let left = left.map(|s| format!(", {s:.0} s left")).unwrap_or_default();
        let text = format!(
            "{}: {}{of} {}, {:.2} M/s{left}",
            self.name,
            console::grouped(done),
            self.unit,
            rate / 1e6
        );
        console::note(&text);
    }
}

fn bar(name: &'static str, unit: &'static str, total: Option<u64>) -> ProgressBar {
    let b = ProgressBar::with_draw_target(total, ProgressDrawTarget::stderr_with_hz(10));
    let template = match total {
        Some(_) => "{prefix} {wide_bar} {human_pos}/{human_len} {msg} {per_sec} {eta} left",
        None => "{prefix} {spinner} {human_pos} {msg} {per_sec}",
    };
    if let Ok(style) = BarStyle::with_template(template) {
        b.set_style(style);
    }
    b.set_prefix(name);
    b.set_message(unit);
    b
}

impl Progress for Stage {
    fn advance(&self, items: u64) {
        let done = self.done.fetch_add(items, Ordering::Relaxed) + items;
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
        INTERRUPTED.load(Ordering::Relaxed)
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
