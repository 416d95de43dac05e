//! Points that are colored only when all of them have been seen.

use super::points_file::{PointsFile, begin};
use crate::error::{WriteError, WriteFault};
use crate::format::sink::{Block, Layout};
use crate::format::spool::Spool;
use std::path::Path;
use trueness_geom::space::Point;

/// A block of the file holds this many points at most.
const MAX_POINTS_PER_HELD_BLOCK: usize = 1 << 16;
/// Bytes of a waiting point: three coordinates, a deviation and the number of a reason.
const BYTES_PER_HELD_POINT: usize = 40;

/// A file of points with deviations whose colors are not known yet. Unless it is finished, nothing of it remains.
///
/// The points wait in memory or, when they are many, in a file beside the one to be written.
pub struct HeldPoints {
    file: PointsFile,
    waiting: Spool,
    reason: bool,
}

impl HeldPoints {
    /// Begins a file in the format of the path's extension, with reasons or without.
    ///
    /// Errors: those of [`points`](super::points).
    pub fn create(path: &Path, reason: bool) -> Result<HeldPoints, WriteError> {
        let (file, waiting) = begin(path, Layout { deviation: true, reason, face: false, color: true })?;
        Ok(HeldPoints { file, waiting, reason })
    }

    /// Adds points and as many deviations, millimeters; NaN for a point that has none. A file with reasons takes as many of
    /// these, any other file none.
    pub fn write(&mut self, points: &[Point], deviation: &[f64], reason: &[u8]) -> Result<(), WriteError> {
        let reasons = if self.reason { points.len() } else { 0 };
        for (what, values, expected) in
            [("deviations", deviation.len(), points.len()), ("reasons", reason.len(), reasons)]
        {
            if values != expected {
                let points = points.len();
                return Err(WriteFault::Uneven { what, points, values }.in_file(&self.file.path));
            }
        }
        let reason = |i: usize| f64::from(reason.get(i).copied().unwrap_or(0));
        let record =
            |(i, (p, d)): (usize, (&Point, &f64))| [p[0], p[1], p[2], *d, reason(i)].map(f64::to_le_bytes);
        let bytes = points.iter().zip(deviation).enumerate().flat_map(record).flatten();
        self.waiting.write(bytes).map_err(|e| WriteFault::from(e).in_file(&self.file.path))
    }

    /// Writes all points, and puts the file in its place. `color` gives the colors of a block from its deviations, which are
    /// NaN for points that do not count.
    pub fn finish(self, color: impl Fn(&[f64]) -> Vec<[u8; 3]>) -> Result<u64, WriteError> {
        let HeldPoints { mut file, mut waiting, reason: reasons } = self;
        let (mut bytes, mut failed) = (Vec::new(), None);
        let mut pass = |bytes: &mut Vec<u8>, least: usize| {
            while bytes.len() >= least.max(BYTES_PER_HELD_POINT) {
                let whole = (bytes.len() / BYTES_PER_HELD_POINT).min(MAX_POINTS_PER_HELD_BLOCK)
                    * BYTES_PER_HELD_POINT;
                let numbers: Vec<[f64; 5]> = (bytes[..whole].as_chunks::<8>().0.as_chunks::<5>().0.iter())
                    .map(|record| record.map(f64::from_le_bytes))
                    .collect();
                let points: Vec<Point> = numbers.iter().map(|[x, y, z, ..]| [*x, *y, *z]).collect();
                let deviation: Vec<f64> = numbers.iter().map(|n| n[3]).collect();
                let counts: Vec<f64> =
                    numbers.iter().map(|n| if n[4] > 0.0 { f64::NAN } else { n[3] }).collect();
                let mut reason: Vec<u8> = numbers.iter().map(|n| n[4] as u8).collect();
                reason.truncate(if reasons { reason.len() } else { 0 });
                let color = color(&counts);
                file.write(&Block {
                    points: &points,
                    deviation: &deviation,
                    reason: &reason,
                    face: &[],
                    color: &color,
                })?;
                bytes.drain(..whole);
            }
            Ok(())
        };
        let played = waiting.play(|part| {
            bytes.extend_from_slice(part);
            pass(&mut bytes, MAX_POINTS_PER_HELD_BLOCK * BYTES_PER_HELD_POINT).map_err(|e| {
                failed = Some(e);
                std::io::Error::other("the points could not be written")
            })
        });
        let rest = pass(&mut bytes, BYTES_PER_HELD_POINT);
        if let Some(e) = failed {
            return Err(e);
        }
        played.map_err(|e| WriteFault::from(e).in_file(&file.path))?;
        rest?;
        file.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::points;
    use crate::write::scratch::Folder;

    #[test]
    fn is_the_file_that_colors_known_beforehand_give() {
        let folder = Folder::new();
        let n = 1_100_000;
        let points_of = |from: usize| (from..n).map(|i| [i as f64, 0.5, -1.0]).collect::<Vec<Point>>();
        let (all, deviation): (Vec<Point>, Vec<f64>) =
            (points_of(0), (0..n).map(|i| if i % 7 == 0 { f64::NAN } else { i as f64 }).collect());
        let color = |d: &[f64]| d.iter().map(|d| [*d as u8, 1, 2]).collect::<Vec<_>>();
        let code = |(i, d): (usize, &f64)| if d.is_nan() { 2 } else { 4 * u8::from(i % 11 == 0) };
        let reason: Vec<u8> = deviation.iter().enumerate().map(code).collect();
        let counts: Vec<f64> =
            deviation.iter().zip(&reason).map(|(d, r)| if *r > 0 { f64::NAN } else { *d }).collect();
        for (extension, with) in [("ply", true), ("vtp", true), ("csv", true), ("ply", false)] {
            let [now, later] =
                ["now", "later"].map(|name| folder.path().join(format!("{name}{with}.{extension}")));
            let mut file =
                points(&now, Layout { deviation: true, reason: with, face: false, color: true }).unwrap();
            let (reason, seen) = if with { (&reason[..], &counts) } else { (&[][..], &deviation) };
            let colors = color(seen);
            file.write(&Block { points: &all, deviation: &deviation, reason, face: &[], color: &colors })
                .unwrap();
            file.finish().unwrap();
            let mut held = HeldPoints::create(&later, with).unwrap();
            for (n, (p, d)) in all.chunks(333_333).zip(deviation.chunks(333_333)).enumerate() {
                let at = n * 333_333;
                held.write(p, d, if with { &reason[at..at + p.len()] } else { &[] }).unwrap();
            }
            assert_eq!(held.finish(color).unwrap(), n as u64);
            assert!(std::fs::read(now).unwrap() == std::fs::read(later).unwrap(), "{extension}");
        }
        let mut none = HeldPoints::create(&folder.path().join("none.ply"), true).unwrap();
        assert!(none.write(&all, &deviation[1..], &reason).is_err());
        assert!(none.write(&all, &deviation, &[]).is_err());
        drop(none);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 8);
    }
}
