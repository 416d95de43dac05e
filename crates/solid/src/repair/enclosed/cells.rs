//! A triangle of the plane cut up by segments.
//!
//! Horizontal lines through all ends and crossings of the segments part the triangle into slabs. No two segments cross
//! in a slab, so that they part it into trapezoids, whose areas are products. No decision is made that rounding could
//! turn over: a segment that ends a hair too early leaves one slab of a hair's height uncut.

/// A place of the plane.
pub(super) type Point2 = [f64; 2];

/// A piece that no segment cuts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub center: Point2,
    pub corners: [Point2; 4],
    pub area: f64,
}

/// Slabs times segments, at most.
const MAX_SLAB_SEGMENTS: usize = 30_000_000;

/// The triangle without the segments; their parts beyond it do not count. `None` where that would be too much work.
/// Cost: slabs times segments; there are two slabs for each segment and one for each crossing.
pub(super) fn cells(triangle: &[Point2; 3], segments: &[[Point2; 2]]) -> Option<Vec<Cell>> {
    let heights = heights(triangle, segments)?;
    let mut cells = vec![];
    let mut across = vec![];
    for pair in heights.windows(2) {
        let (low, high) = (pair[0], pair[1]);
        let y = low + 0.5 * (high - low);
        if y <= low || y >= high {
            continue;
        }
        let sides = (0..3).filter_map(|i| Passing::of(&[triangle[i], triangle[(i + 1) % 3]], [low, y, high]));
        let mut sides: Vec<Passing> = sides.collect();
        sides.sort_unstable_by(|a, b| a.middle.total_cmp(&b.middle));
        let [left, right] = sides[..] else { continue };
        if left.middle >= right.middle {
            continue;
        }
        across.clear();
        across.extend([left, right]);
        let passing = segments.iter().filter_map(|s| Passing::of(s, [low, y, high]));
        across.extend(passing.map(|x| x.clamp(&left, &right)));
        across.sort_unstable_by(|a, b| a.middle.total_cmp(&b.middle));
        for x in across.windows(2).filter(|x| x[0].middle < x[1].middle) {
            let [from, to] = [x[0], x[1]];
            let width = to.middle - from.middle;
            let corners = [[from.low, low], [to.low, low], [to.high, high], [from.high, high]];
            cells.push(Cell { center: [from.middle + 0.5 * width, y], corners, area: width * (high - low) });
        }
    }
    Some(cells)
}

/// Where slabs begin and end, ascending.
fn heights(triangle: &[Point2; 3], segments: &[[Point2; 2]]) -> Option<Vec<f64>> {
    let mut heights: Vec<f64> = triangle.iter().map(|p| p[1]).collect();
    let (low, high) =
        heights.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(*y), h.max(*y)));
    if segments.len() > MAX_SLAB_SEGMENTS / segments.len().max(1) {
        return None;
    }
    heights.extend(segments.iter().flatten().map(|p| p[1]));
    for (i, a) in segments.iter().enumerate() {
        heights.extend(segments[..i].iter().filter_map(|b| crossing(a, b)));
        if heights.len() > MAX_SLAB_SEGMENTS / segments.len() {
            return None;
        }
    }
    heights.retain(|y| low <= *y && *y <= high);
    heights.sort_unstable_by(f64::total_cmp);
    heights.dedup();
    Some(heights)
}

/// Where a segment passes the lower end, the middle and the upper end of a slab.
#[derive(Clone, Copy)]
struct Passing {
    low: f64,
    middle: f64,
    high: f64,
}

impl Passing {
    fn of([a, b]: &[Point2; 2], [low, y, high]: [f64; 3]) -> Option<Passing> {
        let at = |y: f64| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        ((a[1] < y) != (b[1] < y)).then(|| Passing { low: at(low), middle: at(y), high: at(high) })
    }

    /// The same not beyond the sides of the triangle.
    fn clamp(&self, left: &Passing, right: &Passing) -> Passing {
        // Rounding may exchange the sides where they meet.
        let between = |x: f64, l: f64, r: f64| x.max(l).min(r.max(l));
        Passing {
            low: between(self.low, left.low, right.low),
            middle: between(self.middle, left.middle, right.middle),
            high: between(self.high, left.high, right.high),
        }
    }
}

/// Height of the place where two segments cross.
fn crossing([a, b]: &[Point2; 2], [c, d]: &[Point2; 2]) -> Option<f64> {
    let cross =
        |o: &Point2, p: &Point2, q: &Point2| (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    let (from, to) = (cross(c, d, a), cross(c, d, b));
    let (start, end) = (cross(a, b, c), cross(a, b, d));
    let differ = |p: f64, q: f64| p < 0.0 && q > 0.0 || p > 0.0 && q < 0.0;
    (differ(from, to) && differ(start, end)).then(|| a[1] + from / (from - to) * (b[1] - a[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::num::random::Random;

    /// A square grid of lines: no cell reaches across a line, and together they are the triangle.
    #[test]
    fn cells_keep_between_the_lines_and_fill_the_triangle() {
        let random = &mut Random::new(9);
        for turn in 0..20 {
            let (cos, sin) = (f64::from(turn).cos(), f64::from(turn).sin());
            let turned = |[x, y]: Point2| [x * cos - y * sin, x * sin + y * cos];
            let triangle: [Point2; 3] =
                std::array::from_fn(|_| turned([5.0 * random.unit(), 5.0 * random.unit()]));
            let [a, b, c] = triangle;
            let whole = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
            let line = |k: i32| {
                [[[f64::from(k), -1.0], [f64::from(k), 6.0]], [[-1.0, f64::from(k)], [6.0, f64::from(k)]]]
            };
            let lines: Vec<[Point2; 2]> = (0..6).flat_map(line).map(|s| s.map(turned)).collect();
            let found = cells(&triangle, &lines).unwrap();
            let sum: f64 = found.iter().map(|c| c.area).sum();
            assert!((sum - whole).abs() < 1e-13, "{turn}: {sum} {whole}");
            assert!(found.iter().all(|c| c.area < 1.0 + 1e-12), "{turn}: a cell larger than a square");
        }
    }
}
