//! Progress on stderr.

use crate::options::ProgressStyle;
use crate::time_left::{TimeLeft, shown};
use crate::{console, memory, number, signals};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle as BarStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use trueness::task::{self, Watch};
use trueness_geom::progress::Progress;

/// The terminal: progress on stderr, signals.
pub struct Console {
    /// How progress is shown.
    pub style: ProgressStyle,
}

impl Watch for Console {
    fn stage(&self, name: &'static str, unit: &'static str, total: Option<u64>) -> Box<dyn task::Stage + '_> {
        Box::new(Stage::new(self.style, name, unit, total))
    }
    fn note(&self, text: &str) {
        console::note(text);
    }
    fn memory(&self) -> Option<u64> {
        memory::available()
    }
}

impl task::Stage for Stage {
    fn finish(self: Box<Self>) {
        self.end(&Ok::<(), ()>(()));
    }
}

/// One stage of work with a known or unknown number of items.
///
/// It never tells more than the total: what is gone through again counts once. A stage that answers ends at its total.
pub struct Stage {
    name: &'static str,
    unit: &'static str,
    total: Option<u64>,
    done: AtomicU64,
    start: Instant,
    next: Mutex<Instant>,
    left: Arc<Mutex<TimeLeft>>,
    ended: bool,
    shown: Shown,
}

enum Shown {
    Bar(ProgressBar),
    Plain,
    Json,
    Nothing,
}

/// Time between two lines of the plain and JSON styles.
const LINE_INTERVAL: Duration = Duration::from_secs(2);

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
            next: Mutex::new(now + LINE_INTERVAL),
            left,
            ended: false,
            shown,
        }
    }

    /// Ends the stage; where it has its `answer`, all of it is done.
    pub fn end<T, E>(mut self, answer: &Result<T, E>) {
        self.ended = answer.is_ok();
        if let Some(total) = self.total.filter(|_| self.ended) {
            self.done.store(total, Ordering::Relaxed);
        }
    }

    fn at_most(&self, done: u64) -> u64 {
        self.total.map_or(done, |total| done.min(total))
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
            let line = serde_json::json!({"event": "progress", "stage": self.name, "unit": self.unit, "done": done, "total": self.total, "ended": self.ended, "per_second": rate.round(), "seconds_left": left});
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
        let done = self.at_most(self.done.fetch_add(items, Ordering::Relaxed) + items);
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
                    *next = now + LINE_INTERVAL;
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
            Shown::Plain | Shown::Json => self.line(self.at_most(self.done.load(Ordering::Relaxed))),
            Shown::Nothing => {}
        }
    }
}
