//! The points that a report draws: an even sample of bounded size, out of any number.

use trueness_geom::space::Point;

/// A sample of the measured points with their deviations from each reference (NaN: none).
#[derive(Clone, Debug, Default)]
pub struct ShownPoints {
    /// Numbers of the points in the file, rising.
    pub indices: Vec<u64>,
    /// The points.
    pub points: Vec<Point>,
    /// For each reference, one deviation a point.
    pub deviations: Vec<Vec<f64>>,
    limit: usize,
    level: u32,
}

impl ShownPoints {
    /// Keeps at most `limit` points, and at least half as many where there are more.
    pub fn new(limit: usize, references: usize) -> ShownPoints {
        ShownPoints { deviations: vec![vec![]; references], limit, ..ShownPoints::default() }
    }

    /// Takes a block whose first point has number `start`; `deviations` has one list a reference.
    pub fn add(&mut self, start: u64, points: &[Point], deviations: &[&[f64]]) {
        for (i, p) in points.iter().enumerate() {
            let index = start + i as u64;
            if !self.wanted(index) {
                continue;
            }
            self.indices.push(index);
            self.points.push(*p);
            for (mine, theirs) in self.deviations.iter_mut().zip(deviations) {
                mine.push(theirs[i]);
            }
            while self.indices.len() > self.limit {
                self.thin_out();
            }
        }
    }

    /// A point belongs to level `l` when the last `l` bits of its scrambled number are zero: half of the level before,
    /// and unlike every n-th point without a pattern that could follow the scan lines.
    fn wanted(&self, index: u64) -> bool {
        scramble(index).trailing_zeros() >= self.level
    }

    fn thin_out(&mut self) {
        self.level += 1;
        let keep: Vec<bool> = self.indices.iter().map(|&i| self.wanted(i)).collect();
        retain(&mut self.indices, &keep);
        retain(&mut self.points, &keep);
        for d in &mut self.deviations {
            retain(d, &keep);
        }
    }
}

fn retain<T>(list: &mut Vec<T>, keep: &[bool]) {
    let mut flags = keep.iter();
    list.retain(|_| flags.next().copied().unwrap_or(false));
}

/// The mixing step of SplitMix64 (Steele, Lea & Flood 2014): a bijection whose low bits depend on all of its argument.
pub(super) fn scramble(index: u64) -> u64 {
    let z = index.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_an_even_sample_whatever_the_blocks() {
        let points: Vec<Point> = (0..100_000).map(|i| [i as f64, 0.0, 0.0]).collect();
        let values: Vec<f64> = points.iter().map(|p| p[0] + 0.5).collect();
        let gather = |cut: usize| {
            let mut s = ShownPoints::new(1000, 1);
            for (n, part) in points.chunks(cut).enumerate() {
                let at = n * cut;
                s.add(at as u64, part, &[&values[at..at + part.len()]]);
            }
            s
        };
        let s = gather(7777);
        assert_eq!(s.indices, gather(100_000).indices);
        assert!((500..=1000).contains(&s.indices.len()), "{}", s.indices.len());
        let mean = s.points.iter().map(|p| p[0]).sum::<f64>() / s.points.len() as f64;
        assert!((mean - 50_000.0).abs() < 4.0 * 28_868.0 / (s.points.len() as f64).sqrt(), "{mean}");
        for (i, &index) in s.indices.iter().enumerate() {
            assert_eq!((s.points[i][0], s.deviations[0][i]), (index as f64, index as f64 + 0.5));
        }
    }

    #[test]
    fn keeps_all_of_few() {
        let mut s = ShownPoints::new(10, 2);
        s.add(0, &[[1.0; 3]; 10], &[&[0.0; 10], &[f64::NAN; 10]]);
        assert_eq!((s.indices.len(), s.deviations[1].len()), (10, 10));
    }
}
