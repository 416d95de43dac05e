//! Where the values of a characteristic stand in its chart.

use trueness_document::trend::TrendRecord;

/// Width and height of a chart, in units of its own; the height is that in pixels.
pub const CHART_WIDTH: f64 = 1000.0;
pub const CHART_HEIGHT: f64 = 220.0;
/// A limit farther off than this is named beside the chart: it would press the values into a line.
const MAX_RANGE_PER_SPREAD: f64 = 12.0;
/// Free room above and below, in heights.
const CHART_MARGIN: f64 = 0.06;
/// Values that differ by less, relative to their size, do not differ in a chart.
const MAX_SAME_DIFFERENCE: f64 = 1e-7;
/// Numbers written along the parts, at most.
const MAX_NUMBERED_PARTS: usize = 9;

/// The values and parts that a chart shows.
#[derive(Clone, Copy, Debug)]
pub struct Axes {
    /// Value at the foot.
    pub from: f64,
    /// Value at the head.
    pub to: f64,
    /// Number of parts.
    pub parts: usize,
    /// Digits after the point that tell values in it apart.
    pub decimals: usize,
}

impl Axes {
    /// All values with their uncertainties, the control limits, and of the limits and the nominal value what is not too far off.
    pub fn of(c: &TrendRecord) -> Axes {
        let mut core: Vec<f64> = c.values.iter().flatten().copied().collect();
        core.extend(c.intervals.iter().flatten().flatten().flatten());
        core.extend(c.control.iter().flat_map(|k| [k.lower, k.upper]));
        let mut limits: Vec<f64> = [c.lower, c.upper, c.nominal].into_iter().flatten().collect();
        limits.extend(c.own_upper.iter().flatten());
        let mut range = extent(&core);
        let size = core.iter().chain(&limits).map(|x| x.abs()).fold(0.0, f64::max);
        let spread = range.map_or(0.0, |[a, b]| b - a);
        let alone = spread <= MAX_SAME_DIFFERENCE * size;
        // The nearest first: what it adds leaves room for the next.
        let beyond = |x: &f64| range.map_or(0.0, |[a, b]| (a - x).max(x - b));
        limits.sort_by(|a, b| beyond(a).total_cmp(&beyond(b)));
        for limit in limits {
            let [a, b] = range.unwrap_or([limit; 2]);
            let wide = [a.min(limit), b.max(limit)];
            if alone || wide[1] - wide[0] <= MAX_RANGE_PER_SPREAD * spread {
                range = Some(wide);
            }
        }
        let [a, b] = range.unwrap_or([0.0, 0.0]);
        let least = if size > 0.0 { 1e-3 * size } else { 1.0 };
        let pad = if b - a > MAX_SAME_DIFFERENCE * size { CHART_MARGIN * (b - a) } else { least };
        let (from, to) = (a - pad, b + pad);
        let usual = if c.unit == "mm" { 4 } else { 3 };
        let decimals = (2.0 - libm::log10(to - from).floor()).clamp(f64::from(usual), 9.0) as usize;
        Axes { from, to, parts: c.values.len(), decimals }
    }

    /// Place of a part along the chart, of `width` in all.
    pub fn x(&self, part: usize, width: f64) -> f64 {
        width * (part as f64 + 0.5) / self.parts.max(1) as f64
    }

    /// Place of a value, of `height` in all, from the head down.
    pub fn y(&self, value: f64, height: f64) -> f64 {
        height * (self.to - value) / (self.to - self.from)
    }

    /// Whether a value stands in the chart.
    pub fn holds(&self, value: f64) -> bool {
        self.from <= value && value <= self.to
    }

    /// Round values that are written beside it, with the digits that they need.
    pub fn ticks(&self) -> (Vec<f64>, usize) {
        // Steps grow by at most 2.5: three ticks at least, eight at most.
        let rough = (self.to - self.from) / 7.5;
        let power = libm::pow(10.0, libm::log10(rough).floor());
        let step =
            [1.0, 2.0, 5.0, 10.0].into_iter().map(|s| s * power).find(|s| *s >= rough).unwrap_or(rough);
        let decimals = (-libm::log10(step).floor()).clamp(0.0, 12.0) as usize;
        let first = (self.from / step).ceil();
        let all = (0..12).map(|k| (first + f64::from(k)) * step).take_while(|v| *v <= self.to);
        // 0 and no minus 0.
        (all.map(|v| v + 0.0).collect(), decimals)
    }

    /// Parts, from 0, whose numbers are written below it.
    pub fn numbered(&self) -> Vec<usize> {
        let step = (1..).flat_map(|p| [1, 2, 5].map(|s| s * 10usize.pow(p - 1)));
        let step = step
            .take(60)
            .find(|s| self.parts.div_ceil(*s) <= MAX_NUMBERED_PARTS)
            .unwrap_or(self.parts.max(1));
        // The first, then round numbers.
        let round = (step..=self.parts).step_by(step).map(|n| n - 1);
        (0..self.parts.min(1)).chain(round.filter(|n| *n > 0)).collect()
    }
}

fn extent(values: &[f64]) -> Option<[f64; 2]> {
    let low = values.iter().copied().reduce(f64::min)?;
    Some([low, values.iter().copied().reduce(f64::max)?])
}

/// Digits that a limit of a drawing needs, of at most so many.
pub fn needed(value: f64, most: usize) -> usize {
    let text = |d: usize| format!("{value:.d$}").parse::<f64>().unwrap_or(f64::NAN);
    (0..most).find(|d| text(*d) == text(most)).unwrap_or(most)
}
