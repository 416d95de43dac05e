//! A grid of cells over a rectangle: distances on it, and lines of equal height.

/// Square cells over a rectangle with a margin around it. Cells along the second coordinate follow each other.
pub(super) struct Raster {
    from: [f64; 2],
    cell: f64,
    /// Cells along both sides.
    pub counts: [usize; 2],
}

impl Raster {
    /// Over the rectangle, with so many cells around it.
    pub fn new(domain: [(f64, f64); 2], cell: f64, margin: usize) -> Raster {
        let counts = domain.map(|(from, to)| ((to - from) / cell).ceil().max(1.0) as usize + 2 * margin);
        Raster { from: domain.map(|(from, _)| from - margin as f64 * cell), cell, counts }
    }

    /// The same value for each cell.
    pub fn empty(&self, value: f64) -> Vec<f64> {
        vec![value; self.counts[0] * self.counts[1]]
    }

    /// The cell of a place; of one outside the nearest.
    pub fn cell(&self, p: [f64; 2]) -> usize {
        // The cast saturates at 0.
        let [i, j] = [0, 1].map(|k| (((p[k] - self.from[k]) / self.cell) as usize).min(self.counts[k] - 1));
        i * self.counts[1] + j
    }

    /// Numbers of the parts that the cells from `level` upwards make, those side by side together, and how many there are; of lower
    /// cells [`u32::MAX`].
    pub fn parts(&self, height: &[f64], level: f64) -> (Vec<u32>, usize) {
        let [rows, columns] = self.counts;
        let mut part = vec![u32::MAX; height.len()];
        let (mut count, mut open) = (0, vec![]);
        for start in 0..height.len() {
            if height[start] < level || part[start] != u32::MAX {
                continue;
            }
            part[start] = count;
            open.push(start);
            while let Some(cell) = open.pop() {
                let (i, j) = (cell / columns, cell % columns);
                let neighbors = [
                    (i > 0).then(|| cell - columns),
                    (i + 1 < rows).then(|| cell + columns),
                    (j > 0).then(|| cell - 1),
                    (j + 1 < columns).then(|| cell + 1),
                ];
                for next in neighbors.into_iter().flatten() {
                    if height[next] >= level && part[next] == u32::MAX {
                        part[next] = count;
                        open.push(next);
                    }
                }
            }
            count += 1;
        }
        (part, count as usize)
    }

    /// Closed lines through the middles of cells and between them where the height is `level`, and a higher cell beside
    /// each. Higher ground is on their left (marching squares). Cells at the rim must be lower. Where two higher cells
    /// stand corner to corner, they do not hang together.
    pub fn contours(&self, height: &[f64], level: f64) -> Vec<(usize, Vec<[f64; 2]>)> {
        let [rows, columns] = self.counts;
        let is_high = |i: usize, j: usize| height[i * columns + j] >= level;
        // A crossing lies between a cell and the next one along a direction: 2 · cell + direction.
        let mut next = std::collections::BTreeMap::new();
        for i in 0..rows - 1 {
            for j in 0..columns - 1 {
                let corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
                let high = corners.map(|[i, j]| is_high(i, j));
                let cell = |[i, j]: [usize; 2]| i * columns + j;
                // Sides of the square against the clock.
                let sides =
                    [2 * cell([i, j]), 2 * cell([i + 1, j]) + 1, 2 * cell([i, j + 1]), 2 * cell([i, j]) + 1];
                // The line leaves where the high corner lies at the start of a side, and comes in where it lies at its
                // end.
                for k in 0..4 {
                    if !high[k] && high[(k + 1) % 4] {
                        // Around the high corners behind it, up to where they end.
                        let ends = (1..4).find(|n| !high[(k + 1 + n) % 4]).unwrap_or(3);
                        next.insert(sides[(k + ends) % 4], sides[k]);
                    }
                }
            }
        }
        let beyond = |crossing: usize| crossing / 2 + if crossing.is_multiple_of(2) { columns } else { 1 };
        let place = |crossing: usize| -> [f64; 2] {
            let (cell, along, other) = (crossing / 2, crossing % 2, beyond(crossing));
            let share = (level - height[cell]) / (height[other] - height[cell]);
            let mut at = [cell / columns, cell % columns].map(|k| k as f64 + 0.5);
            at[along] += share;
            std::array::from_fn(|k| self.from[k] + at[k] * self.cell)
        };
        let mut lines = vec![];
        while let Some((start, mut at)) = next.pop_first() {
            let mut line = vec![place(start)];
            while at != start {
                line.push(place(at));
                match next.remove(&at) {
                    Some(further) => at = further,
                    None => break,
                }
            }
            let higher = if height[start / 2] >= level { start / 2 } else { beyond(start) };
            lines.push((higher, line));
        }
        lines
    }
}

/// Replaces each value of a grid by the least of all values plus the squared distances to their cells.
pub(super) fn distances(values: &mut [f64], [rows, columns]: [usize; 2]) {
    let mut work = Envelope::default();
    values.chunks_exact_mut(columns).for_each(|row| work.run(row));
    let mut column = vec![0.0; rows];
    for j in 0..columns {
        column.iter_mut().zip(values[j..].iter().step_by(columns)).for_each(|(to, from)| *to = *from);
        work.run(&mut column);
        values[j..].iter_mut().step_by(columns).zip(&column).for_each(|(to, from)| *to = *from);
    }
}

/// The lower envelope of parabolas over a row: the number of each, and from where on it is the lowest.
#[derive(Default)]
struct Envelope {
    number: Vec<usize>,
    starts: Vec<f64>,
    values: Vec<f64>,
}

impl Envelope {
    fn run(&mut self, row: &mut [f64]) {
        let Envelope { number, starts, values } = self;
        number.clear();
        starts.clear();
        values.clear();
        for (q, value) in row.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            let height = |i: usize, v: f64| v + (i * i) as f64;
            let mut start = f64::NEG_INFINITY;
            while let (Some(&p), Some(&from), Some(&v)) = (number.last(), starts.last(), values.last()) {
                start = (height(q, *value) - height(p, v)) / (2.0 * (q - p) as f64);
                if start > from {
                    break;
                }
                number.pop();
                starts.pop();
                values.pop();
                start = f64::NEG_INFINITY;
            }
            number.push(q);
            starts.push(start);
            values.push(*value);
        }
        let mut k = 0;
        for (i, out) in row.iter_mut().enumerate() {
            while k + 1 < starts.len() && starts[k + 1] <= i as f64 {
                k += 1;
            }
            if let (Some(p), Some(v)) = (number.get(k), values.get(k)) {
                *out = v + (i.abs_diff(*p) as f64).powi(2);
            }
        }
    }
}
