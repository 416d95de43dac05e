//! How long a stage will still take, from how fast its items came lately.

use std::collections::VecDeque;
use std::time::Duration;

/// Times over which the rate is taken. The count starts with the first item: what a stage prepares before, such as a search tree, says
/// nothing of how fast items come.
const RATE_WINDOW: Duration = Duration::from_secs(15);
/// Least time between the first item and an estimate: two blocks that end together tell nothing.
const MIN_OBSERVED_TIME: Duration = Duration::from_millis(1500);
/// Least time between two marks.
const MIN_MARK_INTERVAL: Duration = Duration::from_millis(100);

/// What was done when.
#[derive(Default)]
pub struct TimeLeft {
    /// Time since the start and items done by then, in order, from the first item on.
    marks: VecDeque<(Duration, u64)>,
}

impl TimeLeft {
    /// Takes note that `done` items were done after `time`.
    pub fn mark(&mut self, time: Duration, done: u64) {
        if self.marks.back().is_some_and(|(last, _)| time < *last + MIN_MARK_INTERVAL) {
            return;
        }
        self.marks.push_back((time, done));
        // One mark as old as the window stays to count from.
        while self.marks.get(1).is_some_and(|(second, _)| *second + RATE_WINDOW < time) {
            self.marks.pop_front();
        }
    }

    /// Items a second; `None` while too few came.
    pub fn rate(&self, time: Duration, done: u64) -> Option<f64> {
        let (from, before) = *self.marks.front()?;
        let passed = time.checked_sub(from).filter(|passed| *passed >= MIN_OBSERVED_TIME)?;
        (done > before).then(|| (done - before) as f64 / passed.as_secs_f64())
    }

    /// Seconds until `total` items are done; `None` while that cannot be said.
    pub fn seconds(&self, time: Duration, done: u64, total: u64) -> Option<f64> {
        match total.saturating_sub(done) {
            0 => Some(0.0),
            left => self.rate(time, done).map(|rate| left as f64 / rate),
        }
    }
}

/// `95` seconds as `1 min 35 s`.
pub fn shown(seconds: f64) -> String {
    let whole = seconds.ceil() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, s) => format!("{s} s"),
        (0, m, s) => format!("{m} min {s} s"),
        (h, m, _) => format!("{h} h {m} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten seconds of preparation, then 4096 items every 40 ms: the time left is right from the first moment it is shown.
    #[test]
    fn what_comes_before_the_first_item_does_not_count() {
        let (total, step) = (4096 * 1000, Duration::from_millis(40));
        let mut left = TimeLeft::default();
        let mut shown = 0;
        for block in 1..=1000u64 {
            let time = Duration::from_secs(10) + step * (block as u32);
            left.mark(time, 4096 * block);
            let truth = step.as_secs_f64() * (1000 - block) as f64;
            if let Some(seconds) = left.seconds(time, 4096 * block, total) {
                assert!((seconds - truth).abs() <= 0.02 * truth + 1e-9, "{seconds} instead of {truth}");
                shown += 1;
            } else {
                assert!(step.as_secs_f64() * block as f64 <= 2.0, "nothing after {block} blocks");
            }
        }
        assert!(shown > 900);
    }

    /// Where the pace changes, the estimate follows within the window.
    #[test]
    fn a_new_pace_is_followed() {
        let mut left = TimeLeft::default();
        let mut done = 0;
        for second in 1..=60u64 {
            done += if second <= 20 { 1000 } else { 100 };
            left.mark(Duration::from_secs(second), done);
        }
        let rate = left.rate(Duration::from_secs(60), done).unwrap();
        assert!((rate - 100.0).abs() < 1e-9, "{rate}");
        assert!(left.marks.len() <= 17);
    }

    #[test]
    fn words() {
        let all = [0.2, 59.0, 95.0, 7384.0].map(shown);
        assert_eq!(all, ["1 s", "59 s", "1 min 35 s", "2 h 3 min"]);
    }
}
